// LinearSolver: solves A x = b for a symmetric matrix of 3x3 blocks; rows of a table indexed by frond_linear_solver.
#pragma once

#include "frond/frond.h"
#include "mechanics/block_matrix.hpp"
#include "solve/block_factor.hpp"
#include "solve/direct.hpp"

namespace frond {

struct LinearLimits {
    int max_iterations;
    double tolerance;  // relative residual [-]
};

struct LinearResult {
    bool ok = false;         // false: A is not positive definite, or not finite; x is unusable
    bool converged = false;  // reached the tolerance
    int iterations = 0;      // a direct solve counts as one
    double residual = 0;     // |b - A x| / |b|, computed from x itself
};

// Scratch, kept from solve to solve; each solver uses its own part.
struct LinearScratch {
    BlockFactor block;
    bool has_factor = false;  // `block` is of the last solve's matrix
    DirectFactorPtr direct;   // made at first use
    VecX product, residual, direction, preconditioned, inverse_diagonal;
    std::vector<double> inverse_blocks;  // inverses of diagonal blocks, 9 numbers a node
    std::vector<double> incomplete;      // factor on the matrix's own pattern, 9 numbers a block
};

struct LinearSolver {
    const char* name;
    LinearResult (*solve)(const BlockMatrix& A, const VecX& b, const LinearLimits& limits, LinearScratch& scratch,
                          VecX& x);
};
const LinearSolver& linear_solver(frond_linear_solver which);

// Solves by one of the solvers.
LinearResult solve_linear(frond_linear_solver which, const BlockMatrix& A, const VecX& b, const LinearLimits& limits,
                          LinearScratch& scratch, VecX& x);
// Makes the block factor of the last solve's matrix, unless it is there: responses to contacts are many solves with one
// matrix, whatever solved the step. False if there is none.
bool make_factor(const BlockMatrix& A, LinearScratch& scratch);

// The rows.
LinearResult solve_block(const BlockMatrix&, const VecX& b, const LinearLimits&, LinearScratch&, VecX& x);
LinearResult solve_direct(const BlockMatrix&, const VecX& b, const LinearLimits&, LinearScratch&, VecX& x);
LinearResult solve_pcg_jacobi(const BlockMatrix&, const VecX& b, const LinearLimits&, LinearScratch&, VecX& x);
LinearResult solve_pcg_block_jacobi(const BlockMatrix&, const VecX& b, const LinearLimits&, LinearScratch&, VecX& x);
LinearResult solve_pcg_incomplete_cholesky(const BlockMatrix&, const VecX& b, const LinearLimits&, LinearScratch&,
                                           VecX& x);

// Returns |b - A x| / |b| and leaves b - A x in `residual`. Zero for b = 0 and x = 0.
double relative_residual(const BlockMatrix& A, const VecX& b, const VecX& x, VecX& residual);
// Returns the result of a direct solve, with its residual.
LinearResult checked_once(const BlockMatrix& A, const VecX& b, const VecX& x, LinearScratch& scratch);

}  // namespace frond
