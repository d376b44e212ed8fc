// Vectors and matrices, limited to what drawing needs.
#pragma once

#include <array>
#include <cmath>

#include "frond_picture.h"

namespace picture {

using Vec = frond_vec3;
using Mat4 = std::array<float, 16>;  // column-major, as in OpenGL

inline Vec operator+(Vec a, Vec b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec operator-(Vec a, Vec b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec operator*(double s, Vec a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline double dot(Vec a, Vec b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec cross(Vec a, Vec b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec a) {
    return std::hypot(a.x, a.y, a.z);
}
inline bool finite(Vec a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}
// Returns whether a point is finite and not absurdly far away.
inline bool drawable(Vec a) {
    return std::fabs(a.x) <= FROND_PICTURE_FARTHEST && std::fabs(a.y) <= FROND_PICTURE_FARTHEST &&
           std::fabs(a.z) <= FROND_PICTURE_FARTHEST;
}
// Returns the unit vector along a, or `fallback` if a has no direction.
inline Vec direction(Vec a, Vec fallback) {
    const double size = length(a);
    return size > 1e-12 && std::isfinite(size) ? (1 / size) * a : fallback;
}
// Returns a unit vector at a right angle to the unit vector a.
inline Vec perpendicular(Vec a) {
    return direction(cross(a, std::fabs(a.x) < 0.7 ? Vec{1, 0, 0} : Vec{0, 1, 0}), {1, 0, 0});
}

inline Mat4 multiply(const Mat4& a, const Mat4& b) {
    Mat4 product{};
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++)
            for (int k = 0; k < 4; k++) product[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    return product;
}

// A bounding box that grows; empty while lower > upper.
struct Box {
    Vec lower{1e300, 1e300, 1e300}, upper{-1e300, -1e300, -1e300};

    void add(Vec p) {
        lower = {std::fmin(lower.x, p.x), std::fmin(lower.y, p.y), std::fmin(lower.z, p.z)};
        upper = {std::fmax(upper.x, p.x), std::fmax(upper.y, p.y), std::fmax(upper.z, p.z)};
    }
    bool empty() const { return lower.x > upper.x; }
    Vec middle() const { return 0.5 * (lower + upper); }
    double radius() const { return 0.5 * length(upper - lower); }
};

}  // namespace picture
