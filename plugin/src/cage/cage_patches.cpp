// From triangles to patches: neighbours across an edge that exactly two triangles share get the same orientation. If
// the patch is then closed, or has small holes only, the divergence theorem gives the volume inside. Otherwise, or if
// its two faces are closer than half the material's thickness, the patch is a sheet.
#include "cage/cage_patches.hpp"

#include <algorithm>

namespace frond {

// A patch is closed if the area that closes its holes is smaller than this share of its own.
static constexpr double LARGEST_HOLE = 0.25;

// Sorts items by `first_of(i)` (below `count`), keeping the order of equal ones. Returns where each value begins.
template <class First>
static std::vector<int> bucket_starts(size_t item_count, int count, const First& first_of, std::vector<int>& sorted) {
    std::vector<int> start(size_t(count) + 1, 0);
    for (size_t i = 0; i < item_count; ++i) ++start[size_t(first_of(i)) + 1];
    for (size_t k = 1; k < start.size(); ++k) start[k] += start[k - 1];
    std::vector<int> next(start.begin(), start.end() - 1);
    sorted.resize(item_count);
    for (size_t i = 0; i < item_count; ++i) sorted[size_t(next[size_t(first_of(i))]++)] = int(i);
    return start;
}

static std::vector<char> find_repeated(const Topology& topology) {
    const size_t count = topology.triangles.size();
    std::vector<Triangle> ordered = topology.triangles;
    for (Triangle& triangle : ordered) std::sort(triangle.begin(), triangle.end());
    std::vector<int> sorted;
    const auto start = bucket_starts(
        count, int(topology.points.size()), [&](size_t t) { return ordered[t][0]; }, sorted);
    std::vector<char> repeated(count, 0);
    for (size_t p = 0; p + 1 < start.size(); ++p) {
        const auto begin = sorted.begin() + start[p], end = sorted.begin() + start[p + 1];
        std::sort(begin, end, [&](int a, int b) {
            return ordered[size_t(a)] != ordered[size_t(b)] ? ordered[size_t(a)] < ordered[size_t(b)] : a < b;
        });
        for (auto t = begin; t != end; ++t)
            if (t != begin && ordered[size_t(*t)] == ordered[size_t(*(t - 1))]) repeated[size_t(*t)] = 1;
    }
    return repeated;
}

static Edges find_edges(const Topology& topology, const std::vector<char>& repeated) {
    const size_t count = topology.triangles.size();
    Edges edges;
    edges.triangle_edges.assign(count, {-1, -1, -1});
    // Half edges with two different ends, by their smaller point.
    std::vector<int> halves;
    halves.reserve(3 * count);
    const auto ends = [&](int half) {
        const Triangle& corner = topology.triangles[size_t(half / 3)];
        return std::minmax(corner[size_t(half % 3)], corner[size_t((half + 1) % 3)]);
    };
    for (int half = 0; half < int(3 * count); ++half) {
        const Triangle& corner = topology.triangles[size_t(half / 3)];
        if (corner[size_t(half % 3)] != corner[size_t((half + 1) % 3)]) halves.push_back(half);
    }
    std::vector<int> sorted;
    const auto start = bucket_starts(
        halves.size(), int(topology.points.size()), [&](size_t i) { return ends(halves[i]).first; }, sorted);
    edges.first.push_back(0);
    for (size_t p = 0; p + 1 < start.size(); ++p) {
        const auto begin = sorted.begin() + start[p], end = sorted.begin() + start[p + 1];
        for (auto i = begin; i != end; ++i) *i = halves[size_t(*i)];
        std::sort(begin, end, [&](int a, int b) {
            const int far_a = ends(a).second, far_b = ends(b).second;
            return far_a != far_b ? far_a < far_b : a < b;
        });
        for (auto i = begin; i != end; ++i) {
            const bool opens = i == begin || ends(*i).second != ends(*(i - 1)).second;
            if (opens && i != begin) edges.first.push_back(int(edges.triangle.size()));
            edges.triangle_edges[size_t(*i / 3)][size_t(*i % 3)] = int(edges.first.size()) - 1;
            if (!repeated[size_t(*i / 3)]) edges.triangle.push_back(*i / 3);
        }
        if (begin != end) edges.first.push_back(int(edges.triangle.size()));
    }
    return edges;
}

// Returns whether a triangle runs along its edge from the smaller point to the larger.
static bool runs_up(const Topology& topology, int t, int edge, const Edges& edges) {
    const auto& own = edges.triangle_edges[size_t(t)];
    const size_t k = own[0] == edge ? 0 : own[1] == edge ? 1 : 2;
    return topology.triangles[size_t(t)][k] < topology.triangles[size_t(t)][(k + 1) % 3];
}

// Returns the only other triangle at an edge if it has the same organ, or -1; one that lies on another is by itself.
static int across(const Patches& patches, const std::vector<int>& triangle_organ, int t, int edge) {
    if (edge < 0 || patches.repeated[size_t(t)]) return -1;
    const int begin = patches.edges.first[size_t(edge)];
    if (patches.edges.first[size_t(edge) + 1] - begin != 2) return -1;
    const int a = patches.edges.triangle[size_t(begin)], b = patches.edges.triangle[size_t(begin) + 1];
    const int other = a == t ? b : a;
    return other != t && triangle_organ[size_t(other)] == triangle_organ[size_t(t)] ? other : -1;
}

// Collects a patch from its first triangle. Returns false if it cannot be oriented.
static bool gather(const Topology& topology, const std::vector<int>& triangle_organ, int first, Patches& patches,
                   std::vector<int>& members) {
    const int number = int(patches.patches.size());
    members.assign(1, first);
    patches.triangle_patch[size_t(first)] = number;
    bool oriented = true;
    for (size_t i = 0; i < members.size(); ++i) {
        const int t = members[i];
        for (int edge : patches.edges.triangle_edges[size_t(t)]) {
            const int other = across(patches, triangle_organ, t, edge);
            if (other < 0) continue;
            const bool same_way =
                runs_up(topology, t, edge, patches.edges) == runs_up(topology, other, edge, patches.edges);
            const char flip = char(patches.flipped[size_t(t)] ^ char(same_way));
            if (patches.triangle_patch[size_t(other)] == number) {
                oriented = oriented && patches.flipped[size_t(other)] == flip;
            } else {
                patches.triangle_patch[size_t(other)] = number;
                patches.flipped[size_t(other)] = flip;
                members.push_back(other);
            }
        }
    }
    return oriented;
}

// Closes each hole with triangles from its rim to its middle. Returns their area. `loop`: scratch, one per point, all
// -1 before and after.
static double close_holes(const Topology& topology, const std::vector<int>& triangle_organ,
                          const std::vector<int>& members, const Patches& patches, std::vector<int>& loop,
                          Patch& patch) {
    // Edges of the rims, in the direction that a closing triangle needs.
    std::vector<std::array<int, 2>> rim;
    for (int t : members)
        for (size_t k = 0; k < 3; ++k) {
            const int edge = patches.edges.triangle_edges[size_t(t)][k];
            if (edge < 0 || across(patches, triangle_organ, t, edge) >= 0) continue;
            int u = topology.triangles[size_t(t)][k], v = topology.triangles[size_t(t)][(k + 1) % 3];
            if (patches.flipped[size_t(t)]) std::swap(u, v);
            rim.push_back({v, u});
        }
    const auto find = [&loop](int i) {
        while (loop[size_t(i)] != i) i = loop[size_t(i)] = loop[size_t(loop[size_t(i)])];
        return i;
    };
    for (const auto& [u, v] : rim) loop[size_t(u)] = u, loop[size_t(v)] = v;
    for (const auto& [u, v] : rim) loop[size_t(std::max(find(u), find(v)))] = std::min(find(u), find(v));
    std::stable_sort(rim.begin(), rim.end(), [&](const auto& a, const auto& b) { return find(a[0]) < find(b[0]); });
    double area = 0;
    for (size_t i = 0; i < rim.size();) {
        size_t end = i;
        Vec3 middle = Vec3::Zero();
        double length = 0;
        for (; end < rim.size() && find(rim[end][0]) == find(rim[i][0]); ++end) {
            const Vec3 &a = topology.points[size_t(rim[end][0])], &b = topology.points[size_t(rim[end][1])];
            middle += (b - a).norm() * 0.5 * (a + b);
            length += (b - a).norm();
        }
        if (length > 0) middle /= length;
        for (; i < end; ++i) {
            const Vec3 &a = topology.points[size_t(rim[i][0])], &b = topology.points[size_t(rim[i][1])];
            area += 0.5 * (b - a).cross(middle - a).norm();
            patch.caps.push_back({a, b, middle});
        }
    }
    for (const auto& [u, v] : rim) loop[size_t(u)] = loop[size_t(v)] = -1;
    return area;
}

static void measure(const Topology& topology, const std::vector<int>& members, const Organ& organ, bool oriented,
                    double hole_area, Patches& patches, Patch& patch) {
    // The volume is computed about a point nearby, for precision.
    const Vec3 origin = topology.points[size_t(topology.triangles[size_t(members[0])][0])];
    double volume = 0, area = 0;
    Vec3 of_volume = Vec3::Zero(), of_area = of_volume;  // moments
    const auto enclose = [&](double part, const Vec3& corners) {
        volume += part;
        of_volume += part * corners / 4;
    };
    for (int t : members) {
        if (patches.repeated[size_t(t)]) continue;
        const Triangle& corner = topology.triangles[size_t(t)];
        const Vec3 a = topology.points[size_t(corner[0])] - origin, b = topology.points[size_t(corner[1])] - origin,
                   c = topology.points[size_t(corner[2])] - origin;
        const double own = 0.5 * (b - a).cross(c - a).norm();
        enclose((patches.flipped[size_t(t)] ? -1 : 1) * a.dot(b.cross(c)) / 6, a + b + c);
        area += own;
        of_area += own * (a + b + c) / 3;
    }
    for (const auto& cap : patch.caps) {
        const Vec3 a = cap[0] - origin, b = cap[1] - origin, c = cap[2] - origin;
        enclose(a.dot(b.cross(c)) / 6, a + b + c);
    }
    patch.area = area;
    patch.solid = oriented && members.size() >= 4 && area > 0 && hole_area < LARGEST_HOLE * area && volume != 0;
    // A leaf with two faces is a sheet drawn twice if they are closer together than half its thickness.
    const double sheet = area * organ.material.thickness * (patch.solid ? 0.5 : 1);
    patch.filled = patch.solid && std::abs(volume) >= 0.5 * sheet;
    patch.volume = patch.filled ? std::abs(volume) : 0;
    patch.tissue = patch.filled ? std::min(patch.volume, 0.5 * area * solid_thickness(organ)) : sheet;
    patch.centre = origin;
    if (area > 0) patch.centre += patch.filled ? Vec3(of_volume / volume) : Vec3(of_area / area);
    if (!patch.solid) patch.caps.clear();
    if (!patch.solid || volume > 0) return;
    for (int t : members) patches.flipped[size_t(t)] ^= 1;
    for (auto& cap : patch.caps) std::swap(cap[0], cap[1]);
}

Patches make_patches(const Topology& topology, const std::vector<int>& triangle_organ,
                     const std::vector<Organ>& organs) {
    Patches patches;
    const size_t count = topology.triangles.size();
    patches.repeated = find_repeated(topology);
    patches.edges = find_edges(topology, patches.repeated);
    patches.triangle_patch.assign(count, -1);
    patches.flipped.assign(count, 0);
    std::vector<int> members, loop(topology.points.size(), -1);
    for (size_t t = 0; t < count; ++t) {
        if (patches.triangle_patch[t] >= 0) continue;
        const bool oriented = gather(topology, triangle_organ, int(t), patches, members);
        Patch patch;
        patch.organ = triangle_organ[t];
        const double hole_area = oriented ? close_holes(topology, triangle_organ, members, patches, loop, patch) : 0;
        measure(topology, members, organs[size_t(patch.organ)], oriented, hole_area, patches, patch);
        patches.patches.push_back(std::move(patch));
    }
    return patches;
}

}  // namespace frond
