// Triangle distance: nearest points of triangles, segments and points, degenerate ones included.
#pragma once

#include "core/types.hpp"

namespace frond {

using Corners = std::array<Vec3, 3>;

struct NearestPair {
    Vec3 a, b;       // [m]
    double squared;  // squared distance [m^2]; exactly 0 where the two cross
};

Vec3 nearest_in_triangle(const Corners& triangle, const Vec3& point);
NearestPair nearest_of_segments(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1);
// `a` lies on the segment, `b` on the triangle.
NearestPair nearest_of_segment_and_triangle(const Vec3& begin, const Vec3& end, const Corners& triangle);
// Returns whether two triangles are farther apart along a direction than the root of `squared`; quick.
bool are_apart(const Corners& a, const Corners& b, const Vec3& direction, double squared);
NearestPair nearest_of_triangles(const Corners& a, const Corners& b);

}  // namespace frond
