// In: a surface with its topology and organs. Out: pairs of triangles at which stems and supports touch a support.
#include "skeleton/chain_ties.hpp"

#include <algorithm>
#include <map>

#include "core/union_find.hpp"
#include "skeleton/topology_joints.hpp"
#include "surface/box_tree.hpp"

namespace frond {

namespace {

constexpr double TIED_GAP = 1e-3;  // largest gap between what is tied, over the plant's size [-]

// Triangles that may be tied, and those that hold.
struct Tied {
    const Topology& topology;
    std::vector<int> held, holding;
    std::vector<Box> boxes;  // of all triangles
    BoxTree tree;            // of those that hold
};

Tied list_triangles(const Surface& surface, const Topology& topology, const std::vector<Organ>& organs) {
    Tied tied{topology, {}, {}, {}, {}};
    for (const Part& part : surface.parts) {
        if (part.organ < 0 || size_t(part.organ) >= organs.size()) continue;
        const std::string& kind = organs[size_t(part.organ)].kind;
        const bool holds = kind == "support";
        for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++) {
            if (holds) tied.holding.push_back(t);
            if (holds || kind == "stem" || kind == "branch") tied.held.push_back(t);
        }
    }
    if (tied.holding.empty()) return tied;
    tied.boxes.resize(topology.triangles.size());
    for (size_t t = 0; t < tied.boxes.size(); t++)
        for (const Vec3& corner : corners_of(topology, int(t))) tied.boxes[t].extend(corner);
    grow_tree(tied.tree, tied.boxes, tied.holding, 2);
    return tied;
}

// Finds the nearest triangle of another component that holds, no farther away than `most` [m].
bool find_touch(const Tied& tied, int triangle, double most, Joint& touch) {
    const Topology& topology = tied.topology;
    const Corners corners = corners_of(topology, triangle);
    const int component = topology.triangle_component[size_t(triangle)];
    double bound = most * most;
    bool is_found = false;
    std::vector<int> open = {0};
    while (!open.empty()) {
        const int number = open.back();
        open.pop_back();
        const BoxTree::Node& node = tied.tree.nodes[size_t(number)];
        if (node.box.squaredExteriorDistance(tied.boxes[size_t(triangle)]) > bound) continue;
        if (node.right >= 0) {
            open.insert(open.end(), {number + 1, node.right});
            continue;
        }
        for (int i = node.first; i < node.first + node.count; i++) {
            const int other = tied.tree.items[size_t(i)];
            if (topology.triangle_component[size_t(other)] == component) continue;
            const NearestPair pair = nearest_of_triangles(corners, corners_of(topology, other));
            if (!(pair.squared <= bound)) continue;
            bound = pair.squared;
            touch = {triangle, other, pair.a, pair.b};
            is_found = true;
        }
    }
    return is_found;
}

// Connected triangles that touch one component.
struct Patch {
    std::vector<Joint> touches;
    Joint middle() const {
        Vec3 sum = Vec3::Zero();
        for (const Joint& touch : touches) sum += touch.point_a;
        const Vec3 mean = sum / double(touches.size());
        return *std::min_element(touches.begin(), touches.end(), [&](const Joint& a, const Joint& b) {
            return (a.point_a - mean).squaredNorm() < (b.point_a - mean).squaredNorm();
        });
    }
};

}  // namespace

std::vector<Joint> find_ties(const Surface& surface, const Topology& topology, const std::vector<Organ>& organs) {
    const Tied tied = list_triangles(surface, topology, organs);
    std::vector<Joint> touches;
    if (tied.holding.empty()) return touches;
    UnionFind patches(topology.points.size());
    const double most = TIED_GAP * surface.size();
    for (const int triangle : tied.held) {
        Joint touch;
        if (!find_touch(tied, triangle, most, touch)) continue;
        touches.push_back(touch);
        for (const int corner : topology.triangles[size_t(triangle)])
            patches.join(topology.triangles[size_t(triangle)][0], corner);
    }
    std::map<std::pair<int, int>, Patch> found;  // by the patch and the component that it touches
    for (const Joint& touch : touches)
        found[{patches.find(topology.triangles[size_t(touch.triangle_a)][0]),
               topology.triangle_component[size_t(touch.triangle_b)]}]
            .touches.push_back(touch);
    std::vector<Joint> ties;
    for (const auto& [key, patch] : found) ties.push_back(patch.middle());
    return ties;
}

}  // namespace frond
