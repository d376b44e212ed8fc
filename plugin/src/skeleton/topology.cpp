// From a triangle soup to its topology: vertices at nearly the same position become one point (a hash table of small
// cells), triangles that share points become one component, neighbours that are drawn the other way round are found,
// and joints tie the components together.
#include "skeleton/topology.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/assert.hpp"
#include "core/error.hpp"
#include "skeleton/topology_joints.hpp"

namespace frond {

// Vertices closer than this share of the plant's size are one point.
static constexpr double WELD_TOLERANCE = 1e-6;
// The same in soups, whose triangles do not share corners exactly; in a mesh, triangles share each point with others.
static constexpr double SOUP_TOLERANCE = 3e-5, SOUP_POINTS = 2.4;  // points a triangle
// Edge of a hash cell in tolerances: large enough that most vertices are searched for in one or two cells only.
static constexpr double CELL = 8;

using Cell = std::array<int64_t, 3>;

// Points by the cell that they lie in: linked lists in an open-addressing table.
struct PointTable {
    struct Slot {
        Cell cell;
        int first = -1;
    };
    std::vector<Slot> slots;
    std::vector<int> next;  // next point in the same cell, for each point

    explicit PointTable(size_t expected) {
        size_t count = 16;
        while (count < 2 * expected) count *= 2;
        slots.resize(count);
    }
    Slot& slot_of(const Cell& cell) {
        uint64_t hash = 0;
        for (int64_t coordinate : cell) {
            hash = (hash ^ uint64_t(coordinate)) * 0xD6E8FEB86659FD93ull;
            hash ^= hash >> 32;
        }
        size_t k = hash & (slots.size() - 1);
        while (slots[k].first >= 0 && slots[k].cell != cell) k = (k + 1) & (slots.size() - 1);
        return slots[k];
    }
};

static Cell cell_of(const Vec3& place, double cell_size) {
    return {int64_t(std::floor(place.x() / cell_size)), int64_t(std::floor(place.y() / cell_size)),
            int64_t(std::floor(place.z() / cell_size))};
}

// Returns the nearest point within the tolerance, or -1.
static int find_point(PointTable& table, const std::vector<Vec3>& points, const Vec3& place, double tolerance) {
    const Cell low = cell_of(place - Vec3::Constant(tolerance), CELL * tolerance);
    const Cell high = cell_of(place + Vec3::Constant(tolerance), CELL * tolerance);
    double best = tolerance * tolerance;
    int found = -1;
    for (int64_t x = low[0]; x <= high[0]; ++x)
        for (int64_t y = low[1]; y <= high[1]; ++y)
            for (int64_t z = low[2]; z <= high[2]; ++z)
                for (int i = table.slot_of({x, y, z}).first; i >= 0; i = table.next[size_t(i)]) {
                    const double squared = (points[size_t(i)] - place).squaredNorm();
                    if (squared < best || (squared == best && found < 0)) {
                        best = squared;
                        found = i;
                    }
                }
    return found;
}

static void weld(const Surface& surface, double size, double share, Topology& topology) {
    // Far from the origin the coordinates themselves are coarser than the tolerance.
    double reach = 0;
    for (const Vec3& place : surface.positions) reach = std::max(reach, place.cwiseAbs().maxCoeff());
    const double tolerance = std::max(share * size, 1e-14 * reach);
    PointTable table(surface.positions.size());
    topology.vertex_point.resize(surface.positions.size());
    for (size_t v = 0; v < surface.positions.size(); ++v) {
        const Vec3 place = surface.positions[v] - surface.positions[0];
        int found = find_point(table, topology.points, place, tolerance);
        if (found < 0) {
            found = int(topology.points.size());
            topology.points.push_back(place);
            PointTable::Slot& slot = table.slot_of(cell_of(place, CELL * tolerance));
            table.next.push_back(slot.first);
            slot = {cell_of(place, CELL * tolerance), found};
        }
        topology.vertex_point[v] = found;
    }
    // A point is exactly where its first vertex is.
    std::vector<char> placed(topology.points.size(), 0);
    for (size_t v = 0; v < surface.positions.size(); ++v) {
        const size_t i = size_t(topology.vertex_point[v]);
        if (!placed[i]) topology.points[i] = surface.positions[v];
        placed[i] = 1;
    }
}

static int find_root(std::vector<int>& parent, int i) {
    while (parent[size_t(i)] != i) i = parent[size_t(i)] = parent[size_t(parent[size_t(i)])];
    return i;
}

static void find_components(Topology& topology) {
    std::vector<int> parent(topology.points.size());
    std::iota(parent.begin(), parent.end(), 0);
    for (const Triangle& triangle : topology.triangles)
        for (size_t k = 1; k < 3; ++k) {
            const int a = find_root(parent, triangle[0]), b = find_root(parent, triangle[k]);
            parent[size_t(std::max(a, b))] = std::min(a, b);
        }
    // Numbers the components in the order in which triangles refer to them.
    std::vector<int> number(topology.points.size(), -1);
    topology.triangle_component.reserve(topology.triangles.size());
    for (const Triangle& triangle : topology.triangles) {
        int& component = number[size_t(find_root(parent, triangle[0]))];
        if (component < 0) component = topology.component_count++;
        topology.triangle_component.push_back(component);
    }
}

// Lists pairs of triangles that are the only two at an edge, with whether they run along it the same way.
struct Neighbours {
    int a, b;
    bool alike;
};
static std::vector<Neighbours> find_neighbours(const std::vector<Triangle>& triangles) {
    struct Half {
        std::array<int, 2> ends;  // the smaller point first
        int triangle;
        bool up;
    };
    std::vector<Half> halves;
    halves.reserve(3 * triangles.size());
    for (size_t t = 0; t < triangles.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            const int from = triangles[t][k], to = triangles[t][(k + 1) % 3];
            if (from != to) halves.push_back({{std::min(from, to), std::max(from, to)}, int(t), from < to});
        }
    std::sort(halves.begin(), halves.end(), [](const Half& p, const Half& q) {
        return p.ends != q.ends ? p.ends < q.ends : p.triangle < q.triangle;
    });
    std::vector<Neighbours> pairs;
    for (size_t i = 0; i < halves.size();) {
        size_t end = i + 1;
        while (end < halves.size() && halves[end].ends == halves[i].ends) ++end;
        const Half &a = halves[i], &b = halves[end - 1];
        if (end - i == 2 && a.triangle != b.triangle) pairs.push_back({a.triangle, b.triangle, a.up == b.up});
        i = end;
    }
    return pairs;
}

// Turns neighbours to one side, patch by patch; the side that most of a patch's area is drawn with stays.
static void orient(Topology& topology) {
    const size_t count = topology.triangles.size();
    topology.turned.assign(count, 0);
    const std::vector<Neighbours> pairs = find_neighbours(topology.triangles);
    std::vector<std::vector<std::pair<int, bool>>> next(count);
    for (const Neighbours& pair : pairs) {
        next[size_t(pair.a)].push_back({pair.b, pair.alike});
        next[size_t(pair.b)].push_back({pair.a, pair.alike});
    }
    std::vector<char> seen(count, 0);
    std::vector<int> patch;
    for (size_t first = 0; first < count; ++first) {
        if (seen[first]) continue;
        patch.assign(1, int(first));
        seen[first] = 1;
        std::array<double, 2> area = {0, 0};
        for (size_t i = 0; i < patch.size(); ++i) {
            const size_t t = size_t(patch[i]);
            const Triangle& corner = topology.triangles[t];
            const Vec3& a = topology.points[size_t(corner[0])];
            area[topology.turned[t] ? 1 : 0] +=
                (topology.points[size_t(corner[1])] - a).cross(topology.points[size_t(corner[2])] - a).norm();
            for (const auto& [other, alike] : next[t]) {
                if (seen[size_t(other)]) continue;
                seen[size_t(other)] = 1;
                topology.turned[size_t(other)] = char(topology.turned[t] ^ char(alike));
                patch.push_back(other);
            }
        }
        if (area[1] > area[0])
            for (int t : patch) topology.turned[size_t(t)] ^= 1;
    }
}

Topology make_topology(const Surface& surface) {
    // Later stages require a shape that has a size.
    if (surface.triangles.empty())
        fail(FROND_RESULT_BAD_GEOMETRY, "there are no triangles; a plant needs at least one");
    for (const Triangle& triangle : surface.triangles)
        for (int corner : triangle)
            if (corner < 0 || size_t(corner) >= surface.positions.size())
                fail(FROND_RESULT_BAD_GEOMETRY, "a triangle names vertex %d of %zu; clean the surface first", corner,
                     surface.positions.size());
    for (const Vec3& place : surface.positions)
        if (!place.allFinite()) fail(FROND_RESULT_BAD_GEOMETRY, "a vertex is not finite; clean the surface first");
    const double size = surface.size();
    if (!std::isfinite(size) || !(size > 1e-9))
        fail(FROND_RESULT_BAD_GEOMETRY,
             "all %zu triangles lie in one point (%g m across); check the mesh and the scale", surface.triangles.size(),
             size);

    Topology topology;
    weld(surface, size, WELD_TOLERANCE, topology);
    if (double(topology.points.size()) > SOUP_POINTS * double(surface.triangles.size())) {
        topology = {};
        weld(surface, size, SOUP_TOLERANCE, topology);
    }
    topology.triangles.reserve(surface.triangles.size());
    for (const Triangle& triangle : surface.triangles)
        topology.triangles.push_back({topology.vertex_point[size_t(triangle[0])],
                                      topology.vertex_point[size_t(triangle[1])],
                                      topology.vertex_point[size_t(triangle[2])]});
    find_components(topology);
    orient(topology);
    join_components(topology);
    FROND_ASSERT(topology.vertex_point.size() == surface.positions.size());
    FROND_ASSERT(topology.triangle_component.size() == surface.triangles.size());
    FROND_ASSERT(topology.turned.size() == surface.triangles.size());
    FROND_ASSERT(topology.joints.size() + 1 == size_t(topology.component_count));
    return topology;
}

}  // namespace frond
