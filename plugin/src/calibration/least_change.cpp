// Dual of ridge regression: with few rows, x = S' (S S' + r I)^-1 b costs one small factor. Components of x that would
// leave their bounds are put on them, and the rest is solved again, until none does.
#include "calibration/least_change.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace frond {

VecX least_change(const MatX& slope, const VecX& wanted, const VecX& least, const VecX& most, double rigid) {
    constexpr int PASSES = 12;  // in each of which some reach their bounds and are fixed
    const Eigen::Index count = slope.cols(), rows = slope.rows();
    VecX x = VecX::Zero(count), rest = wanted;
    std::vector<char> fixed(size_t(count), 0);
    MatX A = rigid / double(count) * MatX::Identity(rows, rows);
    A.selfadjointView<Eigen::Lower>().rankUpdate(slope);
    for (int pass = 0; pass < PASSES; pass++) {
        const VecX multipliers = A.selfadjointView<Eigen::Lower>().ldlt().solve(rest);
        const VecX free = slope.transpose() * multipliers;
        bool within = true;
        for (Eigen::Index i = 0; i < count; i++) {
            if (fixed[size_t(i)]) continue;
            x[i] = std::clamp(free[i], least[i], most[i]);
            if (x[i] == free[i]) continue;
            fixed[size_t(i)] = 1;
            rest -= slope.col(i) * x[i];
            A.selfadjointView<Eigen::Lower>().rankUpdate(slope.col(i), -1);
            within = false;
        }
        if (within) break;
    }
    return x;
}

}  // namespace frond
