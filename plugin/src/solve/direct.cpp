// In: a symmetric matrix of 3x3 blocks. Out: its factors L D L^T and solutions, through Eigen's SimplicialLDLT, or
// tree_factor.hpp where that is for the pattern.
//
// The order is found on the graph of nodes by approximate minimum degree (Amestoy, Davis, Duff 1996), so that a node's
// three rows stay together. A plant is nearly a tree, and so is its elimination tree: fill grows linearly, and a right
// side of few nodes reaches few rows (Gilbert, Peierls 1988, "Sparse partial pivoting in time proportional to arithmetic
// operations").
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
    int parent(int column) const { return m_parent[column]; }
    double pivot(int column) const { return m_diag[column]; }
    // Takes what column j of L eliminates off the rows below it.
    void eliminate(int j, Eigen::Matrix3Xd& x) const {
        for (int k = m_matrix.outerIndexPtr()[j]; k < m_matrix.outerIndexPtr()[j + 1]; ++k)
            x.col(m_matrix.innerIndexPtr()[k]) -= m_matrix.valuePtr()[k] * x.col(j);
    }
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
    plan.tree = make_tree_plan(pattern);
    if (plan.tree) return plan;
    plan.order = order_nodes(pattern);
    std::vector<int>& place = plan.place;
    place.resize(plan.order.size());
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
    // Of half solves, in elimination order, transposed; between them all zero.
    Eigen::Matrix3Xd sparse;
    std::vector<uint8_t> reached;
    TreeFactor tree;
};

void DirectFactorDeleter::operator()(DirectFactor* factor) const {
    delete factor;
}

DirectFactorPtr make_direct_factor(const DirectPlan& plan) {
    DirectFactorPtr factor(new DirectFactor);
    const int n = 3 * int(plan.order.size());
    factor->plan = &plan;
    if (plan.tree) return factor;
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
    if (factor.plan->tree) return factorize(*factor.plan->tree, A, factor.tree);
    const std::vector<int>& source = factor.plan->source;
    double* values = factor.ordered.valuePtr();
    for (size_t k = 0; k < source.size(); ++k) values[k] = A.values[size_t(source[k])];
    return factor.ldlt.refactor(factor.ordered);
}

void solve(DirectFactor& factor, const VecX& b, VecX& x) {
    if (factor.plan->tree) return solve(*factor.plan->tree, factor.tree, b, x);
    const std::vector<int>& order = factor.plan->order;
    for (size_t k = 0; k < order.size(); ++k) point(factor.solution, int(k)) = point(b, order[k]);
    factor.ldlt.solve_in_place(factor.solution);
    x.resize(b.size());
    for (size_t k = 0; k < order.size(); ++k) point(x, order[k]) = point(factor.solution, int(k));
}

void half_solve(DirectFactor& factor, const std::vector<NodeBlock>& right_side, Answer& answer) {
    if (factor.plan->tree) return half_solve(*factor.plan->tree, factor.tree, right_side, answer);
    const Eigen::Index n = factor.solution.size();
    if (factor.sparse.cols() != n) {
        factor.sparse.setZero(3, n);
        factor.reached.assign(size_t(n), 0);
    }
    // Rows that are not zero: on the paths from the given ones to the root of the elimination tree.
    answer.rows.clear();
    for (const NodeBlock& given : right_side)
        for (int r = 0; r < 3; ++r) {
            const int row = 3 * factor.plan->place[size_t(given.node)] + r;
            factor.sparse.col(row) += given.block.row(r).transpose();
            for (int j = row; j >= 0 && !factor.reached[size_t(j)]; j = factor.ldlt.parent(j)) {
                factor.reached[size_t(j)] = 1;
                answer.rows.push_back(j);
            }
        }
    std::sort(answer.rows.begin(), answer.rows.end());
    const Eigen::Index count = Eigen::Index(answer.rows.size());
    answer.left.resize(3, count);
    answer.right.resize(3, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const int j = answer.rows[size_t(k)];
        factor.ldlt.eliminate(j, factor.sparse);
        answer.left.col(k) = factor.sparse.col(j);
        answer.right.col(k) = factor.sparse.col(j) / factor.ldlt.pivot(j);
        factor.sparse.col(j).setZero();
        factor.reached[size_t(j)] = 0;
    }
}

int64_t fill_of(const DirectFactor& factor) {
    return factor.plan->tree ? 72 * int64_t(factor.tree.pairs.size()) : factor.ldlt.fill();
}

void half_solve_direct(LinearScratch& scratch, const std::vector<NodeBlock>& right_side, Answer& answer) {
    half_solve(*scratch.factor, right_side, answer);
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
