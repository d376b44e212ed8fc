// In: a deformation gradient F. Out: its rotation, without iteration on matrices and without a start value.
//
// The trace t of S = R^T F is the largest root of p(t) = t^4 - 2 |F|^2 t^2 - 8 det F t + 2 |F^T F|^2 - |F|^4, Horn's
// quartic for absolute orientation (Horn 1987, "Closed-form solution of absolute orientation using unit quaternions").
// Since R is the gradient of t with respect to F, differentiating p(t, F) = 0 gives R in closed form.
#include "mechanics/polar.hpp"

#include <Eigen/SVD>
#include <cmath>

namespace frond {

namespace {

// Slow and always right: the singular vectors, with the sign of the smallest value turned where F mirrors.
Mat3 rotation_by_svd(const Mat3& F) {
    const Eigen::JacobiSVD<Mat3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double sign = svd.matrixU().determinant() * svd.matrixV().determinant() < 0 ? -1.0 : 1.0;
    return svd.matrixU() * Vec3(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
}

}  // namespace

Polar polar_decomposition(const Mat3& F) {
    const Mat3 C = F.transpose() * F;
    Mat3 cofactor;
    cofactor.col(0) = F.col(1).cross(F.col(2));
    cofactor.col(1) = F.col(2).cross(F.col(0));
    cofactor.col(2) = F.col(0).cross(F.col(1));
    const double det = F.col(0).dot(cofactor.col(0));
    const double size = C.trace();  // |F|^2

    // Newton from above: sqrt(3) |F| bounds the trace and is exact for a rotation.
    const double c0 = 2 * C.squaredNorm() - size * size;
    double t = std::sqrt(3 * size);
    for (int iteration = 0; iteration < 30; ++iteration) {
        const double t2 = t * t;
        const double value = (t2 - 2 * size) * t2 - 8 * det * t + c0;
        const double slope = 4 * ((t2 - size) * t - 2 * det);
        const double step = value / slope;
        t -= step;
        if (!(std::abs(step) > 1e-9 * t)) break;  // the step after this one would be 1e-18
    }

    // This is twice the product of the gaps; where it is small the quotient would lose digits.
    const double slope = (t * t - size) * t - 2 * det;
    if (slope > 0.1 * size * std::sqrt(size) && size > 1e-60) {
        const Mat3 R = ((t * t + size) * F + 2 * t * cofactor - 2 * (F * C)) / slope;
        return {R, t, slope / 2, det};
    }

    // Turned inside out far enough that the rotation is about to jump, flattened to a line, or not finite.
    if (!std::isfinite(size)) return {Mat3::Constant(size - size), size - size, 0, det};
    const Mat3 R = rotation_by_svd(F);
    const double trace = R.cwiseProduct(F).sum();
    return {R, trace, 0.5 * ((trace * trace - size) * trace - 2 * det), det};
}

}  // namespace frond
