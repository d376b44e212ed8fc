// In: a symmetric positive definite matrix of 3x3 blocks and a preconditioner. Out: solutions by conjugate gradients,
// as in section 3.2 of the paper (Hestenes, Stiefel 1952; Saad 2003, "Iterative methods", algorithm 9.1).
#include <cmath>

#include "solve/preconditioner.hpp"

namespace frond {

namespace {

enum class Outcome { small, limit, broken };

// Iterates from x with residual r = b - A x until |r|, by the recurrence for r, is at most `goal`.
Outcome iterate(const Preconditioner& preconditioner, const BlockMatrix& A, double goal, int max_iterations,
                LinearScratch& s, VecX& x, int& iterations) {
    VecX &r = s.residual, &z = s.preconditioned, &p = s.direction, &q = s.product;
    preconditioner.apply(A, s, r, z);
    p = z;
    double rz = r.dot(z);
    while (iterations < max_iterations) {
        A.multiply(p, q);
        const double curvature = p.dot(q);
        if (!(curvature > 0) || !std::isfinite(curvature)) return Outcome::broken;
        const double alpha = rz / curvature;
        x += alpha * p;
        r -= alpha * q;
        ++iterations;
        if (r.norm() <= goal) return Outcome::small;
        preconditioner.apply(A, s, r, z);
        const double rz_next = r.dot(z);
        p = z + (rz_next / rz) * p;
        rz = rz_next;
    }
    return Outcome::limit;
}

}  // namespace

LinearResult solve_pcg(const Preconditioner& preconditioner, const BlockMatrix& A, const VecX& b,
                       const LinearLimits& limits, LinearScratch& s, VecX& x) {
    LinearResult result;
    x.setZero(b.size());
    const double size = b.norm();
    if (!preconditioner.make(A, s) || !std::isfinite(size)) return result;
    result.ok = true;
    s.residual = b;
    result.residual = size > 0 ? 1 : 0;
    result.converged = size == 0;

    // The recurrence drifts from the true residual, so start again from the true one as long as that helps.
    while (!result.converged && result.iterations < limits.max_iterations) {
        const double before = result.residual;
        const Outcome outcome =
            iterate(preconditioner, A, limits.tolerance * size, limits.max_iterations, s, x, result.iterations);
        result.residual = relative_residual(A, b, x, s.residual);
        result.converged = result.residual <= limits.tolerance;
        if (outcome == Outcome::broken) result.ok = result.converged;
        if (outcome == Outcome::broken || !(result.residual < 0.5 * before)) break;
    }
    if (!x.allFinite()) result.ok = false;
    return result;
}

}  // namespace frond
