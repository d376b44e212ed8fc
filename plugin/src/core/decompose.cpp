#include "core/decompose.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"

namespace frond {

SymmetricParts symmetric_parts(const Mat3& A) {
    const Eigen::SelfAdjointEigenSolver<Mat3> parts(A);
    return {parts.eigenvalues(), parts.eigenvectors()};
}

Vec3 symmetric_values(const Mat3& A) {
    return Eigen::SelfAdjointEigenSolver<Mat3>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

double largest_symmetric_value(const Mat3& A) {
    const double middle = A.trace() / 3;
    const Mat3 rest = A - middle * Mat3::Identity();
    const double spread = std::sqrt(rest.squaredNorm() / 6);
    if (spread == 0) return middle;
    const double cosine = std::clamp((rest / spread).determinant() / 2, -1.0, 1.0);
    return middle + 2 * spread * frond::cos(frond::acos(cosine) / 3);
}

SymmetricParts2 symmetric_parts_2(const Eigen::Matrix2d& A) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> parts(A);
    return {parts.eigenvalues(), parts.eigenvectors()};
}

SingularParts singular_parts(const Mat3& A) {
    const Eigen::JacobiSVD<Mat3> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
    return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

Quat turn_between(const Vec3& from, const Vec3& to) {
    constexpr double OPPOSITE = 1e-12;  // one plus the cosine below which the axis is any across [-]
    const Vec3 a = from.normalized(), b = to.normalized();
    const double cosine = b.dot(a);
    if (cosine < OPPOSITE - 1) {
        int least;
        a.cwiseAbs().minCoeff(&least);
        const Vec3 across = a.cross(Vec3::Unit(least)).normalized();
        return Quat(0, across.x(), across.y(), across.z());
    }
    const double twice = std::sqrt((1 + cosine) * 2);
    const Vec3 axis = a.cross(b) * (1 / twice);
    return Quat(0.5 * twice, axis.x(), axis.y(), axis.z());
}

}  // namespace frond
