// Smoothing: one by one, nodes on the outside of the cage move towards the surface and towards the mean of their
// neighbours on the outside. A move is accepted only if all tets around keep a positive volume and good angles, and if
// every vertex that was in them still is in one of them; else half of it is tried.
#include <algorithm>

#include "cage/cage_parts.hpp"
#include "core/elementary.hpp"
#include "core/lists.hpp"
#include "surface/triangle_distance.hpp"

namespace frond {

static constexpr int PASSES = 3;    // over all nodes; each starts from its neighbours' new places
static constexpr int HALVINGS = 3;  // of a move that would spoil a tet: down to an eighth
// Limits of the angles between two faces [degree].
static constexpr double SMALLEST_ANGLE = 14, LARGEST_ANGLE = 162;
// Least distance of the outside from the surface as a share of a cell, in addition to the offset.
static constexpr double NEAREST = 0.15;
// Share of the distance to the mean of the neighbours that a pass moves a node.
static constexpr double RELAXATION = 0.25;
// Largest number of triangles of a copy that are searched for the nearest point.
static constexpr int TRIANGLE_SAMPLES = 150;
// Bound of rounding errors of weights.
static constexpr double TOLERANCE = -1e-10;

namespace {

struct Smoother {
    const Surface& surface;
    Draft& draft;
    std::vector<std::vector<int>> node_tets;
    std::vector<std::vector<int>> around;   // neighbours of each node
    std::vector<std::vector<int>> outside;  // neighbours along the outside; none for nodes within
    std::vector<int> vertex_tet;
    std::vector<std::vector<int>> tet_vertices;
    // Scratch data of a move.
    struct Change {
        int vertex, from, to;
    };
    std::vector<Change> changes;
    struct Frame {
        Mat3 inverse;
        Vec3 origin;
    };
    std::vector<Frame> frames;  // frames of the tets around the node
};

}  // namespace

// Finds the nodes of faces that belong to one tet only, each with its neighbours there.
static void find_outside(const Cage& cage, std::vector<std::vector<int>>& outside) {
    std::vector<std::array<int, 3>> faces;
    faces.reserve(4 * cage.tets.size());
    for (const Tet& tet : cage.tets)
        for (size_t skip = 0; skip < 4; ++skip) {
            std::array<int, 3> face = {tet[(skip + 1) % 4], tet[(skip + 2) % 4], tet[(skip + 3) % 4]};
            std::sort(face.begin(), face.end());
            faces.push_back(face);
        }
    std::sort(faces.begin(), faces.end());
    outside.assign(cage.nodes.size(), {});
    for (size_t i = 0, end; i < faces.size(); i = end) {
        for (end = i; end < faces.size() && faces[end] == faces[i];) ++end;
        if (end - i > 1) continue;
        for (size_t k = 0; k < 3; ++k)
            for (size_t other : {(k + 1) % 3, (k + 2) % 3}) outside[size_t(faces[i][k])].push_back(faces[i][other]);
    }
    for (std::vector<int>& list : outside) sort_unique(list);
}

// Finds for each node on the outside the nearest point of the surface that its copies carry.
static std::vector<Vec3> find_nearest_places(const Smoother& smoother) {
    const Draft& draft = smoother.draft;
    std::vector<std::vector<int>> copy_triangles(draft.copies.cell.size());
    for (size_t e = 0; e < draft.voxels.item.size(); ++e)
        if (size_t(draft.voxels.item[e]) < draft.topology.triangles.size())
            copy_triangles[size_t(draft.copies.entry_copy[e])].push_back(draft.voxels.item[e]);
    std::vector<Vec3> nearest = draft.cage.nodes;
    std::vector<double> squared(draft.cage.nodes.size(), 1e300);
    for (size_t copy = 0; copy < copy_triangles.size(); ++copy) {
        const std::vector<int>& triangles = copy_triangles[copy];
        for (size_t i = 0; i < triangles.size(); i += triangles.size() / TRIANGLE_SAMPLES + 1) {
            const Triangle& corner = draft.topology.triangles[size_t(triangles[i])];
            const Corners corners = {draft.topology.points[size_t(corner[0])], draft.topology.points[size_t(corner[1])],
                                     draft.topology.points[size_t(corner[2])]};
            for (int node : draft.copies.nodes[copy]) {
                if (smoother.outside[size_t(node)].empty()) continue;
                const Vec3 place = nearest_in_triangle(corners, draft.cage.nodes[size_t(node)]);
                const double distance = (place - draft.cage.nodes[size_t(node)]).squaredNorm();
                if (distance >= squared[size_t(node)]) continue;
                squared[size_t(node)] = distance;
                nearest[size_t(node)] = place;
            }
        }
    }
    return nearest;
}

// Returns whether the tets around a node are well shaped; sets their frames.
static bool are_sound(Smoother& smoother, int node) {
    static const double LARGEST_COSINE = frond::cos(SMALLEST_ANGLE * PI / 180);
    static const double SMALLEST_COSINE = frond::cos(LARGEST_ANGLE * PI / 180);
    const Cage& cage = smoother.draft.cage;
    smoother.frames.clear();
    for (int e : smoother.node_tets[size_t(node)]) {
        std::array<Vec3, 4> corners;
        for (size_t k = 0; k < 4; ++k) corners[k] = cage.nodes[size_t(cage.tets[size_t(e)][k])];
        if (!(tet_volume(corners[0], corners[1], corners[2], corners[3]) > 0)) return false;
        double of_smallest, of_largest;
        if (!dihedral_cosines(corners, of_smallest, of_largest)) return false;
        if (of_smallest > LARGEST_COSINE || of_largest < SMALLEST_COSINE) return false;
        Mat3 edges;
        edges << corners[1] - corners[0], corners[2] - corners[0], corners[3] - corners[0];
        smoother.frames.push_back({edges.inverse(), corners[0]});
    }
    return true;
}

static bool holds(const Smoother::Frame& frame, const Vec3& place) {
    const Vec3 weights = frame.inverse * (place - frame.origin);
    return weights.minCoeff() >= TOLERANCE && weights.sum() <= 1 - TOLERANCE;
}

// Returns whether a vertex may be attached to a tet: one of its own copy, or of a neighbouring copy with a connected
// part.
static bool belongs(const Smoother& smoother, int vertex, int tet) {
    const Draft& draft = smoother.draft;
    const int home = draft.vertex_copy[size_t(vertex)], copy = tet / TETS_PER_COPY;
    if (copy == home) return true;
    const std::vector<int>& near = draft.copies.neighbors[size_t(home)];
    return std::binary_search(near.begin(), near.end(), copy);
}

// Returns whether all vertices that were in the tets around still are in one of them; lists those that changed.
static bool keeps_vertices(Smoother& smoother, int node) {
    const std::vector<int>& around = smoother.node_tets[size_t(node)];
    smoother.changes.clear();
    for (size_t i = 0; i < around.size(); ++i)
        for (int v : smoother.tet_vertices[size_t(around[i])]) {
            const Vec3& place = smoother.surface.positions[size_t(v)];
            if (holds(smoother.frames[i], place)) continue;
            int found = -1;
            for (size_t k = 0; k < around.size() && found < 0; ++k)
                if (k != i && holds(smoother.frames[k], place) && belongs(smoother, v, around[k])) found = around[k];
            if (found < 0) return false;
            smoother.changes.push_back({v, around[i], found});
        }
    return true;
}

static bool try_move(Smoother& smoother, int node, const Vec3& to) {
    Vec3& place = smoother.draft.cage.nodes[size_t(node)];
    const Vec3 before = place;
    place = to;
    if (!are_sound(smoother, node) || !keeps_vertices(smoother, node)) {
        place = before;
        return false;
    }
    for (const auto& [vertex, from, found] : smoother.changes) {
        std::vector<int>& list = smoother.tet_vertices[size_t(from)];
        *std::find(list.begin(), list.end(), vertex) = list.back();
        list.pop_back();
        smoother.tet_vertices[size_t(found)].push_back(vertex);
        smoother.vertex_tet[size_t(vertex)] = found;
    }
    return true;
}

static void move_nodes(Smoother& smoother, const std::vector<Vec3>& wanted, double smoothness) {
    std::vector<Vec3>& nodes = smoother.draft.cage.nodes;
    for (int node = 0; node < int(nodes.size()); ++node) {
        // The middle of a cell, like any other node within, moves to the mean of its neighbours.
        const bool within = smoother.outside[size_t(node)].empty();
        const std::vector<int>& neighbors = within ? smoother.around[size_t(node)] : smoother.outside[size_t(node)];
        Vec3 mean = Vec3::Zero();
        for (int other : neighbors) mean += nodes[size_t(other)] / double(neighbors.size());
        const Vec3 here = nodes[size_t(node)];
        Vec3 move =
            within ? Vec3(mean - here) : Vec3(wanted[size_t(node)] - here + RELAXATION * smoothness * (mean - here));
        if (move.norm() < 1e-3 * smoother.draft.voxels.lattice.cell_size) continue;
        for (int halving = 0; halving < HALVINGS; ++halving) {
            if (try_move(smoother, node, here + move)) break;
            move *= 0.5;
        }
    }
}

void smooth_cage(const Surface& surface, const CageOptions& options, Draft& draft, Embedding& embedding) {
    if (options.smoothness == 0) return;
    Cage& cage = draft.cage;
    Smoother smoother{surface, draft, {}, {}, {}, embedding.tet, {}, {}, {}};
    smoother.node_tets.resize(cage.nodes.size());
    for (size_t e = 0; e < cage.tets.size(); ++e)
        for (int node : cage.tets[e]) smoother.node_tets[size_t(node)].push_back(int(e));
    smoother.tet_vertices.resize(cage.tets.size());
    for (size_t v = 0; v < surface.positions.size(); ++v)
        if (draft.vertex_copy[v] >= 0) smoother.tet_vertices[size_t(embedding.tet[v])].push_back(int(v));
    find_outside(cage, smoother.outside);
    smoother.around.resize(cage.nodes.size());
    for (size_t i = 0; i < cage.nodes.size(); ++i) {
        std::vector<int>& list = smoother.around[i];
        for (int e : smoother.node_tets[i])
            for (int other : cage.tets[size_t(e)])
                if (other != int(i)) list.push_back(other);
        sort_unique(list);
    }

    // Target of each node, without constraints.
    std::vector<Vec3> wanted = find_nearest_places(smoother);
    const double nearest = options.offset + NEAREST * draft.voxels.lattice.cell_size;
    for (size_t i = 0; i < wanted.size(); ++i) {
        const Vec3 outward = cage.nodes[i] - wanted[i];
        const double distance = outward.norm();
        wanted[i] = cage.nodes[i];
        if (distance > nearest) wanted[i] -= options.smoothness * (distance - nearest) / distance * outward;
    }
    for (int pass = 0; pass < PASSES; ++pass) move_nodes(smoother, wanted, options.smoothness);

    for (size_t v = 0; v < surface.positions.size(); ++v) {
        if (draft.vertex_copy[v] >= 0) embedding.tet[v] = smoother.vertex_tet[v];
        embedding.weights[v] = tet_weights(cage.nodes, cage.tets[size_t(embedding.tet[v])], surface.positions[v]);
    }
}

}  // namespace frond
