// In: a symmetric matrix of 3x3 blocks. Out: its factors L D L^T and solutions, through Eigen's SimplicialLDLT.
//
// The order is found on the graph of nodes by approximate minimum degree (Amestoy, Davis, Duff 1996), so that a node's
// three rows stay together. A plant is nearly a tree, and so is its elimination tree: fill grows linearly.
#include "solve/direct.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "solve/linear_solver.hpp"

namespace frond {

namespace {

using Sparse = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

// Opens what Eigen keeps protected: factorizing a matrix that is ordered already, in place and without allocating.
struct Ldlt : Eigen::SimplicialLDLT<Sparse, Eigen::Upper, Eigen::NaturalOrdering<int>> {
    void analyze(const Sparse& ordered) { analyzePattern_preordered(ordered, true); }
    bool refactor(const Sparse& ordered) {
        factorize_preordered<true>(ordered);
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

std::vector<int> order_nodes(const BlockPattern& pattern) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < pattern.node_count; ++j)
        for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; ++k)
            entries.emplace_back(pattern.row[size_t(k)], j, 1.0);
    Sparse graph(pattern.node_count, pattern.node_count);
    graph.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
    Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Lower>(), permutation);
    const auto& indices = permutation.indices();
    return std::vector<int>(indices.data(), indices.data() + indices.size());
}

}  // namespace

DirectPlan make_direct_plan(const BlockPattern& pattern) {
    DirectPlan plan;
    plan.order = order_nodes(pattern);
    std::vector<int> place(plan.order.size());
    for (size_t k = 0; k < plan.order.size(); ++k) place[size_t(plan.order[k])] = int(k);

    // Blocks of each ordered column of nodes, from the top to the diagonal.
    struct Entry {
        int row, slot;
        bool transposed;
    };
    std::vector<std::vector<Entry>> columns(plan.order.size());
    for (int j = 0; j < pattern.node_count; ++j)
        for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; ++k) {
            const int pi = place[size_t(pattern.row[size_t(k)])], pj = place[size_t(j)];
            columns[size_t(std::max(pi, pj))].push_back({std::min(pi, pj), k, pi > pj});
        }

    // Block by block becomes number by number; of a diagonal block the upper half only.
    plan.start.push_back(0);
    for (size_t column = 0; column < columns.size(); ++column) {
        auto& entries = columns[column];
        std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.row < b.row; });
        for (int c = 0; c < 3; ++c) {
            for (const Entry& entry : entries)
                for (int r = 0; r < (entry.row == int(column) ? c + 1 : 3); ++r) {
                    plan.row.push_back(3 * entry.row + r);
                    plan.source.push_back(9 * entry.slot + (entry.transposed ? c + 3 * r : r + 3 * c));
                }
            plan.start.push_back(int(plan.row.size()));
        }
    }
    return plan;
}

struct DirectFactor {
    const DirectPlan* plan;
    Sparse ordered;
    Ldlt ldlt;
    VecX solution;  // in elimination order
};

void DirectFactorDeleter::operator()(DirectFactor* factor) const {
    delete factor;
}

DirectFactorPtr make_direct_factor(const DirectPlan& plan) {
    DirectFactorPtr factor(new DirectFactor);
    const int n = 3 * int(plan.order.size());
    factor->plan = &plan;
    factor->ordered.resize(n, n);
    factor->ordered.resizeNonZeros(Eigen::Index(plan.row.size()));
    std::copy(plan.start.begin(), plan.start.end(), factor->ordered.outerIndexPtr());
    std::copy(plan.row.begin(), plan.row.end(), factor->ordered.innerIndexPtr());
    std::fill_n(factor->ordered.valuePtr(), plan.row.size(), 0.0);
    factor->ldlt.analyze(factor->ordered);
    factor->solution.resize(n);
    return factor;
}

bool factorize(DirectFactor& factor, const BlockMatrix& A) {
    const std::vector<int>& source = factor.plan->source;
    double* values = factor.ordered.valuePtr();
    for (size_t k = 0; k < source.size(); ++k) values[k] = A.values[size_t(source[k])];
    return factor.ldlt.refactor(factor.ordered);
}

void solve(DirectFactor& factor, const VecX& b, VecX& x) {
    const std::vector<int>& order = factor.plan->order;
    for (size_t k = 0; k < order.size(); ++k) point(factor.solution, int(k)) = point(b, order[k]);
    factor.ldlt.solve_in_place(factor.solution);
    x.resize(b.size());
    for (size_t k = 0; k < order.size(); ++k) point(x, order[k]) = point(factor.solution, int(k));
}

int64_t fill_of(const DirectFactor& factor) {
    return factor.ldlt.fill();
}

LinearResult solve_direct(const BlockMatrix& A, const VecX& b, const LinearLimits& limits, LinearScratch& scratch,
                          VecX& x) {
    if (!factorize(*scratch.factor, A)) return {};
    return solve_direct_again(A, b, limits, scratch, x);
}

LinearResult solve_direct_again(const BlockMatrix& A, const VecX& b, const LinearLimits&, LinearScratch& scratch,
                                VecX& x) {
    LinearResult result;
    result.iterations = 1;
    solve(*scratch.factor, b, x);
    result.residual = relative_residual(A, b, x, scratch.residual);
    result.ok = result.converged = std::isfinite(result.residual);
    return result;
}

}  // namespace frond
