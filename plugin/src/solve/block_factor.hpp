// BlockFactor: Frond's own direct solver for symmetric matrices of 3x3 blocks: of pairs of nodes that hang together as
// a tree, as those of rods do (tree_factor.hpp), or of any pattern (fronts.hpp).
#pragma once

#include "solve/fronts.hpp"
#include "solve/tree_factor.hpp"

namespace frond {

// Found once for a pattern, and shared by all of its matrices.
struct BlockPlan {
    std::optional<TreePlan> tree;
    FrontPlan fronts;  // where it is no tree
};
BlockPlan make_block_plan(const BlockPattern& pattern);

// Of one matrix. The plan must live longer.
struct BlockFactor {
    const BlockPlan* plan = nullptr;
    TreeFactor tree;
    FrontFactor fronts;
};
// False if a pivot is not above zero: A is not positive definite.
bool factorize(BlockFactor& factor, const BlockMatrix& A);
// x = A^-1 b with the matrix factorized last.
void solve(BlockFactor& factor, const VecX& b, VecX& x);
// Half of a solve: with A = P' L D L' P and a right side B of few nodes, L^-1 P B where it is not zero, and that over
// D.
void half_solve(BlockFactor& factor, const std::vector<NodeBlock>& right_side, NodeCompliance& compliance);

}  // namespace frond
