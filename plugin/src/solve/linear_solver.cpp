// The table of linear solvers: one row for each name in FROND_LINEAR_SOLVERS.
#include "solve/linear_solver.hpp"

#include <cmath>
#include <limits>

namespace frond {

const LinearSolver& linear_solver(frond_linear_solver which) {
    static const LinearSolver TABLE[] = {
        {"block", solve_block},
        {"direct", solve_direct},
        {"pcg_jacobi", solve_pcg_jacobi},
        {"pcg_block_jacobi", solve_pcg_block_jacobi},
        {"pcg_incomplete_cholesky", solve_pcg_incomplete_cholesky},
    };
    static_assert(sizeof TABLE / sizeof TABLE[0] == FROND_LINEAR_SOLVER_COUNT, "every linear solver needs its row");
    return TABLE[which];
}

LinearResult solve_linear(frond_linear_solver which, const BlockMatrix& A, const VecX& b, const LinearLimits& limits,
                          LinearScratch& scratch, VecX& x) {
    scratch.has_factor = false;
    return linear_solver(which).solve(A, b, limits, scratch, x);
}

bool make_factor(const BlockMatrix& A, LinearScratch& scratch) {
    if (!scratch.has_factor) scratch.has_factor = factorize(scratch.block, A);
    return scratch.has_factor;
}

double relative_residual(const BlockMatrix& A, const VecX& b, const VecX& x, VecX& residual) {
    A.multiply(x, residual);
    residual = b - residual;
    const double left = residual.norm(), all = b.norm();
    if (all > 0) return left / all;
    return left == 0 ? 0 : std::numeric_limits<double>::infinity();
}

LinearResult checked_once(const BlockMatrix& A, const VecX& b, const VecX& x, LinearScratch& scratch) {
    LinearResult result;
    result.iterations = 1;
    result.residual = relative_residual(A, b, x, scratch.residual);
    result.ok = result.converged = std::isfinite(result.residual);
    return result;
}

}  // namespace frond
