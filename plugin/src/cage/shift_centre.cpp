#include "cage/shift_centre.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"

namespace frond {

// Newton's method for the exponents. The square of what is missing is added to the variances: a centre that is out of
// reach, beside a line of places, then changes next to nothing.
void shift_centre(const std::vector<Vec3>& places, const Vec3& wanted, std::vector<double>& masses) {
    constexpr int ROUNDS = 4;
    double whole = 0;
    for (double mass : masses) whole += mass;
    if (!(whole > 0)) return;
    for (int round = 0; round < ROUNDS; round++) {
        Vec3 moment = Vec3::Zero();
        for (size_t i = 0; i < places.size(); i++) moment += masses[i] * (places[i] - wanted);
        const Vec3 missing = -moment / whole, centre = wanted - missing;
        Mat3 spread = missing.squaredNorm() * Mat3::Identity();
        for (size_t i = 0; i < places.size(); i++) {
            const Vec3 off = places[i] - centre;
            spread += masses[i] / whole * off * off.transpose();
        }
        if (!(missing.norm() > 1e-9 * std::sqrt(spread.trace()))) return;
        Vec3 slope = spread.ldlt().solve(missing);
        double steepest = 1;
        for (const Vec3& place : places) steepest = std::max(steepest, std::abs(slope.dot(place - centre)));
        slope /= steepest;
        double sum = 0;
        for (size_t i = 0; i < places.size(); i++) sum += masses[i] *= frond::exp(slope.dot(places[i] - centre));
        for (double& mass : masses) mass *= whole / sum;
    }
}

}  // namespace frond
