// In: matrices, one a lane, right-hand sides and solutions. Out: the relative residual of each.
#include <cmath>
#include <limits>

#include "batch/batch_step.hpp"
#include "core/lane_vectors.hpp"

namespace frond {

namespace {

struct FindResiduals {
    const BlockMatrix& A;
    const NumbersInLines &b, &x;
    NumbersInLines& left;
    double* out;
    template <class S>
    FROND_INLINE void run() const {
        const BlockPattern& pattern = *A.pattern;
        left = b;
        for (int j = 0; j < pattern.node_count; ++j) {
            const Lanes3<S> x_j = load3<S>(x.data(), 3 * j);
            Lanes3<S> left_j = load3<S>(left.data(), 3 * j);
            for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; ++k) {
                const int i = pattern.row[size_t(k)];
                const double* a = A.values.data() + LANES<S> * 9 * size_t(k);
                // Blocks are stored by columns, so read as rows this is the transpose.
                const Lanes33<S> over = {{load3<S>(a, 0), load3<S>(a, 3), load3<S>(a, 6)}};
                if (i == j) {
                    left_j = left_j - transposed_times(over, x_j);
                    continue;
                }
                store3(load3<S>(left.data(), 3 * i) - transposed_times(over, x_j), left.data(), 3 * i);
                left_j = left_j - over * load3<S>(x.data(), 3 * i);
            }
            store3(left_j, left.data(), 3 * j);
        }
        S rest = {}, all = {};
        for (int i = 0; i < pattern.node_count; ++i) {
            const Lanes3<S> of_rest = load3<S>(left.data(), 3 * i), of_all = load3<S>(b.data(), 3 * i);
            rest += dot(of_rest, of_rest);
            all += dot(of_all, of_all);
        }
        for (int lane = 0; lane < LANES<S>; ++lane)
            out[lane] = all[lane] > 0     ? std::sqrt(rest[lane] / all[lane])
                        : rest[lane] == 0 ? 0
                                          : std::numeric_limits<double>::infinity();
    }
};

}  // namespace

void relative_residuals(const BlockMatrix& A, const NumbersInLines& b, const NumbersInLines& x, NumbersInLines& left,
                        double* out) {
    run_in_lanes(A.lanes(), FindResiduals{A, b, x, left, out});
}

}  // namespace frond
