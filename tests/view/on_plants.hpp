// Positions on a viewer's first plant, in the world and in the picture.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "view/viewer.hpp"

inline std::vector<float> surface_of(const frond::tools::Viewer& viewer) {
    frond_surface_view view;
    EXPECT_EQ(frond_plant_get_surface(viewer.play->stage.plants[0], &view), FROND_OK) << frond_last_error();
    return std::vector<float>(view.positions, view.positions + 3 * size_t(view.vertex_count));
}

inline frond_vec3 vertex(const std::vector<float>& surface, int i) {
    const float* p = surface.data() + 3 * size_t(i);
    return {double(p[0]), double(p[1]), double(p[2])};
}

inline double distance(const frond_vec3& a, const frond_vec3& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

inline int lowest(const std::vector<float>& surface) {
    int best = 0;
    for (int i = 0; i < int(surface.size() / 3); i++)
        if (vertex(surface, i).y < vertex(surface, best).y) best = i;
    return best;
}

// Finds the pixel of a point, as the inverse of ray_through, by Newton's method.
inline void pixel_of(const frond::tools::Camera& camera, const frond_vec3& p, int width, int height, double& x,
                     double& y) {
    using frond::tools::Ray;
    x = width / 2.0;
    y = height / 2.0;
    const auto miss = [&](double px, double py, double out[2]) {
        const Ray middle = frond::tools::ray_through(camera, width / 2.0, height / 2.0, width, height);
        const Ray right = frond::tools::ray_through(camera, width / 2.0 + 1, height / 2.0, width, height);
        const Ray down = frond::tools::ray_through(camera, width / 2.0, height / 2.0 + 1, width, height);
        const Ray ray = frond::tools::ray_through(camera, px, py, width, height);
        const frond_vec3 met = frond::tools::meet_facing_plane(camera, ray, p);
        const frond_vec3 off = {met.x - p.x, met.y - p.y, met.z - p.z};
        const auto along = [&](const Ray& axis) {
            return off.x * (axis.direction.x - middle.direction.x) + off.y * (axis.direction.y - middle.direction.y) +
                   off.z * (axis.direction.z - middle.direction.z);
        };
        out[0] = along(right);
        out[1] = along(down);
    };
    for (int round = 0; round < 4; round++) {
        double at[2], beside[2], below[2];
        miss(x, y, at);
        miss(x + 1, y, beside);
        miss(x, y + 1, below);
        const double a = beside[0] - at[0], b = below[0] - at[0], c = beside[1] - at[1], d = below[1] - at[1];
        const double det = a * d - b * c;
        x -= (d * at[0] - b * at[1]) / det;
        y -= (a * at[1] - c * at[0]) / det;
    }
}

// A point to take hold of: the middle of a triangle of the first plant that is visible under the mouse, as far to the
// right in the picture as possible, near a leaf's tip.
struct LeafTip {
    int vertex;   // one of its corners
    double x, y;  // [pixel]
};
inline LeafTip leaf_tip(const frond::tools::Viewer& viewer) {
    using namespace frond::tools;
    const frond_plant plant = viewer.play->stage.plants[0];
    frond_surface_view view;
    EXPECT_EQ(frond_plant_get_surface(plant, &view), FROND_OK);
    const std::vector<float> surface = surface_of(viewer);
    std::vector<std::pair<double, int>> by_place;
    const auto middle = [&](int triangle, LeafTip& tip) {
        const int32_t* v = view.indices + 3 * triangle;
        const frond_vec3 a = vertex(surface, v[0]), b = vertex(surface, v[1]), c = vertex(surface, v[2]);
        const frond_vec3 p = {(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3, (a.z + b.z + c.z) / 3};
        tip.vertex = v[0];
        pixel_of(viewer.camera, p, viewer.width, viewer.height, tip.x, tip.y);
        return p;
    };
    LeafTip tip = {};
    for (int t = 0; t < view.triangle_count; t++) {
        middle(t, tip);
        by_place.emplace_back(-tip.x, t);
    }
    std::sort(by_place.begin(), by_place.end());
    for (const auto& [left, triangle] : by_place) {
        const frond_vec3 p = middle(triangle, tip);
        tip.x = std::round(tip.x);
        tip.y = std::round(tip.y);
        const Ray ray = ray_through(viewer.camera, tip.x, tip.y, viewer.width, viewer.height);
        const Pick hit = pick(viewer.play->stage, ray);
        if (hit.plant.id == plant.id && distance(hit.point, p) < 0.02) return tip;
    }
    ADD_FAILURE() << "no leaf can be seen";
    return tip;
}
