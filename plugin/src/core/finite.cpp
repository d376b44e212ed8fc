// In: numbers. Out: whether all of them are finite.
#include "core/lanes.hpp"
#include "core/types.hpp"

namespace frond {

namespace {

// Zero times a number that is not finite is NaN, and so is any sum with NaN.
struct AddNothing {
    const VecX& x;
    double& sum;
    template <class S>
    FROND_INLINE void run() const {
        constexpr Eigen::Index AT_ONCE = 4 * LANES<S>;  // four sums wait for nothing
        const Eigen::Index count = x.size();
        S sums[4] = {};
        Eigen::Index k = 0;
        for (; k + AT_ONCE <= count; k += AT_ONCE)
            for (int part = 0; part < 4; part++) sums[part] += S{} * load<S>(x.data() + k + part * LANES<S>);
        const S all = (sums[0] + sums[1]) + (sums[2] + sums[3]);
        for (int lane = 0; lane < LANES<S>; lane++) sum += all[lane];
        for (; k < count; k++) sum += 0 * x[k];
    }
};

}  // namespace

bool are_finite(const VecX& x) {
    double sum = 0;
    run_in_lanes(AddNothing{x, sum});
    return sum == 0;
}

}  // namespace frond
