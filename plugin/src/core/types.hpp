// Scalar and vector types. Everything is double, except data for a GPU, which is float.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/constants.hpp"

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

// Returns the i-th point of a vector that holds x y z x y z ...
inline auto point(VecX& x, int i) {
    return x.segment<3>(3 * Eigen::Index(i));
}
inline auto point(const VecX& x, int i) {
    return x.segment<3>(3 * Eigen::Index(i));
}

// Returns whether all numbers are finite, several at a time; Eigen's allFinite() checks one at a time.
bool are_finite(const VecX& x);
// Returns whether two vectors are equal; compares bytes first, which is quicker.
inline bool are_same(const VecX& a, const VecX& b) {
    if (a.size() != b.size() || a.size() == 0) return a.size() == b.size();
    return std::memcmp(a.data(), b.data(), size_t(a.size()) * sizeof(double)) == 0 || a == b;
}

}  // namespace frond
