// BlockFactor: Frond's own direct solver for symmetric matrices of 3x3 blocks: of pairs of nodes connected as a tree,
// as in rods (tree_factor.hpp), or of any pattern (fronts.hpp).
#pragma once

#include "solve/fronts.hpp"
#include "solve/tree_factor.hpp"

namespace frond {

// Made once for a pattern, and shared by all of its matrices.
struct BlockPlan {
    std::optional<TreePlan> tree;
    FrontPlan fronts;  // used where it is no tree
};
BlockPlan make_block_plan(const BlockPattern& pattern);

// Factor of one matrix, or of several, one a lane. The plan must outlive it.
struct BlockFactor {
    const BlockPlan* plan = nullptr;
    TreeFactor tree;
    FrontFactor fronts;
};
// Returns a bit for each lane of which a pivot is not above zero: A is not positive definite.
unsigned factorize_lanes(BlockFactor& factor, const BlockMatrix& A);
// Factorizes one matrix. Returns false if it is not positive definite.
bool factorize(BlockFactor& factor, const BlockMatrix& A);
// Turns right-hand sides into solutions of A x = b with the matrices factorized last.
void solve(BlockFactor& factor, double* x);
void solve(BlockFactor& factor, const VecX& b, VecX& x);
// Does half of a solve: with A = P' L D L' P and a right-hand side B of few nodes, finds the rows of L^-1 P B that are
// not zero, and these over D.
void half_solve(BlockFactor& factor, const std::vector<NodeBlock>& right_side, NodeCompliance& compliance);

}  // namespace frond
