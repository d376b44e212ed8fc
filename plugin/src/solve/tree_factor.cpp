// In: a symmetric matrix over pairs of nodes that hang together as a tree. Out: its factors L D L^T and solutions.
//
// Eliminated from the tips to the root a tree fills nothing in (Parter 1961, "The use of linear graphs in Gauss
// elimination"), so that all there is are dense blocks of six by six: one of each pair's own, one to its parent.
#include "solve/tree_factor.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace frond {

namespace {

constexpr int SIX = 6;
using Block = double[SIX][SIX];

// The 3x3 block of a matrix, which is stored by columns, at (r, c) of one of six by six.
void put(const BlockMatrix& A, int slot, int r, int c, Block& out) {
    const double* from = A.values.data() + 9 * size_t(std::max(slot, 0));
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) out[r + i][c + j] = slot < 0 ? 0.0 : from[i + 3 * j];
}

// The lower half of a pair's own block, its diagonal included, becomes L and D; the reciprocals of D come out besides.
bool factorize_own(TreeFactor::Pair& pair, double (&inverse)[SIX]) {
    Block& a = pair.lower;
    for (int k = 0; k < SIX; ++k) {
        const double d = pair.pivot[k] = a[k][k];
        if (!(d > 0) || !std::isfinite(d)) return false;
        inverse[k] = 1 / d;
        for (int r = k + 1; r < SIX; ++r) {
            const double l = a[r][k] * inverse[k];
            for (int c = k + 1; c <= r; ++c) a[r][c] -= l * a[c][k];
        }
        for (int r = k + 1; r < SIX; ++r) a[r][k] *= inverse[k];
    }
    return true;
}

// What the pair's elimination takes off its parent's own block, C' A^-1 C, C being its block with the parent; C becomes
// D^-1 L^-1 C.
void eliminate(TreeFactor::Pair& pair, const double (&inverse)[SIX], Block& parent) {
    Block &C = pair.to_parent, over;
    for (int r = 1; r < SIX; ++r)
        for (int k = 0; k < r; ++k)
            for (int c = 0; c < SIX; ++c) C[r][c] -= pair.lower[r][k] * C[k][c];
    for (int k = 0; k < SIX; ++k)
        for (int c = 0; c < SIX; ++c) over[k][c] = C[k][c] * inverse[k];
    for (int r = 0; r < SIX; ++r) {
        double row[SIX];
        for (int c = 0; c < SIX; ++c) row[c] = parent[r][c];
        for (int k = 0; k < SIX; ++k)
            for (int c = 0; c < SIX; ++c) row[c] -= over[k][r] * C[k][c];
        for (int c = 0; c < SIX; ++c) parent[r][c] = row[c];
    }
    for (int k = 0; k < SIX; ++k)
        for (int c = 0; c < SIX; ++c) C[k][c] = over[k][c];
}

}  // namespace

std::optional<TreePlan> make_tree_plan(const BlockPattern& pattern) {
    if (pattern.node_count == 0 || pattern.node_count % 2) return std::nullopt;
    TreePlan plan;
    plan.pairs.assign(size_t(pattern.node_count) / 2, {-1, {-1, -1, -1}, {-1, -1, -1, -1}});
    for (int j = 0; j < pattern.node_count; ++j)
        for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; ++k) {
            const int i = pattern.row[size_t(k)];
            TreePlan::Pair& pair = plan.pairs[size_t(i) / 2];
            if (i / 2 == j / 2) {
                pair.own[size_t(i % 2 + j % 2)] = k;
                continue;
            }
            if (pair.parent >= 0 && pair.parent != j / 2) return std::nullopt;
            pair.parent = j / 2;
            pair.link[size_t(i % 2 + 2 * (j % 2))] = k;
        }
    return plan;
}

