// Conjugate gradients preconditioned by an incomplete Cholesky factor on the matrix's own pattern of 3x3 blocks, IC(0)
// (Meijerink, van der Vorst 1977). If a block of the diagonal stops being positive definite, factorization starts anew
// with a larger shift of the diagonal (Manteuffel 1980, "An incomplete factorization technique for positive definite
// linear systems").
#include <Eigen/Cholesky>

#include "solve/preconditioner.hpp"

namespace frond {

namespace {

// Factorizes a column at a time and subtracts its products from the columns to its right. Blocks below the diagonal in
// `values` become those of L; blocks on the diagonal become the inverses of L's.
bool factorize_in_place(const BlockPattern& pattern, std::vector<double>& values) {
    const auto block = [&](int slot) { return Eigen::Map<Mat3>(values.data() + 9 * size_t(slot)); };
    for (int k = 0; k < pattern.node_count; ++k) {
        const int begin = pattern.start[size_t(k)], end = pattern.start[size_t(k) + 1];
        const Eigen::LLT<Mat3> factor{Mat3(block(begin))};
        if (factor.info() != Eigen::Success) return false;
        const Mat3 inverse = factor.matrixL().solve(Mat3::Identity());
        if (!inverse.allFinite()) return false;
        block(begin) = inverse;
        for (int s = begin + 1; s < end; ++s) block(s) = Mat3(block(s) * inverse.transpose());

        // Updates only blocks of the pattern: both columns are in order, so one pass finds them.
        for (int s = begin + 1; s < end; ++s) {
            const int j = pattern.row[size_t(s)], last = pattern.start[size_t(j) + 1];
            const Mat3 right = block(s).transpose();
            int t = pattern.start[size_t(j)];
            for (int r = s; r < end; ++r) {
                while (t < last && pattern.row[size_t(t)] < pattern.row[size_t(r)]) ++t;
                if (t == last) break;
                if (pattern.row[size_t(t)] == pattern.row[size_t(r)]) block(t) -= Mat3(block(r) * right);
            }
        }
    }
    return true;
}

// Returns false if no shift helps, or a block of the diagonal is not positive definite from the start.
bool factorize_incompletely(const BlockMatrix& A, LinearScratch& scratch) {
    constexpr double FIRST_SHIFT = 1e-3, LAST_SHIFT = 10;  // of the diagonal, by its own size [-]
    const BlockPattern& pattern = *A.pattern;
    for (int j = 0; j < pattern.node_count; ++j) {
        const Mat3 block = A.block(pattern.start[size_t(j)]);
        if (!block.allFinite() || Eigen::LLT<Mat3>(block).info() != Eigen::Success) return false;
    }
    for (double shift = 0; shift <= LAST_SHIFT; shift = shift > 0 ? 2 * shift : FIRST_SHIFT) {
        scratch.incomplete.assign(A.values.begin(), A.values.end());
        for (int start : pattern.start)
            if (start < pattern.block_count())
                for (size_t c = 0; c < 9; c += 4) scratch.incomplete[9 * size_t(start) + c] *= 1 + shift;
        if (factorize_in_place(pattern, scratch.incomplete)) return true;
    }
    return false;
}

// Computes z = L^-T L^-1 r.
void apply_incomplete_factor(const BlockMatrix& A, const LinearScratch& scratch, const VecX& r, VecX& z) {
    const BlockPattern& pattern = *A.pattern;
    const auto block = [&](int slot) { return Eigen::Map<const Mat3>(scratch.incomplete.data() + 9 * size_t(slot)); };
    z = r;
    for (int k = 0; k < pattern.node_count; ++k) {
        const int begin = pattern.start[size_t(k)], end = pattern.start[size_t(k) + 1];
        const Vec3 zk = block(begin) * point(z, k);
        point(z, k) = zk;
        for (int s = begin + 1; s < end; ++s) point(z, pattern.row[size_t(s)]) -= block(s) * zk;
    }
    for (int k = pattern.node_count - 1; k >= 0; --k) {
        const int begin = pattern.start[size_t(k)], end = pattern.start[size_t(k) + 1];
        Vec3 zk = point(z, k);
        for (int s = begin + 1; s < end; ++s) zk -= block(s).transpose() * point(z, pattern.row[size_t(s)]);
        point(z, k) = block(begin).transpose() * zk;
    }
}

}  // namespace

LinearResult solve_pcg_incomplete_cholesky(const BlockMatrix& A, const VecX& b, const LinearLimits& limits,
                                           LinearScratch& scratch, VecX& x) {
    return solve_pcg({factorize_incompletely, apply_incomplete_factor}, A, b, limits, scratch, x);
}

}  // namespace frond
