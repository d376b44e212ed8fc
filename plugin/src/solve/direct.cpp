// In: a symmetric matrix of 3x3 blocks. Out: its factors L D L^T and solutions through Eigen's SimplicialLDLT, number
// by number: the reference for Frond's own solver.
#include "solve/direct.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "solve/elimination_order.hpp"
#include "solve/linear_solver.hpp"

namespace frond {

using Sparse = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

// Makes protected members of Eigen accessible: to check pivots and to solve in place.
struct Ldlt : Eigen::SimplicialLDLT<Sparse, Eigen::Upper, Eigen::NaturalOrdering<int>> {
    bool refactor(const Sparse& ordered) {
        factorize(ordered);
        if (m_info != Eigen::Success) return false;
        for (double pivot : m_diag)
            if (!(pivot > 0) || !std::isfinite(pivot)) return false;
        return true;
    }
    void solve_in_place(VecX& x) const {
        matrixL().solveInPlace(x);
        x.array() /= m_diag.array();
        matrixU().solveInPlace(x);
    }
    int64_t fill() const { return m_matrix.nonZeros(); }
};

struct DirectFactor {
    std::vector<int> order, source;  // nodes in elimination order; value k of the ordered matrix is values[source[k]]
    Sparse ordered;                  // its upper triangle, by columns
    Ldlt ldlt;
    VecX solution;  // in elimination order
};

// Expands blocks to numbers; diagonal blocks to their upper half only.
static void place_numbers(const BlockPattern& pattern, DirectFactor& factor) {
    struct Entry {
        int row, slot;
        bool transposed;
    };
    std::vector<int> place(factor.order.size());
    for (size_t k = 0; k < factor.order.size(); ++k) place[size_t(factor.order[k])] = int(k);
    std::vector<std::vector<Entry>> columns(factor.order.size());
    for (int j = 0; j < pattern.node_count; ++j)
        for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; ++k) {
            const int pi = place[size_t(pattern.row[size_t(k)])], pj = place[size_t(j)];
            columns[size_t(std::max(pi, pj))].push_back({std::min(pi, pj), k, pi > pj});
        }
    std::vector<int> start = {0}, row;
    for (size_t column = 0; column < columns.size(); ++column) {
        auto& entries = columns[column];
        std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.row < b.row; });
        for (int c = 0; c < 3; ++c) {
            for (const Entry& entry : entries)
                for (int r = 0; r < (entry.row == int(column) ? c + 1 : 3); ++r) {
                    row.push_back(3 * entry.row + r);
                    factor.source.push_back(9 * entry.slot + (entry.transposed ? c + 3 * r : r + 3 * c));
                }
            start.push_back(int(row.size()));
        }
    }
    factor.ordered.resize(Eigen::Index(start.size()) - 1, Eigen::Index(start.size()) - 1);
    factor.ordered.resizeNonZeros(Eigen::Index(row.size()));
    std::copy(start.begin(), start.end(), factor.ordered.outerIndexPtr());
    std::copy(row.begin(), row.end(), factor.ordered.innerIndexPtr());
    std::fill_n(factor.ordered.valuePtr(), row.size(), 0.0);
}

DirectFactorPtr make_direct_factor(const BlockPattern& pattern) {
    DirectFactorPtr factor(new DirectFactor);
    factor->order = elimination_order(pattern);
    place_numbers(pattern, *factor);
    factor->ldlt.analyzePattern(factor->ordered);
    factor->solution.resize(factor->ordered.cols());
    return factor;
}

void DirectFactorDeleter::operator()(DirectFactor* factor) const {
    delete factor;
}

int64_t fill_of(const DirectFactor& factor) {
    return factor.ldlt.fill();
}

bool factorize(DirectFactor& factor, const BlockMatrix& A) {
    double* values = factor.ordered.valuePtr();
    for (size_t k = 0; k < factor.source.size(); ++k) values[k] = A.values[size_t(factor.source[k])];
    return factor.ldlt.refactor(factor.ordered);
}

void solve(DirectFactor& factor, const VecX& b, VecX& x) {
    for (size_t k = 0; k < factor.order.size(); ++k) point(factor.solution, int(k)) = point(b, factor.order[k]);
    factor.ldlt.solve_in_place(factor.solution);
    x.resize(b.size());
    for (size_t k = 0; k < factor.order.size(); ++k) point(x, factor.order[k]) = point(factor.solution, int(k));
}

LinearResult solve_direct(const BlockMatrix& A, const VecX& b, const LinearLimits&, LinearScratch& scratch, VecX& x) {
    if (!scratch.direct) scratch.direct = make_direct_factor(*A.pattern);
    if (!factorize(*scratch.direct, A)) return {};
    solve(*scratch.direct, b, x);
    return checked_once(A, b, x, scratch);
}

}  // namespace frond
