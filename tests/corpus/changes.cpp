// Plants mirrored, turned, far away, with faces turned over or drawn twice, jittered, as a soup, damaged.
#include "changes.hpp"

#include <cmath>
#include <map>

namespace frond::test {

static Vec3 random_step(double reach, std::mt19937& random) {
    std::uniform_real_distribution<double> step(-reach, reach);
    const double x = step(random), y = step(random);
    return {x, y, step(random)};
}

static void turn_over(Triangle& corners) {
    std::swap(corners[0], corners[1]);
}

static void mirror(Surface& surface, std::mt19937&) {
    for (Vec3& place : surface.positions) place.x() = -place.x();
    for (Triangle& corners : surface.triangles) turn_over(corners);
}

static void turn(Surface& surface, std::mt19937&) {
    const Eigen::AngleAxisd about(0.6, Vec3::UnitY());
    for (Vec3& place : surface.positions) place = about * place;
}

static void turn_some_over(Surface& surface, std::mt19937& random) {
    for (Triangle& corners : surface.triangles)
        if (random() % 2) turn_over(corners);
}

// Draws every triangle both ways round.
static void draw_twice(Surface& surface, std::mt19937&) {
    std::vector<Triangle> both;
    for (Triangle corners : surface.triangles) {
        both.push_back(corners);
        turn_over(corners);
        both.push_back(corners);
    }
    surface.triangles = both;
    for (Part& part : surface.parts) {
        part.first_triangle *= 2;
        part.triangle_count *= 2;
    }
}

static void jitter(Surface& surface, std::mt19937& random) {
    const double reach = 1e-4 * surface.size();
    std::map<std::array<double, 3>, Vec3> moved;  // vertices in one place stay together
    for (Vec3& place : surface.positions) {
        const std::array<double, 3> key = {place.x(), place.y(), place.z()};
        const auto at = moved.find(key);
        if (at == moved.end())
            place = moved.emplace(key, place + random_step(reach, random)).first->second;
        else
            place = at->second;
    }
}

// Gives each triangle corners of its own, that differ by 1e-5 of the size.
static void tear_apart(Surface& surface, std::mt19937& random) {
    const double reach = 1e-5 * surface.size();
    const std::vector<Vec3> places = surface.positions;
    surface.positions.clear();
    surface.normals.clear();
    surface.uvs.clear();
    surface.colors.clear();
    for (Triangle& corners : surface.triangles)
        for (int& corner : corners) {
            surface.positions.push_back(places[size_t(corner)] + random_step(reach, random));
            corner = int(surface.positions.size()) - 1;
        }
}

static void lose_some(Surface& surface, std::mt19937& random) {
    std::vector<Triangle> kept;
    for (Part& part : surface.parts) {
        const auto from = surface.triangles.begin() + part.first_triangle;
        part.first_triangle = int(kept.size());
        for (auto at = from; at != from + part.triangle_count; ++at)
            if (random() % 20) kept.push_back(*at);
        part.triangle_count = int(kept.size()) - part.first_triangle;
    }
    surface.triangles = kept;
}

// As scans in map coordinates are.
static void move_far(Surface& surface, std::mt19937&) {
    for (Vec3& place : surface.positions) place += Vec3(5.4e6, 120, 3.7e5);
}

const std::vector<Variant>& variants() {
    static const std::vector<Variant> all = {
        {"mirrored", mirror, 0.88, 0.85, 0.85},       {"turned", turn, 0.88, 0.85, 0.72},
        {"far", move_far, 0.88, 0.85, 0.97},          {"turned_over", turn_some_over, 0.88, 0.85, 0.89},
        {"drawn_twice", draw_twice, 0.9, 0.85, 0.97}, {"jittered", jitter, 0.88, 0.85, 0.91},
        {"torn_apart", tear_apart, 0.88, 0.85, 0.91}, {"five_percent_lost", lose_some, 0.88, 0.82, 0.65},
    };
    return all;
}

}  // namespace frond::test
