// Conjugate gradients preconditioned by the 3x3 blocks of the diagonal (Saad 2003, "Iterative methods", 4.1.1).
#include <Eigen/Cholesky>

#include "solve/preconditioner.hpp"

namespace frond {

namespace {

// Returns false if a block of the diagonal is not positive definite.
bool invert_blocks(const BlockMatrix& A, LinearScratch& scratch) {
    const BlockPattern& pattern = *A.pattern;
    scratch.inverse_blocks.resize(9 * size_t(pattern.node_count));
    for (int j = 0; j < pattern.node_count; ++j) {
        const Mat3 block = A.block(pattern.start[size_t(j)]);
        const Eigen::LLT<Mat3> factor(block);
        if (!block.allFinite() || factor.info() != Eigen::Success) return false;
        Eigen::Map<Mat3>(scratch.inverse_blocks.data() + 9 * size_t(j)) = factor.solve(Mat3::Identity());
    }
    return true;
}

void apply_blocks(const BlockMatrix& A, const LinearScratch& scratch, const VecX& r, VecX& z) {
    z.resize(r.size());
    for (int j = 0; j < A.pattern->node_count; ++j)
        point(z, j) = Eigen::Map<const Mat3>(scratch.inverse_blocks.data() + 9 * size_t(j)) * point(r, j);
}

}  // namespace

LinearResult solve_pcg_block_jacobi(const BlockMatrix& A, const VecX& b, const LinearLimits& limits,
                                    LinearScratch& scratch, VecX& x) {
    return solve_pcg({invert_blocks, apply_blocks}, A, b, limits, scratch, x);
}

}  // namespace frond
