// Capsule: the bodies of a plant's chain, and how far apart they are (section 3.3.1 of Lu, Guo, Zhao, Li: "Physical
// Model for Interactive Deformation of 3D Plant").
#pragma once

#include "surface/triangle_distance.hpp"

namespace frond {

// All points within `radius` of the axis. Both ends may be the same: a sphere.
struct Capsule {
    Vec3 begin, end;  // ends of the axis [m]
    double radius;    // [m]
};

// Distance between two shapes a and b.
struct Gap {
    double distance;  // between the surfaces [m]; negative where they overlap
    Vec3 normal;      // direction in which a moves away from b, length one
    Vec3 on_a, on_b;  // nearest points of the axes, or of the triangle's face [m]
};

// Computes the gap of two capsules. Where the axes touch, the normal is perpendicular to both.
Gap gap_between(const Capsule& a, const Capsule& b);
// Computes the gap of a capsule and a triangle. A capsule whose axis passes through the face is as deep as its exit on
// the nearer side. Triangles without area are segments or points.
Gap gap_between(const Capsule& a, const Corners& b);

}  // namespace frond
