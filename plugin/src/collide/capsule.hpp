// Capsule: the bodies of a plant's chain, and what is asked about them (section 3.3.1 of Lu, Guo, Zhao, Li: "Physical
// Model for Interactive Deformation of 3D Plant"): how far apart they are, and when they meet while they move.
#pragma once

#include <optional>

#include "model/triangle_distance.hpp"

namespace frond {

// All points within `radius` of the axis. Both ends may be the same: a sphere.
struct Capsule {
    Vec3 begin, end;  // of the axis [m]
    double radius;    // [m]
};

// Between two shapes a and b.
struct Gap {
    double distance;  // between the surfaces [m]; negative where they overlap
    Vec3 normal;      // along which a moves away from b, length one
    Vec3 on_a, on_b;  // nearest points of the axes, or of the triangle's face [m]
};

// Where the axes touch, the normal stands on both, and any of them does where they lie in one line.
Gap gap_between(const Capsule& a, const Capsule& b);
// A capsule whose axis passes through the face is as deep as the shorter way out on either side of it. Triangles
// without area are segments or points.
Gap gap_between(const Capsule& a, const Corners& b);

// Where moving shapes meet first.
struct Impact {
    double time;  // of the step, 0..1 [-]; 0 where they overlap from the start
    Gap gap;      // then
};

// For ends, or corners, that each move along a straight line at constant speed from where they are `before` to where
// they are `after`; radii are those before. Nothing where they do not meet. A meeting is never missed: time is found
// from below, and is right once the surfaces are within a millionth of their sizes.
std::optional<Impact> first_impact(const Capsule& a_before, const Capsule& a_after, const Capsule& b_before,
                                   const Capsule& b_after);
std::optional<Impact> first_impact(const Capsule& a_before, const Capsule& a_after, const Corners& b_before,
                                   const Corners& b_after);

}  // namespace frond
