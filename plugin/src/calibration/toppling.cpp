#include "calibration/toppling.hpp"

#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"

namespace frond {

void take_by_weight(const Elements& elements, const Mechanics& row, const VecX& x, BlockMatrix& taken) {
    taken.set_zero();
    row.add_stiffness(elements, x, Tangent::positive, 1, taken);
    row.add_stiffness(elements, x, Tangent::exact, -1, taken);
}

void hold(const std::vector<uint8_t>& held, VecX& x) {
    for (size_t i = 0; i < held.size(); i++)
        if (held[i]) point(x, int(i)).setZero();
}

// Uses power iteration, the value by Rayleigh's quotient. Parts under tension have negative eigenvalues; if one of
// these is largest, they are shifted away.
Toppling find_toppling(StaticStiffness& resisting, const BlockMatrix& taken, const std::vector<uint8_t>& held) {
    constexpr int ROUNDS = 200;     // of a power iteration, which ends when it is close
    constexpr double CLOSE = 1e-4;  // change of the value in a round [-]
    const Eigen::Index size = 3 * Eigen::Index(held.size());
    VecX product(size), solution(size);
    for (double shift = 0;;) {
        // Begin with the shape into which forces in all directions bend the body.
        VecX mode(size);
        for (Eigen::Index i = 0; i < size; i++) product[i] = frond::sin(double(i + 1));
        hold(held, product);
        solve(resisting.factor, product, mode);
        double value = 0, before = INFINITY;
        for (int round = 0; round < ROUNDS; round++) {
            mode.normalize();
            taken.multiply(mode, product);
            hold(held, product);
            const double work = mode.dot(product);
            resisting.K.multiply(mode, solution);
            value = work / mode.dot(solution);
            if (!std::isfinite(value)) return {};
            if (std::abs(value - before) < CLOSE * std::abs(value)) break;
            before = value;
            solve(resisting.factor, product, solution);
            mode = solution + shift * mode;
        }
        if (value >= 0 || shift > 0) return {mode, value};
        shift = -value;
    }
}

std::vector<double> find_shares(const Toppling& toppling, StaticStiffness& resisting, const BlockMatrix& taken,
                                const std::vector<uint8_t>& held, size_t organ_count,
                                const std::function<void(const VecX& move, std::vector<double>& work)>& add_work) {
    // One more solve, with the load that weight makes in the motion, removes the noise that stiff organs feel most.
    VecX product(toppling.mode.size()), smooth(toppling.mode.size());
    taken.multiply(toppling.mode, product);
    hold(held, product);
    solve(resisting.factor, product, smooth);
    std::vector<double> shares(organ_count, 0.0);
    add_work(smooth, shares);
    const double whole = smooth.dot(product);
    for (double& share : shares) share /= whole;
    return shares;
}

std::vector<double> stiffer_by(const std::vector<double>& shares, double overload) {
    constexpr double MUCH = 0.3;                  // over the largest share [-]
    constexpr double MARGIN = 1.02, LARGEST = 8;  // factors beyond what is lacking, and at most in a round [-]
    const double least = MUCH * *std::max_element(shares.begin(), shares.end());
    double together = 0;
    for (double share : shares)
        if (share >= least) together += share;
    const double factor = std::min(frond::pow(MARGIN * std::max(overload, 1.0), 1 / together), LARGEST);
    std::vector<double> stiffer;
    for (double share : shares) stiffer.push_back(share >= least ? factor : 1.0);
    return stiffer;
}

}  // namespace frond
