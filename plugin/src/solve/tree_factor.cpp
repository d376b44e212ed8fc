// In: a symmetric matrix over pairs of nodes connected as a tree. Out: its factors L D L^T and solutions.
//
// A tree eliminated from the tips to the root has no fill (Parter 1961, "The use of linear graphs in Gauss
// elimination"), so that the factor is dense blocks of six by six: each pair's own, and one to its parent.
#include "solve/tree_factor.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/assert.hpp"
#include "core/lanes.hpp"

namespace frond {

namespace {

using Block = double[SIX][SIX];

// Six numbers in registers.
template <class S>
struct Six;
template <>
struct Six<TwoLanes> {
    TwoLanes a, b, c;
    FROND_INLINE explicit Six(const double* from)
        : a(load<TwoLanes>(from)), b(load<TwoLanes>(from + 2)), c(load<TwoLanes>(from + 4)) {}
    FROND_INLINE void put(double* to) const { store(a, to), store(b, to + 2), store(c, to + 4); }
    FROND_INLINE void take_off(double times, const Six& x) { a -= times * x.a, b -= times * x.b, c -= times * x.c; }
    FROND_INLINE void scale(double by) { a *= by, b *= by, c *= by; }
    FROND_INLINE double dot(const Six& x) const {
        const TwoLanes sum = (a * x.a + b * x.b) + c * x.c;
        return sum[0] + sum[1];
    }
};
template <>
struct Six<FourLanes> {
    FourLanes a;
    TwoLanes c;
    FROND_INLINE explicit Six(const double* from) : a(load<FourLanes>(from)), c(load<TwoLanes>(from + 4)) {}
    FROND_INLINE void put(double* to) const { store(a, to), store(c, to + 4); }
    FROND_INLINE void take_off(double times, const Six& x) { a -= times * x.a, c -= times * x.c; }
    FROND_INLINE void scale(double by) { a *= by, c *= by; }
    FROND_INLINE double dot(const Six& x) const {
        const FourLanes by = a * x.a;
        const TwoLanes sum = (TwoLanes{by[0], by[1]} + TwoLanes{by[2], by[3]}) + c * x.c;
        return sum[0] + sum[1];
    }
};

// Puts a 3x3 block of a matrix, which is stored by columns, at (r, c) of a 6x6 block.
void put(const BlockMatrix& A, int slot, int r, int c, Block& out) {
    const double* from = A.values.data() + 9 * size_t(std::max(slot, 0));
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) out[r + i][c + j] = slot < 0 ? 0.0 : from[i + 3 * j];
}

// The same, transposed.
void put_transposed(const BlockMatrix& A, int slot, int r, int c, Block& out) {
    const double* from = A.values.data() + 9 * size_t(std::max(slot, 0));
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) out[r + i][c + j] = slot < 0 ? 0.0 : from[3 * i + j];
}

// Factorizes a pair's own block, of which only the upper triangle counts, to L' and D.
template <class S>
FROND_INLINE bool factorize_own(TreeFactor::Pair& pair) {
    Block& a = pair.own;
    for (int k = 0; k < SIX; ++k) {
        const double d = pair.pivot[k] = a[k][k];
        if (!(d > 0) || !std::isfinite(d)) return false;
        const double inverse = pair.inverse[k] = 1 / d;
        Six<S> row(a[k]);
        for (int r = k + 1; r < SIX; ++r) {
            Six<S> below(a[r]);
            below.take_off(a[k][r] * inverse, row);
            below.put(a[r]);
        }
        row.scale(inverse);
        row.put(a[k]);
        for (int c = 0; c <= k; ++c) a[k][c] = 0;
    }
    return true;
}

// Eliminates a pair with the block C to its parent: subtracts C' A^-1 C from the parent's own; C becomes D^-1 L^-1 C.
template <class S>
FROND_INLINE void eliminate(TreeFactor::Pair& pair, Block& parent) {
    Block &C = pair.to_parent, over;
    for (int k = 0; k < SIX; ++k) {
        Six<S> row(C[k]);
        for (int r = k + 1; r < SIX; ++r) {
            Six<S> below(C[r]);
            below.take_off(pair.own[k][r], row);
            below.put(C[r]);
        }
        row.scale(pair.inverse[k]);
        row.put(over[k]);
    }
    for (int r = 0; r < SIX; ++r) {
        Six<S> row(parent[r]);
        for (int k = 0; k < SIX; ++k) row.take_off(over[k][r], Six<S>(C[k]));
        row.put(parent[r]);
    }
    for (int k = 0; k < SIX; ++k) Six<S>(over[k]).put(C[k]);
}

