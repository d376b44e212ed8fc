// The table of linear solvers: one row for each name in FROND_LINEAR_SOLVERS.
#include "solve/linear_solver.hpp"

#include <cmath>
#include <limits>

namespace frond {

const LinearSolver& linear_solver(frond_linear_solver which) {
    static const LinearSolver TABLE[] = {
        {"block", solve_block, solve_block_again, half_solve_block},
        {"direct", solve_direct, solve_direct_again, nullptr},
        {"pcg_jacobi", solve_pcg_jacobi, solve_pcg_jacobi, nullptr},
        {"pcg_block_jacobi", solve_pcg_block_jacobi, solve_pcg_block_jacobi, nullptr},
        {"pcg_incomplete_cholesky", solve_pcg_incomplete_cholesky, solve_pcg_incomplete_cholesky, nullptr},
    };
    static_assert(sizeof TABLE / sizeof TABLE[0] == FROND_LINEAR_SOLVER_COUNT, "every linear solver needs its row");
    return TABLE[which];
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

LinearResult unchecked(const VecX& x) {
    LinearResult result;
    result.iterations = 1;
    result.ok = result.converged = are_finite(x);
    return result;
}

}  // namespace frond
