// Organ slabs. In: a topology. Out: slabs along the way from the ground, told to be sheets or tubes by their shape.
// A slab of a tube is a ring: it encloses an area nearly as large as its outline allows (a circle 1, a square 0.8, a
// triangle 0.6), and its normals point all around. A slab of a sheet, open or drawn with two faces, encloses next to
// nothing, its normals, taken without sign, are nearly parallel, or open edges run along it on both sides.
#include <algorithm>
#include <cmath>

#include "core/decompose.hpp"
#include "core/elementary.hpp"
#include "skeleton/organ_slabs.hpp"

namespace frond {

namespace {

constexpr double SLICES = 40;        // bands along the longest path through the plant
constexpr double LEAST_SLICES = 10;  // bands in a component of at least FEW_TRIANGLES_CUT triangles
constexpr int FEW_TRIANGLES_CUT = 12;
constexpr double SHEET_FLAT = 0.8;    // least share of the normals along one axis in a flat slab
constexpr double SHEET_FOLDED = 0.6;  // the same in an open or hollow slab
constexpr double SHEET_OPEN = 1.5;    // least length of open edges of an open slab, in lengths of the slab
constexpr double SHEET_HOLLOW = 0.3;  // most of the area of its outline that a sheet with two faces encloses
constexpr double SHEET_EMPTY = 0.12;  // the same for a sheet that is folded deeply

// Returns the point that the plant grows from: near the ground, below its middle.
int find_foot(const Topology& topology) {
    constexpr double NEAR = 0.05;  // share of the height
    Eigen::AlignedBox3d box;
    Vec3 middle = Vec3::Zero();
    for (const Vec3& point : topology.points) {
        box.extend(point);
        middle += point / double(topology.points.size());
    }
    int foot = -1;
    double least = INFINITY;
    for (size_t i = 0; i < topology.points.size(); i++) {
        const Vec3& point = topology.points[i];
        if (point.y() > box.min().y() + NEAR * box.sizes().y()) continue;
        // Lower is better, four times as much as nearer to the middle.
        const double away = squared(point.x() - middle.x()) + squared(point.z() - middle.z()) +
                            squared(4 * (point.y() - box.min().y()));
        if (away >= least) continue;
        least = away;
        foot = int(i);
    }
    return foot;
}

// Returns the points around the foot on the ground, along edges: the lower end of a stem, from all around which the
// bands of distance rise alike.
std::vector<int> find_feet(const Topology& topology) {
    constexpr double LEVEL = 0.01, NEAR = 0.1;  // shares of the plant's size
    Eigen::AlignedBox3d box;
    for (const Vec3& point : topology.points) box.extend(point);
    const double size = box.diagonal().norm();
    std::vector<int> feet = {find_foot(topology)};
    const Vec3 foot = topology.points[size_t(feet[0])];
    const auto is_low = [&](int point) {
        const Vec3 way = topology.points[size_t(point)] - foot;
        return std::abs(way.y()) <= LEVEL * size && way.norm() <= NEAR * size;
    };
    std::vector<std::array<int, 2>> edges;
    for (const Triangle& corners : topology.triangles)
        for (size_t k = 0; k < 3; k++)
            if (is_low(corners[k]) && is_low(corners[(k + 1) % 3])) edges.push_back({corners[k], corners[(k + 1) % 3]});
    std::vector<char> known(topology.points.size(), 0);
    known[size_t(feet[0])] = 1;
    for (bool grown = true; grown;) {
        grown = false;
        for (const auto& [a, b] : edges) {
            if (known[size_t(a)] == known[size_t(b)]) continue;
            feet.push_back(known[size_t(a)] ? b : a);
            known[size_t(feet.back())] = 1;
            grown = true;
        }
    }
    return feet;
}

// Stretches the distances within small components, so that they too are cut into enough bands. Returns the factor of
// each component.
std::vector<double> stretch(const Topology& topology, double height, std::vector<double>& distance) {
    const size_t count = size_t(topology.component_count);
    std::vector<double> near(count, INFINITY), far(count, -INFINITY), factor(count, 1.0);
    std::vector<int> triangles(count, 0), component(topology.points.size(), -1);
    for (size_t t = 0; t < topology.triangles.size(); t++) {
        const size_t c = size_t(topology.triangle_component[t]);
        triangles[c]++;
        for (int p : topology.triangles[t]) {
            component[size_t(p)] = int(c);
            near[c] = std::min(near[c], distance[size_t(p)]);
            far[c] = std::max(far[c], distance[size_t(p)]);
        }
    }
    for (size_t c = 0; c < count; c++)
        if (triangles[c] >= FEW_TRIANGLES_CUT && far[c] > near[c])
            factor[c] = std::max(1.0, LEAST_SLICES * height / (far[c] - near[c]));
    for (size_t i = 0; i < distance.size(); i++) {
        if (component[i] < 0) continue;
        const size_t c = size_t(component[i]);
        distance[i] = near[c] + (distance[i] - near[c]) * factor[c];
    }
    return factor;
}

// Measures the length of open edges along the distance, per slab [m].
std::vector<double> measure_open_edges(const Topology& topology, const std::vector<SharedEdge>& edges,
                                       const Bands& bands) {
    std::vector<std::array<char, 3>> shared(topology.triangles.size(), {0, 0, 0});
    const auto mark = [&](int triangle, const SharedEdge& edge) {
        const Triangle& t = topology.triangles[size_t(triangle)];
        for (size_t k = 0; k < 3; k++) {
            const int u = t[k], v = t[(k + 1) % 3];
            if (std::min(u, v) == edge.u && std::max(u, v) == edge.v) shared[size_t(triangle)][k] = 1;
        }
    };
    for (const SharedEdge& edge : edges) {
        mark(edge.triangle_a, edge);
        mark(edge.triangle_b, edge);
    }
    std::vector<double> open(bands.pieces.size(), 0.0);
    for (size_t t = 0; t < topology.triangles.size(); t++)
        for (size_t k = 0; k < 3; k++) {
            if (shared[t][k]) continue;
            const double entry = bands.entry[size_t(topology.triangle_component[t])];
            double a = bands.distance[size_t(topology.triangles[t][k])] - entry;
            double b = bands.distance[size_t(topology.triangles[t][(k + 1) % 3])] - entry;
            if (a > b) std::swap(a, b);
            for (int i = bands.first[t]; i < bands.first[t + 1]; i++) {
                const double low = (bands.first_band[t] + i - bands.first[t]) * bands.height;
                const double part = std::min(b, low + bands.height) - std::max(a, low);
                if (part > 0) open[size_t(bands.piece[size_t(i)])] += part;
            }
        }
    return open;
}

// Returns the slab that holds a triangle's middle.
int piece_of(const Topology& topology, const Bands& bands, size_t t) {
    double middle = 0;
    for (int p : topology.triangles[t]) middle += bands.distance[size_t(p)] / 3;
    return bands.piece_at(int(t), middle - bands.entry[size_t(topology.triangle_component[t])]);
}

// Adds up the normals of each slab. Returns the largest share of them along one axis [-]: 1 for a plane, 1/2 for a
// tube.
std::vector<double> measure_normals(const Topology& topology, const Bands& bands, std::vector<Slab>& slabs) {
    std::vector<Mat3> spread(slabs.size(), Mat3::Zero());
    for (size_t t = 0; t < topology.triangles.size(); t++) {
        const Triangle& corner = topology.triangles[t];
        const Vec3 &a = topology.points[size_t(corner[0])], &b = topology.points[size_t(corner[1])],
                   &c = topology.points[size_t(corner[2])];
        const Vec3 normal = (topology.turned[t] ? -0.5 : 0.5) * (b - a).cross(c - a);
        const double area = normal.norm();
        if (area <= 0) continue;
        // A long triangle counts in each band that it passes through.
        const int count = bands.first[t + 1] - bands.first[t];
        const Mat3 share = normal * normal.transpose() / (area * count);
        for (int i = bands.first[t]; i < bands.first[t + 1]; i++) {
            const size_t piece = size_t(bands.piece[size_t(i)]);
            spread[piece] += share;
            slabs[piece].normal += normal / count;
            slabs[piece].flux += a.dot(normal) / count;
            slabs[piece].box.extend(a).extend(b).extend(c);
        }
    }
    std::vector<double> flat(slabs.size(), 0.0);
    for (size_t i = 0; i < flat.size(); i++) {
        const double whole = spread[i].trace();
        if (whole > 0) flat[i] = largest_symmetric_value(spread[i] / whole);
    }
    return flat;
}

// Flips slabs that differ from all their neighbours, if these are larger together: such slabs are noise.
void smooth(const Bands& bands, std::vector<Slab>& slabs) {
    std::vector<double> same(slabs.size(), 0.0), other(slabs.size(), 0.0);
    for (const SlabLink& link : bands.links) {
        const size_t low = size_t(link.low), high = size_t(link.high);
        if (bands.pieces[low].group != bands.pieces[high].group) continue;
        auto& sums = slabs[low].is_sheet == slabs[high].is_sheet ? same : other;
        sums[low] += bands.pieces[high].area;
        sums[high] += bands.pieces[low].area;
    }
    for (size_t i = 0; i < slabs.size(); i++)
        if (same[i] == 0 && other[i] > 1.5 * bands.pieces[i].area) slabs[i].is_sheet = !slabs[i].is_sheet;
}

}  // namespace

Slabs cut_slabs(const Surface& surface, const Topology& topology) {
    Slabs out;
    std::vector<int> roots = find_feet(topology);
    std::vector<double> distance = measure_distances(topology, roots);
    const double farthest = *std::max_element(distance.begin(), distance.end());
    const double height = farthest > 0 ? farthest / SLICES : 1;
    const std::vector<double> factor = stretch(topology, height, distance);
    const std::vector<SharedEdge> edges = find_shared_edges(topology);
    // Groups of the chain's have the first numbers.
    std::vector<int> group(topology.triangles.size(), SUPPORT_GROUP + 1);
    for (size_t p = 0; p < surface.parts.size(); p++)
        std::fill_n(group.begin() + surface.parts[p].first_triangle, surface.parts[p].triangle_count,
                    SUPPORT_GROUP + 1 + int(p));
    out.bands = cut_bands(topology, edges, distance, group, group, height);
    out.tree = grow_tree(topology, out.bands, roots, {});

    const Bands& bands = out.bands;
    out.slabs.resize(bands.pieces.size());
    const std::vector<double> flat = measure_normals(topology, bands, out.slabs);
    const std::vector<double> open = measure_open_edges(topology, edges, bands);
    for (size_t i = 0; i < out.slabs.size(); i++) {
        const Piece& piece = bands.pieces[i];
        Slab& slab = out.slabs[i];
        slab.parent = out.tree.shoots[i].parent;
        slab.length = (piece.far - piece.near) / factor[size_t(piece.component)];
        const Vec3 middle = piece.area > 0 ? Vec3(piece.sum / piece.area + bands.origin) : bands.origin;
        const double enclosed = 0.5 * std::abs(slab.flux - middle.dot(slab.normal));  // area of the section by length
        const double full = piece.area > 0 ? 4 * PI * enclosed * slab.length / squared(piece.area) : 0;
        const double edge = open[i] / (factor[size_t(piece.component)] * slab.length);
        slab.is_sheet = flat[i] > SHEET_FLAT ||
                        (flat[i] > SHEET_FOLDED && (full < SHEET_HOLLOW || edge > SHEET_OPEN)) || full < SHEET_EMPTY;
    }
    smooth(bands, out.slabs);
    out.slab_of.resize(topology.triangles.size());
    for (size_t t = 0; t < out.slab_of.size(); t++) out.slab_of[t] = piece_of(topology, bands, t);
    return out;
}

}  // namespace frond
