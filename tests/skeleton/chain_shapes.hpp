// Surfaces for the tests of organs and chains: tubes, blades, plants of both, triangle soups.
#pragma once

#include <cmath>
#include <random>

#include "skeleton/chain.hpp"

namespace frond::test {

struct Sketch {
    Surface surface;

    void begin_part(const std::string& name, const std::string& material = "") {
        surface.parts.emplace_back();
        surface.parts.back().name = name;
        surface.parts.back().material = material;
        surface.parts.back().first_triangle = int(surface.triangles.size());
    }
    int add(const Vec3& place) {
        surface.positions.push_back(place);
        surface.normals.push_back(Vec3f::UnitY());
        return int(surface.positions.size()) - 1;
    }
    void triangle(int a, int b, int c) {
        if (surface.parts.empty()) begin_part("");
        surface.triangles.push_back({a, b, c});
        surface.parts.back().triangle_count++;
    }
    // Adds an open tube along a line of points, with a ring of `sides` corners at each. Returns the first ring's first
    // vertex.
    int tube(const std::vector<Vec3>& line, double radius, int sides) {
        const int first = int(surface.positions.size());
        for (size_t i = 0; i < line.size(); i++) {
            const Vec3 along = (line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0]).normalized();
            const Vec3 u = along.cross(std::abs(along.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitZ()).normalized();
            const Vec3 v = along.cross(u);
            for (int k = 0; k < sides; k++) {
                const double angle = 2 * M_PI * k / sides;
                add(line[i] + radius * (std::cos(angle) * u + std::sin(angle) * v));
            }
        }
        for (int i = 0; i + 1 < int(line.size()); i++)
            for (int k = 0; k < sides; k++) {
                const int a = first + i * sides + k, b = first + i * sides + (k + 1) % sides;
                triangle(a, b, b + sides);
                triangle(a, b + sides, a + sides);
            }
        return first;
    }
    // Adds a flat strip of the given width along a line of points.
    void strip(const std::vector<Vec3>& line, double width, const Vec3& across, int cells = 2) {
        const int first = int(surface.positions.size());
        for (const Vec3& place : line)
            for (int k = 0; k <= cells; k++) add(place + width * (double(k) / cells - 0.5) * across);
        for (int i = 0; i + 1 < int(line.size()); i++)
            for (int k = 0; k < cells; k++) {
                const int a = first + i * (cells + 1) + k, b = a + 1;
                triangle(a, b, b + cells + 1);
                triangle(a, b + cells + 1, a + cells + 1);
            }
    }
};

inline std::vector<Vec3> line(const Vec3& from, const Vec3& to, int cells) {
    std::vector<Vec3> places;
    for (int i = 0; i <= cells; i++) places.push_back(from + (to - from) * double(i) / cells);
    return places;
}

// Returns a stem of 1 m and `leaves` leaves of 0.3 m around it, each a component that crosses the stem.
inline Sketch leafy_plant(int leaves, bool names) {
    Sketch sketch;
    sketch.begin_part(names ? "stem" : "");
    sketch.tube(line({0, 0, 0}, {0, 1, 0}, 20), 0.01, 8);
    for (int i = 0; i < leaves; i++) {
        if (names) sketch.begin_part("leaf_" + std::to_string(i + 1));
        const double angle = 2.4 * i, y = 0.3 + 0.6 * i / leaves;
        const Vec3 out(std::cos(angle), 0, std::sin(angle));
        sketch.strip(line(Vec3(0, y, 0), Vec3(0, y + 0.05, 0) + 0.3 * out, 10), 0.05, Vec3(-out.z(), 0, out.x()));
    }
    return sketch;
}

inline Sketch soup(int seed, int triangles, double size) {
    std::mt19937_64 engine(static_cast<uint64_t>(seed));
    const auto dice = [&](double low, double high) { return low + (high - low) * double(engine() >> 11) * 0x1p-53; };
    Sketch sketch;
    for (int i = 0; i < triangles; i++) {
        const Vec3 middle(dice(-1, 1), dice(-1, 1), dice(-1, 1));
        int corner[3];
        for (int& c : corner) {
            // Some corners are shared, so that there are components of all sizes and edges with many triangles.
            if (!sketch.surface.positions.empty() && dice(0, 1) < 0.3)
                c = int(dice(0, double(sketch.surface.positions.size())));
            else
                c = sketch.add(middle + size * Vec3(dice(-1, 1), dice(-1, 1), dice(-1, 1)));
        }
        if (corner[0] != corner[1] && corner[1] != corner[2] && corner[2] != corner[0])
            sketch.triangle(corner[0], corner[1], corner[2]);
    }
    clean_surface(sketch.surface);
    return sketch;
}

// Surface, topology, organs and chain of a sketch.
struct Grown {
    Surface surface;
    Topology topology;
    std::vector<Organ> organs;
    Chain chain;
};

inline Grown grow(const Sketch& sketch, const ChainOptions& options = {}) {
    Grown grown;
    grown.surface = sketch.surface;
    grown.topology = make_topology(grown.surface);
    grown.organs = find_organs(grown.surface, grown.topology);
    grown.chain = make_chain(grown.surface, grown.topology, grown.organs, options);
    return grown;
}

}  // namespace frond::test
