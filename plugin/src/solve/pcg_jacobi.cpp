// Conjugate gradients preconditioned by the diagonal, as in section 3.2 of the paper.
#include <cmath>

#include "solve/preconditioner.hpp"

namespace frond {

namespace {

// Returns false if a number of the diagonal is not above zero.
bool invert_diagonal(const BlockMatrix& A, LinearScratch& scratch) {
    const BlockPattern& pattern = *A.pattern;
    VecX& inverse = scratch.inverse_diagonal;
    inverse.resize(3 * pattern.node_count);
    for (int j = 0; j < pattern.node_count; ++j)
        for (int c = 0; c < 3; ++c) {
            const double d = A.values[9 * size_t(pattern.start[size_t(j)]) + size_t(4 * c)];
            if (!(d > 0) || !std::isfinite(d)) return false;
            inverse[3 * j + c] = 1 / d;
        }
    return true;
}

void apply_diagonal(const BlockMatrix&, const LinearScratch& scratch, const VecX& r, VecX& z) {
    z = scratch.inverse_diagonal.cwiseProduct(r);
}

}  // namespace

LinearResult solve_pcg_jacobi(const BlockMatrix& A, const VecX& b, const LinearLimits& limits, LinearScratch& scratch,
                              VecX& x) {
    return solve_pcg({invert_diagonal, apply_diagonal}, A, b, limits, scratch, x);
}

}  // namespace frond
