// Rotations as rotation vectors: axis times angle [rad].
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/elementary.hpp"

namespace frond {

template <class S>
using Vec3of = Eigen::Matrix<S, 3, 1>;
template <class S>
using Mat3of = Eigen::Matrix<S, 3, 3>;

// Returns the matrix of the cross product with v.
template <class S>
Mat3of<S> cross_matrix(const Vec3of<S>& v) {
    Mat3of<S> m;
    m << S(0), -v[2], v[1], v[2], S(0), -v[0], -v[1], v[0], S(0);
    return m;
}

// Returns I + a [v] + b [v]^2, [v] being cross_matrix(v).
template <class S>
Mat3of<S> rotation_series(const Vec3of<S>& v, const S& a, const S& b) {
    const Mat3of<S> K = cross_matrix(v);
    const Mat3of<S> square = K * K;
    Mat3of<S> m = a * K + b * square;
    m.diagonal().array() += S(1);
    return m;
}

// Returns the rotation matrix of a rotation vector: Rodrigues' formula.
template <class S>
Mat3of<S> rotation_of(const Vec3of<S>& v) {
    using frond::cos;
    using frond::sin;
    using std::sqrt;
    const S square = v.squaredNorm();
    if (square < 1e-8) return rotation_series<S>(v, S(1) - square / 6., S(0.5) - square / 24.);
    const S angle = sqrt(square), half = sin(0.5 * angle);
    return rotation_series<S>(v, sin(angle) / angle, 2. * half * half / square);
}

// Returns T(v), which gives the angular velocity in the spatial frame by the rate of the vector: w = T(v) dv/dt.
template <class S>
Mat3of<S> rate_matrix(const Vec3of<S>& v) {
    using frond::sin;
    using std::sqrt;
    const S square = v.squaredNorm();
    if (square < 1e-8) return rotation_series<S>(v, S(0.5) - square / 24., S(1. / 6) - square / 120.);
    const S angle = sqrt(square), half = sin(0.5 * angle);
    return rotation_series<S>(v, 2. * half * half / square, (angle - sin(angle)) / (square * angle));
}

// Returns the inverse of rate_matrix(), from angular velocity to the vector's rate; unbounded as the angle nears 2 pi.
template <class S>
Mat3of<S> inverse_rate_matrix(const Vec3of<S>& v) {
    using frond::tan;
    using std::sqrt;
    const S square = v.squaredNorm();
    if (square < 1e-8) return rotation_series<S>(v, S(-0.5), S(1. / 12) + square / 720.);
    const S half = 0.5 * sqrt(square);
    return rotation_series<S>(v, S(-0.5), (S(1) - half / tan(half)) / square);
}

// Returns the vector of a rotation matrix, of an angle up to pi: through the quaternion, well conditioned everywhere.
template <class S>
Vec3of<S> rotation_vector(const Mat3of<S>& R) {
    using frond::atan2;
    using std::sqrt;
    // The largest of the four squares decides from which row to start (Shepperd 1978).
    S w;
    Vec3of<S> u;
    const S trace = R.trace();
    int i = 0;
    if (R(1, 1) > R(0, 0)) i = 1;
    if (R(2, 2) > R(i, i)) i = 2;
    if (trace > R(i, i)) {
        const S s = sqrt(trace + 1.), t = S(0.5) / s;
        w = 0.5 * s;
        u = Vec3of<S>(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1)) * t;
    } else {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const S s = sqrt(R(i, i) - R(j, j) - R(k, k) + 1.);
        u[i] = 0.5 * s;
        const S t = S(0.5) / s;
        u[j] = (R(j, i) + R(i, j)) * t;
        u[k] = (R(k, i) + R(i, k)) * t;
        w = (R(k, j) - R(j, k)) * t;
    }
    if (w < 0.) {
        w = -w;
        u = -u;
    }
    const S square = u.squaredNorm();
    if (square < 1e-8) {
        // 2 asin(s)/s with s the sine of half the angle
        const S scale = S(2) + square / 3.;
        return u * scale;
    }
    const S sine = sqrt(square), scale = 2. * atan2(sine, w) / sine;
    return u * scale;
}

}  // namespace frond
