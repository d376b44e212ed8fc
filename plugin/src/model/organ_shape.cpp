// Organ shape. In: a topology. Out: for each triangle whether it is part of a sheet or of a tube.
// The plant is cut into short bands along its distance from the ground. A slab is a sheet if its normals, taken without
// sign, are all nearly parallel, or if they are roughly so and open edges run along it on both sides; a ring of a tube
// has normals all around and no open edge along it. That works for closed thin leaves and for coarse tubes alike. A
// large round component that is held up stands for leaves; if it encloses a volume it is a crown drawn as a solid.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/decompose.hpp"
#include "core/elementary.hpp"
#include "model/bands.hpp"
#include "model/organ_clues.hpp"

namespace frond {

constexpr double FLAT = 0.72;   // least share of the normals along one axis in a flat slab
constexpr double FOLDED = 0.6;  // the same in an open slab
constexpr double OPEN = 1.5;    // least length of open edges of an open slab, in lengths of the slab
constexpr double WHOLE = 0.93;  // share of a component's area from which all of it counts as one kind
constexpr double SLICES = 40;   // bands along the longest path through the plant

// Measures the length of open edges along the distance, per slab [m].
static std::vector<double> measure_open_edges(const Topology& topology, const std::vector<SharedEdge>& edges,
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
static int piece_of(const Topology& topology, const Bands& bands, size_t t) {
    double middle = 0;
    for (int p : topology.triangles[t]) middle += bands.distance[size_t(p)] / 3;
    return bands.piece_at(int(t), middle - bands.entry[size_t(topology.triangle_component[t])]);
}

// Measures the largest share of each slab's normals along one axis [-]: 1 for a plane, 1/2 for a tube.
static std::vector<double> measure_flatness(const Topology& topology, const Bands& bands) {
    std::vector<Mat3> spread(bands.pieces.size(), Mat3::Zero());
    for (size_t t = 0; t < topology.triangles.size(); t++) {
        const Vec3& a = topology.points[size_t(topology.triangles[t][0])];
        const Vec3 normal = (topology.points[size_t(topology.triangles[t][1])] - a)
                                .cross(topology.points[size_t(topology.triangles[t][2])] - a);
        const double area = normal.norm();
        if (area <= 0) continue;
        // A long triangle counts in each band that it passes through.
        const int count = bands.first[t + 1] - bands.first[t];
        const Mat3 share = normal * normal.transpose() / (area * count);
        for (int i = bands.first[t]; i < bands.first[t + 1]; i++) spread[size_t(bands.piece[size_t(i)])] += share;
    }
    std::vector<double> flat(bands.pieces.size(), 0.0);
    for (size_t i = 0; i < spread.size(); i++) {
        const double whole = spread[i].trace();
        if (!(whole > 0)) continue;
        flat[i] = largest_symmetric_value(spread[i] / whole);
    }
    return flat;
}

// Flips slabs that differ from all their neighbours, if these are larger together: such slabs are noise.
static void smooth_pieces(const Bands& bands, std::vector<char>& sheet) {
    std::vector<double> same(sheet.size(), 0.0), other(sheet.size(), 0.0);
    for (const Contact& contact : bands.contacts) {
        auto& sums = sheet[size_t(contact.low)] == sheet[size_t(contact.high)] ? same : other;
        sums[size_t(contact.low)] += bands.pieces[size_t(contact.high)].area;
        sums[size_t(contact.high)] += bands.pieces[size_t(contact.low)].area;
    }
    for (size_t i = 0; i < sheet.size(); i++)
        if (same[i] == 0 && other[i] > 1.5 * bands.pieces[i].area) sheet[i] = !sheet[i];
}

// Box, area and volume of a component.
struct Lump {
    Eigen::AlignedBox3d box;
    double area = 0;    // [m^2]
    double volume = 0;  // enclosed by its triangles, computed about a corner of the first one [m^3]
};

static std::vector<Lump> measure_lumps(const Topology& topology) {
    std::vector<Lump> lumps(size_t(topology.component_count));
    std::vector<Vec3> origin(lumps.size());
    for (size_t t = 0; t < topology.triangles.size(); t++) {
        const size_t component = size_t(topology.triangle_component[t]);
        Lump& lump = lumps[component];
        const Triangle& corners = topology.triangles[t];
        const Vec3 &a = topology.points[size_t(corners[0])], &b = topology.points[size_t(corners[1])],
                   &c = topology.points[size_t(corners[2])];
        if (lump.box.isEmpty()) origin[component] = a;
        lump.box.extend(a).extend(b).extend(c);
        lump.area += 0.5 * (b - a).cross(c - a).norm();
        lump.volume += (topology.turned[t] ? -1 : 1) *
                       (a - origin[component]).dot((b - origin[component]).cross(c - origin[component])) / 6;
    }
    return lumps;
}

// Finds components that stand for many leaves: about as wide as high, with nearly as much surface as a ball of that
// size at least, large, and held up by something else unless they may stand on the ground.
static std::vector<char> find_round(const std::vector<Lump>& lumps, bool on_ground) {
    constexpr double ROUND = 0.35, SOLID = 0.35, LARGE = 0.2, HELD_UP = 0.12;
    Eigen::AlignedBox3d whole;
    for (const Lump& lump : lumps) whole.extend(lump.box);
    std::vector<char> round(lumps.size(), 0);
    for (size_t i = 0; i < lumps.size(); i++) {
        if (lumps[i].box.isEmpty()) continue;
        const Vec3 size = lumps[i].box.sizes();
        const double surface = 2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
        const double foot = whole.min().y() + HELD_UP * whole.sizes().y();
        round[i] = size.minCoeff() > ROUND * size.maxCoeff() && lumps[i].area > SOLID * surface &&
                   size.norm() > LARGE * whole.sizes().norm() && (on_ground || lumps[i].box.min().y() > foot);
    }
    return round;
}

std::vector<char> find_crowns(const Topology& topology, bool on_ground) {
    constexpr double FULL = 0.2;     // least share of its box that a solid fills: a cone fills 0.26, a ball 0.52
    constexpr double COMPACT = 0.2;  // least 36 pi V^2 / A^3: a ball has 1, a cube 0.52; a rosette of thick leaves 0.1
    const std::vector<Lump> lumps = measure_lumps(topology);
    std::vector<char> crown = find_round(lumps, on_ground);
    for (size_t i = 0; i < lumps.size(); i++)
        crown[i] = crown[i] && std::abs(lumps[i].volume) > FULL * lumps[i].box.volume() &&
                   36 * PI * squared(lumps[i].volume) > COMPACT * frond::pow(lumps[i].area, 3);
    std::vector<char> found(topology.triangles.size());
    for (size_t t = 0; t < found.size(); t++) found[t] = crown[size_t(topology.triangle_component[t])];
    return found;
}

std::vector<char> find_sheets(const Topology& topology) {
    const size_t count = topology.triangles.size();
    // Distances start from the lowest point of all; their direction is not important here.
    int lowest = 0;
    for (size_t i = 0; i < topology.points.size(); i++)
        if (topology.points[i].y() < topology.points[size_t(lowest)].y()) lowest = int(i);
    std::vector<int> roots = {lowest};
    const std::vector<double> distance = measure_distances(topology, roots);
    const double farthest = *std::max_element(distance.begin(), distance.end());
    const double height = farthest > 0 ? farthest / SLICES : 1;
    const std::vector<SharedEdge> edges = find_shared_edges(topology);
    const std::vector<int> none(count, 0);
    const Bands bands = cut_bands(topology, edges, distance, none, none, height);

    const std::vector<double> flatness = measure_flatness(topology, bands);
    const std::vector<double> open = measure_open_edges(topology, edges, bands);
    std::vector<char> sheet(bands.pieces.size());
    for (size_t i = 0; i < sheet.size(); i++) {
        const double length = bands.pieces[i].far - bands.pieces[i].near;
        sheet[i] = flatness[i] > FLAT || (flatness[i] > FOLDED && open[i] > OPEN * length);
    }
    smooth_pieces(bands, sheet);

    // A component that is nearly all of one kind is all of that kind; others are decided slab by slab.
    std::vector<double> area(size_t(topology.component_count), 0.0), flat(area);
    for (size_t i = 0; i < sheet.size(); i++) {
        area[size_t(bands.pieces[i].component)] += bands.pieces[i].area;
        if (sheet[i]) flat[size_t(bands.pieces[i].component)] += bands.pieces[i].area;
    }
    const std::vector<char> round = find_round(measure_lumps(topology), false);
    std::vector<char> found(count);
    for (size_t t = 0; t < count; t++) {
        const size_t component = size_t(topology.triangle_component[t]);
        const double share = area[component] > 0 ? flat[component] / area[component] : 1;
        found[t] =
            round[component] || share >= WHOLE || (share > 1 - WHOLE && sheet[size_t(piece_of(topology, bands, t))]);
    }
    return found;
}

}  // namespace frond