bool factorize(const TreePlan& plan, const BlockMatrix& A, TreeFactor& factor) {
    factor.pairs.resize(plan.pairs.size());
    for (size_t i = 0; i < plan.pairs.size(); ++i) {
        Block& own = factor.pairs[i].lower;
        put(A, plan.pairs[i].own[0], 0, 0, own);
        put(A, plan.pairs[i].own[1], 3, 0, own);
        put(A, plan.pairs[i].own[2], 3, 3, own);
    }
    for (size_t i = plan.pairs.size(); i-- > 0;) {
        const TreePlan::Pair& place = plan.pairs[i];
        TreeFactor::Pair& pair = factor.pairs[i];
        double inverse[SIX];
        if (!factorize_own(pair, inverse)) return false;
        if (place.parent < 0) continue;
        for (int k = 0; k < 4; ++k) put(A, place.link[size_t(k)], 3 * (k % 2), 3 * (k / 2), pair.to_parent);
        eliminate(pair, inverse, factor.pairs[size_t(place.parent)].lower);
    }
    return true;
}

void solve(const TreePlan& plan, TreeFactor& factor, const VecX& b, VecX& x) {
    std::vector<double>& y = factor.sums;
    y.assign(b.data(), b.data() + b.size());
    for (size_t i = plan.pairs.size(); i-- > 0;) {
        const TreeFactor::Pair& pair = factor.pairs[i];
        double* own = y.data() + SIX * i;
        for (int r = 1; r < SIX; ++r)
            for (int k = 0; k < r; ++k) own[r] -= pair.lower[r][k] * own[k];
        if (plan.pairs[i].parent < 0) continue;
        double* parent = y.data() + SIX * size_t(plan.pairs[i].parent);
        for (int k = 0; k < SIX; ++k)
            for (int c = 0; c < SIX; ++c) parent[c] -= pair.to_parent[k][c] * own[k];
    }
    for (size_t i = 0; i < plan.pairs.size(); ++i) {
        const TreeFactor::Pair& pair = factor.pairs[i];
        double* own = y.data() + SIX * i;
        for (int k = 0; k < SIX; ++k) own[k] /= pair.pivot[k];
        if (plan.pairs[i].parent >= 0) {
            const double* parent = y.data() + SIX * size_t(plan.pairs[i].parent);
            for (int k = 0; k < SIX; ++k)
                for (int c = 0; c < SIX; ++c) own[k] -= pair.to_parent[k][c] * parent[c];
        }
        for (int r = SIX - 1; r > 0; --r)
            for (int k = 0; k < r; ++k) own[k] -= pair.lower[r][k] * own[r];
    }
    x = Eigen::Map<const VecX>(y.data(), b.size());
}

void half_solve(const TreePlan& plan, TreeFactor& factor, const std::vector<NodeBlock>& right_side, Answer& answer) {
    const size_t count = plan.pairs.size();
    if (factor.reached.size() != count) {
        factor.reached.assign(count, 0);
        factor.sparse.setZero(3, Eigen::Index(SIX * count));
    }
    // Pairs that are not zero: on the paths from the given ones to their roots.
    std::vector<int> path;
    for (const NodeBlock& given : right_side) {
        for (int r = 0; r < 3; ++r) factor.sparse.col(3 * given.node + r) += given.block.row(r).transpose();
        for (int i = given.node / 2; i >= 0 && !factor.reached[size_t(i)]; i = plan.pairs[size_t(i)].parent) {
            factor.reached[size_t(i)] = 1;
            path.push_back(i);
        }
    }
    std::sort(path.begin(), path.end(), std::greater<>());
    answer.rows.clear();
    answer.left.resize(3, SIX * Eigen::Index(path.size()));
    answer.right.resize(3, SIX * Eigen::Index(path.size()));
    for (const int i : path) {
        const TreeFactor::Pair& pair = factor.pairs[size_t(i)];
        const int parent = plan.pairs[size_t(i)].parent;
        auto own = factor.sparse.middleCols<SIX>(SIX * Eigen::Index(i));
        for (int r = 0; r < SIX; ++r) {
            for (int k = 0; k < r; ++k) own.col(r) -= pair.lower[r][k] * own.col(k);
            const Eigen::Index at = Eigen::Index(answer.rows.size());
            answer.left.col(at) = own.col(r);
            answer.right.col(at) = own.col(r) / pair.pivot[r];
            answer.rows.push_back(SIX * (int(count) - 1 - i) + r);
            for (int c = 0; parent >= 0 && c < SIX; ++c)
                factor.sparse.col(SIX * Eigen::Index(parent) + c) -= pair.to_parent[r][c] * own.col(r);
        }
        own.setZero();
        factor.reached[size_t(i)] = 0;
    }
}

}  // namespace frond