struct FactorizeTree {
    const TreePlan& plan;
    const BlockMatrix& A;
    TreeFactor& factor;
    bool& ok;
    template <class S>
    FROND_INLINE void run() const {
        ok = false;
        for (size_t i = 0; i < plan.pairs.size(); ++i) {
            Block& own = factor.pairs[i].own;
            put(A, plan.pairs[i].own[0], 0, 0, own);
            put_transposed(A, plan.pairs[i].own[1], 0, 3, own);
            put(A, plan.pairs[i].own[2], 3, 3, own);
            for (int r = 3; r < SIX; ++r)
                for (int c = 0; c < 3; ++c) own[r][c] = 0;
        }
        for (size_t i = plan.pairs.size(); i-- > 0;) {
            const TreePlan::Pair& place = plan.pairs[i];
            TreeFactor::Pair& pair = factor.pairs[i];
            if (!factorize_own<S>(pair)) return;
            if (place.parent < 0) continue;
            for (int k = 0; k < 4; ++k) put(A, place.link[size_t(k)], 3 * (k % 2), 3 * (k / 2), pair.to_parent);
            eliminate<S>(pair, factor.pairs[size_t(place.parent)].own);
        }
        ok = true;
    }
};

struct SolveTree {
    const TreePlan& plan;
    const TreeFactor& factor;
    double* y;
    template <class S>
    FROND_INLINE void down() const {
        for (size_t i = plan.pairs.size(); i-- > 0;) {
            const TreeFactor::Pair& pair = factor.pairs[i];
            double* own = y + SIX * i;
            for (int k = 0; k + 1 < SIX; ++k) {
                Six<S> rest(own);
                rest.take_off(own[k], Six<S>(pair.own[k]));
                rest.put(own);
            }
            if (plan.pairs[i].parent < 0) continue;
            double* parent = y + SIX * size_t(plan.pairs[i].parent);
            Six<S> sum(parent);
            for (int k = 0; k < SIX; ++k) sum.take_off(own[k], Six<S>(pair.to_parent[k]));
            sum.put(parent);
        }
    }
    template <class S>
    FROND_INLINE void up() const {
        for (size_t i = 0; i < plan.pairs.size(); ++i) {
            const TreeFactor::Pair& pair = factor.pairs[i];
            double* own = y + SIX * i;
            for (int k = 0; k < SIX; ++k) own[k] *= pair.inverse[k];
            if (plan.pairs[i].parent >= 0) {
                const Six<S> parent(y + SIX * size_t(plan.pairs[i].parent));
                for (int k = 0; k < SIX; ++k) own[k] -= parent.dot(Six<S>(pair.to_parent[k]));
            }
            for (int k = SIX - 1; k-- > 0;) own[k] -= Six<S>(own).dot(Six<S>(pair.own[k]));
        }
    }
    template <class S>
    FROND_INLINE void run() const {
        down<S>();
        up<S>();
    }
};

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
    bool ok = false;
    run_in_lanes(FactorizeTree{plan, A, factor, ok});
    return ok;
}

void solve(const TreePlan& plan, const TreeFactor& factor, const VecX& b, VecX& x) {
    FROND_ASSERT(factor.pairs.size() == plan.pairs.size() && b.size() == SIX * Eigen::Index(plan.pairs.size()));
    x = b;
    run_in_lanes(SolveTree{plan, factor, x.data()});
}

void half_solve(const TreePlan& plan, TreeFactor& factor, const std::vector<NodeBlock>& right_side,
                NodeCompliance& compliance) {
    const size_t count = plan.pairs.size();
    if (factor.reached.size() != count) {
        factor.reached.assign(count, 0);
        factor.sparse.setZero(3, Eigen::Index(SIX * count));
    }
    // Only pairs on the paths from the given ones to their roots are not zero.
    std::vector<int> path;
    for (const NodeBlock& given : right_side) {
        FROND_ASSERT(given.node >= 0 && size_t(given.node) < 2 * count);
        for (int r = 0; r < 3; ++r) factor.sparse.col(3 * given.node + r) += given.block.row(r).transpose();
        for (int i = given.node / 2; i >= 0 && !factor.reached[size_t(i)]; i = plan.pairs[size_t(i)].parent) {
            factor.reached[size_t(i)] = 1;
            path.push_back(i);
        }
    }
    std::sort(path.begin(), path.end(), std::greater<>());
    compliance.rows.clear();
    compliance.left.resize(3, SIX * Eigen::Index(path.size()));
    compliance.right.resize(3, SIX * Eigen::Index(path.size()));
    for (const int i : path) {
        const TreeFactor::Pair& pair = factor.pairs[size_t(i)];
        const int parent = plan.pairs[size_t(i)].parent;
        auto own = factor.sparse.middleCols<SIX>(SIX * Eigen::Index(i));
        for (int r = 0; r < SIX; ++r) {
            for (int k = 0; k < r; ++k) own.col(r) -= pair.own[k][r] * own.col(k);
            const Eigen::Index at = Eigen::Index(compliance.rows.size());
            compliance.left.col(at) = own.col(r);
            compliance.right.col(at) = own.col(r) / pair.pivot[r];
            compliance.rows.push_back(SIX * (int(count) - 1 - i) + r);
            for (int c = 0; parent >= 0 && c < SIX; ++c)
                factor.sparse.col(SIX * Eigen::Index(parent) + c) -= pair.to_parent[r][c] * own.col(r);
        }
        own.setZero();
        factor.reached[size_t(i)] = 0;
    }
}

}  // namespace frond
