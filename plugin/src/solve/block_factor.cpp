// In: a symmetric matrix of 3x3 blocks. Out: its factors L D L^T and solutions, by a tree if it is one, else by fronts.
#include "solve/block_factor.hpp"

#include "solve/linear_solver.hpp"

namespace frond {

BlockPlan make_block_plan(const BlockPattern& pattern) {
    BlockPlan plan;
    plan.tree = make_tree_plan(pattern);
    if (!plan.tree) plan.fronts = make_front_plan(pattern);
    return plan;
}

unsigned factorize_lanes(BlockFactor& factor, const BlockMatrix& A) {
    const BlockPlan& plan = *factor.plan;
    return plan.tree ? factorize(*plan.tree, A, factor.tree) : factorize(plan.fronts, A, factor.fronts);
}

bool factorize(BlockFactor& factor, const BlockMatrix& A) {
    return factorize_lanes(factor, A) == 0;
}

void solve(BlockFactor& factor, double* x) {
    const BlockPlan& plan = *factor.plan;
    return plan.tree ? solve(*plan.tree, factor.tree, x) : solve(plan.fronts, factor.fronts, x);
}

void solve(BlockFactor& factor, const VecX& b, VecX& x) {
    x = b;
    solve(factor, x.data());
}

void half_solve(BlockFactor& factor, const std::vector<NodeBlock>& right_side, NodeCompliance& compliance) {
    const BlockPlan& plan = *factor.plan;
    return plan.tree ? half_solve(*plan.tree, factor.tree, right_side, compliance)
                     : half_solve(plan.fronts, factor.fronts, right_side, compliance);
}

LinearResult solve_block(const BlockMatrix& A, const VecX& b, const LinearLimits&, LinearScratch& scratch, VecX& x) {
    scratch.has_factor = factorize(scratch.block, A);
    if (!scratch.has_factor) return {};
    solve(scratch.block, b, x);
    return checked_once(A, b, x, scratch);
}

}  // namespace frond
