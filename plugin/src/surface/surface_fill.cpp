// Puts back lost triangles. In: a surface whose vertices at one place are one point. Out: the same with a triangle in
// each hole between three others of which one goes on smoothly in it; ends of tubes, which they meet at an edge, stay
// open. Damaged meshes lose triangles one by one, and what was lost within a mesh is known by its neighbours.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>

#include "surface/place_index.hpp"
#include "surface/surface.hpp"

namespace frond {
namespace {

// A side of a triangle that no other triangle shares, from one place to another.
struct Rim {
    int from, to, triangle, corner;
};

std::vector<Rim> find_rims(const Surface& surface, const std::vector<int>& place) {
    struct Side {
        std::array<int, 2> ends;
        Rim rim;
    };
    std::vector<Side> sides;
    sides.reserve(3 * surface.triangles.size());
    for (size_t t = 0; t < surface.triangles.size(); t++)
        for (size_t k = 0; k < 3; k++) {
            const int from = place[size_t(surface.triangles[t][k])],
                      to = place[size_t(surface.triangles[t][(k + 1) % 3])];
            sides.push_back({{std::min(from, to), std::max(from, to)}, {from, to, int(t), int(k)}});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return a.ends != b.ends ? a.ends < b.ends : a.rim.triangle < b.rim.triangle;
    });
    std::vector<Rim> rims;
    for (size_t i = 0; i < sides.size(); i++) {
        const bool before = i > 0 && sides[i - 1].ends == sides[i].ends,
                   after = i + 1 < sides.size() && sides[i + 1].ends == sides[i].ends;
        if (!before && !after) rims.push_back(sides[i].rim);
    }
    return rims;
}

Vec3 normal_of(const Surface& surface, const Triangle& corners) {
    const Vec3& a = surface.positions[size_t(corners[0])];
    return (surface.positions[size_t(corners[1])] - a).cross(surface.positions[size_t(corners[2])] - a).normalized();
}

// A triangle that was lost, and the neighbour that goes on in it.
struct Lost {
    Triangle corners;
    int neighbour;
};

// Returns whether one of three rims around a hole goes on smoothly in it, and the triangle that then was lost.
bool find_lost(const Surface& surface, const std::array<Rim, 3>& around, Lost& lost) {
    constexpr double SMOOTH = 0.7;  // least cosine between the normals
    double flattest = SMOOTH;
    for (size_t k = 0; k < 3; k++) {
        const Rim &own = around[k], &other = around[(k + 1) % 3];
        const Triangle &beside = surface.triangles[size_t(own.triangle)],
                       &next = surface.triangles[size_t(other.triangle)];
        const int from = beside[size_t(own.corner)], to = beside[size_t(own.corner + 1) % 3];
        // The next rim has one end that this one has not.
        const bool is_far = other.from != own.from && other.from != own.to;
        const Triangle corners = {to, from, next[size_t(other.corner + (is_far ? 0 : 1)) % 3]};
        const double cosine = normal_of(surface, corners).dot(normal_of(surface, beside));
        if (cosine <= flattest) continue;
        flattest = cosine;
        lost = {corners, own.triangle};
    }
    return flattest > SMOOTH;
}

std::vector<Lost> find_all_lost(const Surface& surface) {
    const PlaceIndex index = index_places(surface.positions);
    const std::vector<Rim> rims = find_rims(surface, index.place);
    std::vector<std::vector<int>> at(size_t(index.count));  // rims at each place
    for (size_t i = 0; i < rims.size(); i++)
        for (const int end : {rims[i].from, rims[i].to}) at[size_t(end)].push_back(int(i));
    std::vector<Lost> all;
    std::vector<char> closed(rims.size(), 0);
    const auto far_end = [&](int rim, int place) {
        return rims[size_t(rim)].from == place ? rims[size_t(rim)].to : rims[size_t(rim)].from;
    };
    for (size_t i = 0; i < rims.size(); i++) {
        const auto close = [&](int j, int k) {
            const std::array<Rim, 3> around = {rims[i], rims[size_t(j)], rims[size_t(k)]};
            Lost lost;
            if (around[0].triangle == around[1].triangle || around[1].triangle == around[2].triangle ||
                around[2].triangle == around[0].triangle || !find_lost(surface, around, lost))
                return;
            closed[i] = closed[size_t(j)] = closed[size_t(k)] = 1;
            all.push_back(lost);
        };
        for (const int j : at[size_t(rims[i].to)])
            for (const int k : at[size_t(rims[i].from)])
                if (j != int(i) && k != int(i) && j != k && !closed[i] && !closed[size_t(j)] && !closed[size_t(k)] &&
                    far_end(j, rims[i].to) == far_end(k, rims[i].from))
                    close(j, k);
    }
    return all;
}

}  // namespace

int fill_lost_triangles(Surface& surface) {
    const std::vector<Lost> all = find_all_lost(surface);
    if (all.empty()) return 0;
    std::multimap<int, Triangle> after;  // by neighbour
    for (const Lost& lost : all) after.emplace(lost.neighbour, lost.corners);
    std::vector<Triangle> triangles;
    for (Part& part : surface.parts) {
        const int begin = part.first_triangle, end = begin + part.triangle_count;
        part.first_triangle = int(triangles.size());
        for (int t = begin; t < end; t++) {
            triangles.push_back(surface.triangles[size_t(t)]);
            const auto [first, last] = after.equal_range(t);
            for (auto one = first; one != last; ++one) triangles.push_back(one->second);
        }
        part.triangle_count = int(triangles.size()) - part.first_triangle;
    }
    surface.triangles = std::move(triangles);
    return int(all.size());
}

}  // namespace frond
