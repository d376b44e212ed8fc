// Small surfaces for tests of topology and cage: tubes, sheets, boxes, loose cards.
#pragma once

#include <cmath>
#include <random>

#include "surface/surface.hpp"

namespace frond::test {

// Adds triangles with vertices of their own, as a part.
inline void add_part(Surface& surface, const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                     int organ = -1) {
    const int offset = int(surface.positions.size());
    Part part;
    part.name = "part_" + std::to_string(surface.parts.size());
    part.first_triangle = int(surface.triangles.size());
    part.triangle_count = int(triangles.size());
    part.organ = organ;
    surface.parts.push_back(part);
    surface.positions.insert(surface.positions.end(), points.begin(), points.end());
    surface.normals.resize(surface.positions.size(), Vec3f::UnitY());
    for (const Triangle& triangle : triangles)
        surface.triangles.push_back({triangle[0] + offset, triangle[1] + offset, triangle[2] + offset});
}

// Adds a rectangle of `columns` x `rows` squares; the position at (s, t) in 0..1 is shape(s, t).
template <class Shape>
void add_sheet(Surface& surface, int columns, int rows, const Shape& shape, int organ = -1) {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) points.push_back(shape(double(i) / columns, double(j) / rows));
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const int a = j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
            triangles.push_back({a, b, d});
            triangles.push_back({a, d, c});
        }
    add_part(surface, points, triangles, organ);
}

// Adds an upright tube; with lids it is closed.
inline void add_tube(Surface& surface, const Vec3& foot, double radius, double height, int sides, int rows, bool lids,
                     int organ = -1) {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i < sides; ++i) {
            const double angle = 2 * M_PI * i / sides;
            points.push_back(foot + Vec3(radius * std::cos(angle), height * j / rows, radius * std::sin(angle)));
        }
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < sides; ++i) {
            const int a = j * sides + i, b = j * sides + (i + 1) % sides, c = a + sides, d = b + sides;
            triangles.push_back({a, c, b});
            triangles.push_back({b, c, d});
        }
    if (lids) {
        const int low = int(points.size()), high = low + 1;
        points.push_back(foot);
        points.push_back(foot + Vec3(0, height, 0));
        for (int i = 0; i < sides; ++i) {
            triangles.push_back({low, i, (i + 1) % sides});
            triangles.push_back({high, rows * sides + (i + 1) % sides, rows * sides + i});
        }
    }
    add_part(surface, points, triangles, organ);
}

inline void add_sphere(Surface& surface, const Vec3& centre, double radius, int columns, int rows) {
    std::vector<Vec3> points = {centre - Vec3(0, radius, 0), centre + Vec3(0, radius, 0)};
    std::vector<Triangle> triangles;
    for (int j = 1; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const double up = M_PI * (double(j) / rows - 0.5), around = 2 * M_PI * i / columns;
            points.push_back(
                centre + radius * Vec3(std::cos(up) * std::cos(around), std::sin(up), std::cos(up) * std::sin(around)));
        }
    const auto at = [columns](int j, int i) { return 2 + (j - 1) * columns + i % columns; };
    for (int i = 0; i < columns; ++i) {
        triangles.push_back({0, at(1, i), at(1, i + 1)});
        triangles.push_back({1, at(rows - 1, i + 1), at(rows - 1, i)});
        for (int j = 1; j + 1 < rows; ++j) {
            triangles.push_back({at(j, i), at(j + 1, i), at(j, i + 1)});
            triangles.push_back({at(j, i + 1), at(j + 1, i), at(j + 1, i + 1)});
        }
    }
    add_part(surface, points, triangles);
}

// Returns loose triangles in the unit cube, some of them flat, repeated or sharing corners.
inline Surface random_soup(uint64_t seed, int count) {
    std::mt19937_64 engine(seed);
    const auto uniform = [&engine](double low, double high) {
        return low + (high - low) * double(engine() >> 11) * 0x1p-53;
    };
    Surface surface;
    const double edge = std::pow(10, uniform(-3, 0));
    const Vec3 stretch(1, std::pow(10, uniform(-2, 1)), std::pow(10, uniform(-2, 0)));
    for (int i = 0; i < count; ++i) {
        const Vec3 centre(uniform(0, 1), uniform(0, 1), uniform(0, 1));
        std::vector<Vec3> corners;
        for (int k = 0; k < 3; ++k)
            corners.push_back(
                (centre + edge * Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1))).cwiseProduct(stretch));
        const double kind = uniform(0, 1);
        if (kind < 0.05) corners[2] = corners[1];
        if (kind >= 0.05 && kind < 0.1) corners[2] = 0.5 * (corners[0] + corners[1]);
        if (kind >= 0.1 && kind < 0.4 && i > 0)
            corners[0] = surface.positions[size_t(engine() % surface.positions.size())];
        add_part(surface, corners, {{0, 1, 2}});
        if (kind > 0.95) add_part(surface, corners, {{0, 2, 1}});
    }
    return surface;
}

}  // namespace frond::test
