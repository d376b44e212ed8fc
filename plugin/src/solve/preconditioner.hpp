// Preconditioner: an approximate inverse of a matrix, for conjugate gradients.
#pragma once

#include "solve/linear_solver.hpp"

namespace frond {

struct Preconditioner {
    // Makes it from A in the solver's scratch; returns false if A is found not to be positive definite, or not finite.
    bool (*make)(const BlockMatrix& A, LinearScratch& scratch);
    // Computes z = P^-1 r.
    void (*apply)(const BlockMatrix& A, const LinearScratch& scratch, const VecX& r, VecX& z);
};

LinearResult solve_pcg(const Preconditioner& preconditioner, const BlockMatrix& A, const VecX& b,
                       const LinearLimits& limits, LinearScratch& scratch, VecX& x);

}  // namespace frond
