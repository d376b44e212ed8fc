// In: the factor of a tree's matrix and a right-hand side of few nodes. Out: its half-solve.
#include <algorithm>
#include <functional>

#include "core/assert.hpp"
#include "solve/tree_factor.hpp"

namespace frond {

void half_solve(const TreePlan& plan, TreeFactor& factor, const std::vector<NodeBlock>& right_side,
                NodeCompliance& compliance) {
    FROND_ASSERT(factor.lanes == 1);
    const size_t count = plan.pairs.size();
    if (factor.reached.size() != count) {
        factor.reached.assign(count, 0);
        factor.sparse.setZero(4, Eigen::Index(SIX * count));
    }
    // Only pairs on the paths from the given ones to their roots are not zero.
    std::vector<int> path;
    for (const NodeBlock& given : right_side) {
        FROND_ASSERT(given.node >= 0 && size_t(given.node) < 2 * count);
        for (int r = 0; r < 3; ++r) factor.sparse.col(3 * given.node + r).head<3>() += given.block.row(r).transpose();
        for (int i = given.node / 2; i >= 0 && !factor.reached[size_t(i)]; i = plan.pairs[size_t(i)].parent) {
            factor.reached[size_t(i)] = 1;
            path.push_back(i);
        }
    }
    std::sort(path.begin(), path.end(), std::greater<>());
    compliance.rows.clear();
    compliance.left.resize(4, SIX * Eigen::Index(path.size()));
    compliance.right.resize(4, SIX * Eigen::Index(path.size()));
    for (const int i : path) {
        const double* pair = factor.numbers.data() + TreeFactor::NUMBERS * size_t(i);
        const int parent = plan.pairs[size_t(i)].parent;
        auto own = factor.sparse.middleCols<SIX>(SIX * Eigen::Index(i));
        for (int r = 0; r < SIX; ++r) {
            for (int k = 0; k < r; ++k) own.col(r) -= pair[TreeFactor::OWN + SIX * k + r] * own.col(k);
            const Eigen::Index at = Eigen::Index(compliance.rows.size());
            compliance.left.col(at) = own.col(r);
            compliance.right.col(at) = own.col(r) / factor.pivot[SIX * i + r];
            compliance.rows.push_back(SIX * (int(count) - 1 - i) + r);
            for (int c = 0; parent >= 0 && c < SIX; ++c)
                factor.sparse.col(SIX * Eigen::Index(parent) + c) -=
                    pair[TreeFactor::TO_PARENT + SIX * r + c] * own.col(r);
        }
        own.setZero();
        factor.reached[size_t(i)] = 0;
    }
}

}  // namespace frond
