// Cleans a surface. In: an imported triangle soup. Out: the same soup without what no stage could use: triangles with
// bad indices or absurd corners, without area or given twice, and vertices that nothing uses. The order of the rest is
// kept.
#include <cmath>
#include <unordered_set>

#include "core/error.hpp"
#include "core/limits.hpp"
#include "surface/place_index.hpp"
#include "surface/surface.hpp"

namespace frond {

// A triangle lower than this share of the plant's size has no area.
static constexpr double SMALLEST_HEIGHT = 1e-10;
// Largest area of a plant's surface, in squares of its size. With more, a cage would take minutes and gigabytes only to
// be rejected.
static constexpr double MOST_AREA = 1000;

static void check_sizes(const Surface& surface) {
    const size_t count = surface.positions.size();
    if (surface.triangles.size() > size_t(MAX_TRIANGLES))
        fail(FROND_RESULT_BAD_GEOMETRY, "the mesh has %zu triangles, more than the %d that are allowed; simplify it",
             surface.triangles.size(), MAX_TRIANGLES);
    if (count > size_t(3) * MAX_TRIANGLES)
        fail(FROND_RESULT_BAD_GEOMETRY, "the mesh has %zu vertices, more than the %d that are allowed; simplify it",
             count, 3 * MAX_TRIANGLES);
    const bool sizes_agree = (surface.normals.empty() || surface.normals.size() == count) &&
                             (surface.uvs.empty() || surface.uvs.size() == count) &&
                             (surface.colors.empty() || surface.colors.size() == count);
    if (!sizes_agree)
        fail(FROND_RESULT_BAD_GEOMETRY, "normals, uvs or colours are not one a vertex; bring one each or none");
    int covered = 0;
    for (const Part& part : surface.parts) {
        if (part.first_triangle != covered || part.triangle_count < 0 ||
            part.triangle_count > int(surface.triangles.size()) - covered)
            fail(FROND_RESULT_BAD_GEOMETRY, "the parts do not cover the triangles in order, without gap or overlap");
        covered += part.triangle_count;
    }
    if (covered != int(surface.triangles.size()))
        fail(FROND_RESULT_BAD_GEOMETRY, "the parts cover %d of %zu triangles", covered, surface.triangles.size());
}

// Finds the vertices whose coordinates can be used.
static std::vector<char> find_usable(const std::vector<Vec3>& positions) {
    std::vector<char> usable(positions.size());
    for (size_t i = 0; i < positions.size(); ++i)
        usable[i] = positions[i].allFinite() && positions[i].cwiseAbs().maxCoeff() <= LARGEST_COORDINATE;
    return usable;
}

// Returns the diagonal of the box around the usable vertices that triangles refer to [m].
static double size_of(const Surface& surface, const std::vector<char>& usable) {
    Eigen::AlignedBox3d box;
    for (const Triangle& triangle : surface.triangles)
        for (int corner : triangle)
            if (corner >= 0 && size_t(corner) < usable.size() && usable[size_t(corner)])
                box.extend(surface.positions[size_t(corner)]);
    return box.isEmpty() ? 0 : box.diagonal().norm();
}

static bool has_area(const Surface& surface, const Triangle& triangle, double size) {
    const Vec3 a = surface.positions[size_t(triangle[0])], b = surface.positions[size_t(triangle[1])],
               c = surface.positions[size_t(triangle[2])];
    const double longest = std::sqrt(std::max({(b - a).squaredNorm(), (c - a).squaredNorm(), (c - b).squaredNorm()}));
    return (b - a).cross(c - a).norm() > SMALLEST_HEIGHT * size * longest;
}

struct TripleHash {
    size_t operator()(const Triangle& triangle) const {
        uint64_t hash = 0;
        for (int corner : triangle) {
            hash = (hash + uint64_t(uint32_t(corner)) + 1) * 0x9E3779B97F4A7C15ull;
            hash ^= hash >> 29;
        }
        return size_t(hash);
    }
};

// Rotates a triangle's corners so that the smallest comes first; keeps the orientation.
static Triangle rotated(Triangle triangle) {
    while (triangle[0] > triangle[1] || triangle[0] > triangle[2]) triangle = {triangle[1], triangle[2], triangle[0]};
    return triangle;
}

// Chooses which triangles stay. Duplicates have the same positions in the same orientation, or the same vertices in
// either orientation. A leaf drawn twice back to back, with separate vertices for each side, is intended and stays.
static std::vector<char> choose_triangles(const Surface& surface, const std::vector<char>& usable) {
    const double size = size_of(surface, usable);
    const PlaceIndex index = index_places(surface.positions);
    std::unordered_set<Triangle, TripleHash> places, vertices;
    places.reserve(surface.triangles.size());
    vertices.reserve(surface.triangles.size());
    std::vector<char> stays(surface.triangles.size(), 0);
    for (size_t t = 0; t < surface.triangles.size(); ++t) {
        const Triangle& triangle = surface.triangles[t];
        bool good = true;
        for (int corner : triangle)
            good = good && corner >= 0 && size_t(corner) < usable.size() && usable[size_t(corner)];
        if (!good || !has_area(surface, triangle, size)) continue;
        Triangle place;
        for (int k = 0; k < 3; ++k) place[size_t(k)] = index.place[size_t(triangle[size_t(k)])];
        if (place[0] == place[1] || place[1] == place[2] || place[2] == place[0]) continue;
        if (vertices.count(rotated({triangle[0], triangle[2], triangle[1]}))) continue;
        if (!places.insert(rotated(place)).second) continue;
        vertices.insert(rotated(triangle));
        stays[t] = 1;
    }
    return stays;
}

static void drop_triangles(Surface& surface, const std::vector<char>& stays) {
    std::vector<Part> parts;
    int kept = 0;
    for (Part part : surface.parts) {
        const int begin = part.first_triangle, end = begin + part.triangle_count;
        part.first_triangle = kept;
        for (int t = begin; t < end; ++t)
            if (stays[size_t(t)]) surface.triangles[size_t(kept++)] = surface.triangles[size_t(t)];
        part.triangle_count = kept - part.first_triangle;
        if (part.triangle_count > 0) parts.push_back(std::move(part));
    }
    surface.dropped_triangles += int(surface.triangles.size()) - kept;
    surface.triangles.resize(size_t(kept));
    surface.parts = std::move(parts);
}

template <typename Value>
static void keep_used(std::vector<Value>& values, const std::vector<int>& number, int used) {
    if (values.empty()) return;
    for (size_t i = 0; i < number.size(); ++i)
        if (number[i] >= 0) values[size_t(number[i])] = values[i];
    values.resize(size_t(used));
}

static void drop_vertices(Surface& surface, const std::vector<char>& usable) {
    // Vertices in use keep their order.
    std::vector<int> number(surface.positions.size(), -1);
    for (const Triangle& triangle : surface.triangles)
        for (int corner : triangle) number[size_t(corner)] = 0;
    int used = 0;
    for (size_t i = 0; i < number.size(); ++i) {
        if (number[i] >= 0) number[i] = used++;
        if (!usable[i]) ++surface.repaired_vertices;
    }
    keep_used(surface.positions, number, used);
    keep_used(surface.normals, number, used);
    keep_used(surface.uvs, number, used);
    keep_used(surface.colors, number, used);
    for (Triangle& triangle : surface.triangles)
        for (int& corner : triangle) corner = number[size_t(corner)];
}

static void repair_values(Surface& surface) {
    // Normals get unit length; those without a direction are made.
    const bool had_normals = !surface.normals.empty();
    std::vector<char> missing(surface.positions.size(), 1);
    surface.normals.resize(surface.positions.size(), Vec3f::Zero());
    int made = 0;
    for (size_t i = 0; i < missing.size(); ++i) {
        const Vec3 normal = surface.normals[i].cast<double>();
        const double length = normal.norm();
        missing[i] = !had_normals || !std::isfinite(length) || length < 1e-12;
        if (missing[i])
            ++made;
        else
            surface.normals[i] = (normal / length).cast<float>();
    }
    if (made > 0) make_normals(surface, missing);
    // A file without normals has nothing to repair.
    if (had_normals) surface.repaired_vertices += made;

    for (Vec2f& uv : surface.uvs)
        if (!uv.allFinite()) {
            uv.setZero();
            ++surface.repaired_vertices;
        }
}

static void check_area(const Surface& surface) {
    double area = 0;
    for (const Triangle& t : surface.triangles) {
        const Vec3& a = surface.positions[size_t(t[0])];
        area += (surface.positions[size_t(t[1])] - a).cross(surface.positions[size_t(t[2])] - a).norm() / 2;
    }
    const double size = surface.size();
    if (area > MOST_AREA * size * size)
        fail(FROND_RESULT_BAD_GEOMETRY,
             "the %zu triangles have %.3g m^2 in a plant of %.3g m, over %g times its size squared; "
             "give a plant's own surface",
             surface.triangles.size(), area, size, MOST_AREA);
}

void clean_surface(Surface& surface) {
    check_sizes(surface);
    if (surface.triangles.empty())
        fail(FROND_RESULT_BAD_GEOMETRY, "there are no triangles; a plant needs at least one");
    const std::vector<char> usable = find_usable(surface.positions);
    const size_t given = surface.triangles.size();
    drop_triangles(surface, choose_triangles(surface, usable));
    if (surface.triangles.empty())
        fail(FROND_RESULT_BAD_GEOMETRY,
             "none of the %zu triangles can be used: they have bad indices, no area, or coordinates that are not "
             "finite or "
             "beyond 1e9 m; check the mesh and the scale",
             given);
    drop_vertices(surface, usable);
    check_area(surface);
    repair_values(surface);
}

}  // namespace frond
