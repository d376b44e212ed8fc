// Scalar and vector types. Everything inside is double; only what goes to a GPU is float.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace frond {

using Vec2f = Eigen::Vector2f;
using Vec3f = Eigen::Vector3f;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;
using VecX = Eigen::VectorXd;
using Triangle = std::array<int, 3>;
using Tet = std::array<int, 4>;
using Color = std::array<uint8_t, 4>;  // RGBA, sRGB

constexpr double PI = 3.14159265358979323846;

// The i-th point of a vector that holds x y z x y z ...
inline auto point(VecX& x, int i) {
    return x.segment<3>(3 * Eigen::Index(i));
}
inline auto point(const VecX& x, int i) {
    return x.segment<3>(3 * Eigen::Index(i));
}

// Eigen's own goes number by number.
bool are_finite(const VecX& x);
// To the last bit first.
inline bool are_same(const VecX& a, const VecX& b) {
    if (a.size() != b.size() || a.size() == 0) return a.size() == b.size();
    return std::memcmp(a.data(), b.data(), size_t(a.size()) * sizeof(double)) == 0 || a == b;
}

}  // namespace frond
