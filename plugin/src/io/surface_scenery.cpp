#include "io/surface_scenery.hpp"

#include <algorithm>
#include <numeric>

#include "core/log.hpp"
#include "core/platform/files.hpp"
#include "core/union_find.hpp"
#include "skeleton/organ_clues.hpp"
#include "surface/place_index.hpp"

namespace frond {

namespace {

constexpr int FEW_TRIANGLES = 2000;        // of ground or sky
constexpr double THIN = 0.02, WIDE = 1.5;  // ground: height over width; width over the rest's
constexpr double AROUND = 0.15;            // sky: distance from the rest, in sizes of the rest
constexpr double HOLLOW = 0.3;             // sky: area over that of its box, at least
constexpr double STANDS = 0.1;             // ground lies at most this share of the rest's height above its foot

bool has_start(const std::string& text, const char* start) {
    return text.rfind(start, 0) == 0;
}

struct Shell {
    Eigen::AlignedBox3d box;
    double area = 0;
    int triangles = 0;
    bool is_named = false;  // after an organ
};

// Drops triangles; parts without any left go too.
void keep_triangles(Surface& surface, const std::vector<char>& keep) {
    std::vector<Part> parts;
    size_t kept = 0;
    for (Part part : surface.parts) {
        const size_t begin = size_t(part.first_triangle), end = begin + size_t(part.triangle_count);
        part.first_triangle = int(kept);
        for (size_t t = begin; t < end; t++)
            if (keep[t]) surface.triangles[kept++] = surface.triangles[t];
        part.triangle_count = int(kept) - part.first_triangle;
        if (part.triangle_count > 0) parts.push_back(std::move(part));
    }
    surface.triangles.resize(kept);
    surface.parts = std::move(parts);
}

void leave_out_colliders(Surface& surface) {
    std::vector<char> keep(surface.triangles.size(), 1);
    int count = 0;
    for (const Part& part : surface.parts)
        if (names_a_collider(part.name) || names_a_collider(part.material)) {
            std::fill_n(keep.begin() + part.first_triangle, part.triangle_count, char(0));
            count++;
        }
    if (count == 0 || std::find(keep.begin(), keep.end(), 1) == keep.end()) return;
    keep_triangles(surface, keep);
    warn("%d collision shapes are left out", count);
}

bool is_ground(const Shell& shell, const Eigen::AlignedBox3d& rest) {
    const Vec3 size = shell.box.sizes(), other = rest.sizes();
    return std::min(size.x(), size.z()) > WIDE * std::max(other.x(), other.z()) &&
           size.y() < THIN * std::min(size.x(), size.z()) && size.y() < THIN * other.y() &&
           shell.box.max().y() < rest.min().y() + STANDS * other.y();
}

bool is_sky(const Shell& shell, const Eigen::AlignedBox3d& rest) {
    const double gap = AROUND * rest.diagonal().norm();
    Eigen::AlignedBox3d wide(rest.min() - Vec3(gap, 0, gap), rest.max() + Vec3(gap, gap, gap));
    const Vec3 size = shell.box.sizes();
    const double box_area = 2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
    return shell.box.contains(wide) && shell.area > HOLLOW * box_area;
}

// Returns for each triangle whether its part is named after an organ: a lily's pad is no ground.
std::vector<char> find_named(const Surface& surface) {
    const std::vector<std::string> kinds = kinds_by_name(surface);
    std::vector<char> named(surface.triangles.size(), 0);
    for (size_t p = 0; p < kinds.size(); p++)
        std::fill_n(named.begin() + surface.parts[p].first_triangle, surface.parts[p].triangle_count,
                    !kinds[p].empty());
    return named;
}

// Finds the connected components of the surface, and leaves out ground and sky.
void leave_out_surroundings(Surface& surface) {
    const PlaceIndex index = index_places(surface.positions);
    UnionFind sets(surface.positions.size());
    for (const Triangle& t : surface.triangles)
        for (size_t k = 1; k < 3; k++) sets.join(index.place[size_t(t[0])], index.place[size_t(t[k])]);
    std::vector<int> number(surface.positions.size(), -1), shell_of(surface.triangles.size());
    std::vector<Shell> shells;
    const std::vector<char> named = find_named(surface);
    for (size_t t = 0; t < surface.triangles.size(); t++) {
        const Triangle& corner = surface.triangles[t];
        int& shell = number[size_t(sets.find(index.place[size_t(corner[0])]))];
        if (shell < 0) {
            shell = int(shells.size());
            shells.emplace_back();
        }
        shell_of[t] = shell;
        const Vec3 &a = surface.positions[size_t(corner[0])], &b = surface.positions[size_t(corner[1])],
                   &c = surface.positions[size_t(corner[2])];
        shells[size_t(shell)].box.extend(a).extend(b).extend(c);
        shells[size_t(shell)].area += 0.5 * (b - a).cross(c - a).norm();
        shells[size_t(shell)].triangles++;
        if (named[t]) shells[size_t(shell)].is_named = true;
    }
    if (shells.size() < 2) return;
    std::vector<int> order(shells.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return shells[size_t(a)].box.diagonal().squaredNorm() > shells[size_t(b)].box.diagonal().squaredNorm();
    });
    // Only the largest few can surround the rest.
    std::vector<char> out(shells.size(), 0);
    int grounds = 0, skies = 0;
    for (size_t i = 0; i + 1 < order.size() && i < 4; i++) {
        const Shell& shell = shells[size_t(order[i])];
        Eigen::AlignedBox3d rest;
        for (size_t k = i + 1; k < order.size(); k++) rest.extend(shells[size_t(order[k])].box);
        const bool may_be = shell.triangles <= FEW_TRIANGLES && !shell.is_named;
        const bool ground = may_be && is_ground(shell, rest), sky = may_be && is_sky(shell, rest);
        if (!ground && !sky) break;
        out[size_t(order[i])] = 1;
        (ground ? grounds : skies)++;
    }
    if (grounds + skies == 0) return;
    std::vector<char> keep(surface.triangles.size());
    for (size_t t = 0; t < keep.size(); t++) keep[t] = !out[size_t(shell_of[t])];
    keep_triangles(surface, keep);
    if (grounds > 0) warn("a ground plane under the plant is left out");
    if (skies > 0) warn("a shape that surrounds the plant is left out");
}

}  // namespace

bool names_a_collider(const std::string& name) {
    std::string lower;
    for (char letter : name) lower += char(tolower(uint8_t(letter)));
    for (const char* start : {"ucx_", "ubx_", "ucp_", "usp_", "umcx_", "physicsshape", "collider", "collision"})
        if (has_start(lower, start)) return true;
    // Exporters append numbers: "tree-colonly.001".
    while (!lower.empty() && (isdigit(uint8_t(lower.back())) || lower.back() == '.')) lower.pop_back();
    for (const char* end :
         {"-colonly", "-convcolonly", "-convcol", "_collider", "_collision", "collisionmesh", "physicsshape"})
        if (has_ending(lower, end)) return true;
    return false;
}

bool leave_out_scenery(Surface& surface) {
    const size_t before = surface.triangles.size();
    leave_out_colliders(surface);
    leave_out_surroundings(surface);
    return surface.triangles.size() < before;
}

}  // namespace frond
