// In: a deformation gradient F. Out: its rotation, without matrix iterations or a start value where F is well
// conditioned, else by singular values.
#include "mechanics/polar.hpp"

#include <cmath>

#include "core/decompose.hpp"
#include "mechanics/polar_lanes.hpp"

namespace frond {

Polar polar_decomposition(const Mat3& F) {
    const PolarLanes<double> polar = polar_in_lanes(one_lane(F));
    return {lane_of(polar.rotation, 0), polar.trace, polar.gaps, polar.determinant};
}

// Combines the singular vectors, with the smallest value's sign flipped where F is a reflection.
Polar polar_by_values(const Mat3& F) {
    const double size = F.squaredNorm(), det = F.determinant();
    if (!std::isfinite(size)) return {Mat3::Constant(size - size), size - size, 0, det};
    const SingularParts svd = singular_parts(F);
    const double sign = svd.U.determinant() * svd.V.determinant() < 0 ? -1.0 : 1.0;
    const Mat3 R = svd.U * Vec3(1, 1, sign).asDiagonal() * svd.V.transpose();
    const double trace = R.cwiseProduct(F).sum();
    return {R, trace, 0.5 * ((trace * trace - size) * trace - 2 * det), det};
}

}  // namespace frond
