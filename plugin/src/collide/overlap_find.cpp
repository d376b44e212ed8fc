// Finds overlaps: bodies come in, nodes within tets and edges through faces go out. Boxes of tets and faces are
// paired with nodes and boxes of edges in a spatial hash (Teschner et al. 2003, for nodes and tets); pairs are tested
// exactly.
#include <algorithm>
#include <tuple>

#include "collide/overlap.hpp"
#include "core/timer.hpp"

namespace frond {

// ---- boxes ----

// A body that does not collide with itself is one group; else each of its regions is one, as none collides with itself.
struct Groups {
    std::vector<int> first;
    explicit Groups(const OverlapScene& scene) {
        int count = 0;
        for (const CollisionBody& body : scene.bodies) {
            first.push_back(count);
            count += body.with_itself ? body.collider->piece_count : 1;
        }
    }
    int of(const OverlapScene& scene, int body, int piece) const {
        return first[size_t(body)] + (scene.bodies[size_t(body)].with_itself ? piece : 0);
    }
};

template <class Corners>
static BoxSet::Bounds bounds_of(const OverlapScene& scene, int body, const Corners& corners, int group) {
    BoxSet::Bounds box;
    const Vec3& first = scene.place(body, corners[0]);
    for (int k = 0; k < 3; ++k) box.lower[k] = box.upper[k] = first[k];
    for (size_t c = 1; c < corners.size(); ++c) {
        const Vec3& corner = scene.place(body, corners[c]);
        for (int k = 0; k < 3; ++k) {
            box.lower[k] = std::min(box.lower[k], corner[k]);
            box.upper[k] = std::max(box.upper[k], corner[k]);
        }
    }
    box.group = group;
    return box;
}

// Fills in boxes by corners_of(collider, number) and piece_of(collider, number) of each number in the list.
template <class CornersOf, class PieceOf>
static void fill_boxes(const OverlapScene& scene, const Groups& groups, const std::vector<int>& list,
                       const std::vector<int>& body, BoxSet& out, CornersOf&& corners_of, PieceOf&& piece_of) {
    out.boxes.clear();
    for (size_t i = 0; i < list.size(); ++i) {
        const Collider& collider = *scene.bodies[size_t(body[i])].collider;
        const int group = groups.of(scene, body[i], piece_of(collider, list[i]));
        out.boxes.push_back(bounds_of(scene, body[i], corners_of(collider, list[i]), group));
    }
}

static double cell_size_of(const OverlapScene& scene, const HashSettings& settings) {
    constexpr double CHOSEN = 1.5, LEAST = 0.125;  // mean edges
    double sum = 0;
    for (const CollisionBody& body : scene.bodies) sum += body.collider->mean_edge;
    const double mean_edge = sum / double(scene.bodies.size());
    return settings.cell_size > 0 ? std::max(settings.cell_size, LEAST * mean_edge) : CHOSEN * mean_edge;
}

// ---- the scene ----

static bool takes_part(const CollisionBody& body, int tet) {
    return body.pieces[size_t(body.collider->tet_piece[size_t(tet)])] != 0;
}

static void fill_tets(OverlapScene& s, const std::vector<CollisionBody>& bodies) {
    s.bodies = bodies;
    for (auto* list :
         {&s.first_node, &s.node, &s.node_body, &s.tet, &s.tet_body, &s.face, &s.face_body, &s.edge, &s.edge_body})
        list->clear();
    s.places.clear();
    for (size_t b = 0; b < bodies.size(); ++b) {
        const Collider& collider = *bodies[b].collider;
        s.first_node.push_back(int(s.places.size()));
        if (bodies[b].pieces.empty()) continue;
        s.places.insert(s.places.end(), bodies[b].places, bodies[b].places + collider.node_count);
        for (size_t t = 0; t < collider.tets.size(); ++t)
            if (takes_part(bodies[b], int(t))) s.tet.push_back(int(t));
        s.tet_body.resize(s.tet.size(), int(b));
    }
}

// Marks the tets of one body, those from first on, whose boxes overlap one of a region that is not near their own: as
// cells are wider than regions, nearly all of a plant would share one with such a region.
static void keep_parts_that_meet(OverlapSearch& search, size_t first, size_t last, std::vector<uint8_t>& kept) {
    const OverlapScene& s = search.scene;
    std::vector<BoxSet::Bounds>& boxes = search.queries.boxes;
    const Collider& collider = *s.bodies[size_t(s.tet_body[first])].collider;
    struct Part {
        int piece;
        BoxSet::Bounds whole;
        std::vector<size_t> tets;
    };
    std::vector<Part> parts;
    std::vector<int> part_of(size_t(collider.piece_count), -1);
    for (size_t i = first; i < last; ++i) {
        const int piece = collider.tet_piece[size_t(s.tet[i])];
        int& part = part_of[size_t(piece)];
        if (part < 0) {
            part = int(parts.size());
            parts.push_back({piece, boxes[i], {}});
        }
        Part& own = parts[size_t(part)];
        for (int k = 0; k < 3; ++k) {
            own.whole.lower[k] = std::min(own.whole.lower[k], boxes[i].lower[k]);
            own.whole.upper[k] = std::max(own.whole.upper[k], boxes[i].upper[k]);
        }
        own.tets.push_back(i);
    }
    for (size_t a = 0; a < parts.size(); ++a)
        for (size_t b = 0; b < a; ++b) {
            if (!boxes_meet(parts[a].whole, parts[b].whole) || collider.are_near(parts[a].piece, parts[b].piece))
                continue;
            for (const size_t i : parts[a].tets) {
                if (!boxes_meet(boxes[i], parts[b].whole)) continue;
                for (const size_t j : parts[b].tets)
                    if (boxes_meet(boxes[i], boxes[j])) kept[i] = kept[j] = 1;
            }
        }
}

// Drops tets that are near nothing, with their boxes.
static void cull_tets(OverlapSearch& search, const HashRow& row, double cell_size) {
    if (!row.cull) return;
    OverlapScene& s = search.scene;
    std::vector<uint8_t>& kept = search.marks;
    row.cull(search.queries, s.tet_body, cell_size, search.hash, kept);
    for (size_t first = 0, last; first < s.tet.size(); first = last) {
        for (last = first; last < s.tet.size() && s.tet_body[last] == s.tet_body[first];) ++last;
        if (s.bodies[size_t(s.tet_body[first])].with_itself) keep_parts_that_meet(search, first, last, kept);
    }
    size_t count = 0;
    for (size_t i = 0; i < s.tet.size(); ++i) {
        if (!kept[i]) continue;
        s.tet[count] = s.tet[i];
        s.tet_body[count] = s.tet_body[i];
        search.queries.boxes[count++] = search.queries.boxes[i];
    }
    s.tet.resize(count);
    s.tet_body.resize(count);
    search.queries.boxes.resize(count);
}

// Fills in nodes of the tets that are left, their faces on the boundary and the edges of these.
static void fill_boundary(OverlapSearch& search) {
    OverlapScene& s = search.scene;
    std::vector<uint8_t>& marks = search.marks;
    size_t first = 0;
    for (size_t b = 0; b < s.bodies.size(); ++b) {
        const Collider& collider = *s.bodies[b].collider;
        size_t last = first;
        while (last < s.tet.size() && s.tet_body[last] == int(b)) ++last;
        if (first == last) continue;
        marks.assign(size_t(collider.node_count), 0);
        for (size_t i = first; i < last; ++i)
            for (const int n : collider.tets[size_t(s.tet[i])]) marks[size_t(n)] = 1;
        for (int n = 0; n < collider.node_count; ++n)
            if (marks[size_t(n)]) s.node.push_back(n);
        marks.assign(collider.edges.size(), 0);
        for (; first < last; ++first)
            for (const int f : collider.tet_faces[s.tet[first]]) {
                s.face.push_back(f);
                for (const int e : collider.face_edges[size_t(f)]) marks[size_t(e)] = 1;
            }
        for (size_t e = 0; e < collider.edges.size(); ++e)
            if (marks[e]) s.edge.push_back(int(e));
        s.node_body.resize(s.node.size(), int(b));
        s.face_body.resize(s.face.size(), int(b));
        s.edge_body.resize(s.edge.size(), int(b));
    }
}

static void find_pairs(OverlapSearch& search, const HashSettings& settings) {
    const Timer timer;
    search.pairs.clear();
    hash_row(settings.layout)
        .find(search.items, search.queries, settings.table_size, cell_size_of(search.scene, settings), search.hash,
              search.pairs);
    search.ms_hash += timer.ms();
}

// Returns whether a node lies in or near a region of its body.
static bool is_near(const Collider& collider, int node, int piece) {
    for (const int own : collider.node_pieces[node])
        if (collider.are_near(own, piece)) return true;
    return false;
}

// ---- exact tests ----

static double six_volumes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return (b - a).cross(c - a).dot(d - a);
}

// Returns whether p is in a tet. A node on a face between two tets is in both, whatever the rounding.
static bool is_in_tet(const OverlapScene& scene, int body, const Tet& tet, const Vec3& p,
                      std::array<double, 4>& weights) {
    constexpr double ROUNDING = 1e-12;  // of weights [-]
    const Vec3 &a = scene.place(body, tet[0]), &b = scene.place(body, tet[1]), &c = scene.place(body, tet[2]),
               &d = scene.place(body, tet[3]);
    const double whole = six_volumes(a, b, c, d);
    weights[1] = six_volumes(a, p, c, d) / whole;
    weights[2] = six_volumes(a, b, p, d) / whole;
    weights[3] = six_volumes(a, b, c, p) / whole;
    weights[0] = 1 - weights[1] - weights[2] - weights[3];
    // False for flat tets too, whose weights are not finite.
    return weights[0] >= -ROUNDING && weights[1] >= -ROUNDING && weights[2] >= -ROUNDING && weights[3] >= -ROUNDING;
}

// Returns on which side of a line p q a directed edge from a to b passes: equal but for the sign for both faces at the
// edge, so that no line slips through between them.
static double side_of(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, bool ascending) {
    return ascending ? six_volumes(p, q, a, b) : -six_volumes(p, q, b, a);
}

static bool goes_through(const OverlapScene& scene, EdgeOverlap& overlap) {
    const int edge_body = scene.edge_body[size_t(overlap.edge)], face_body = scene.face_body[size_t(overlap.face)];
    const auto& edge = scene.bodies[size_t(edge_body)].collider->edges[size_t(scene.edge[size_t(overlap.edge)])];
    const Triangle& face = scene.bodies[size_t(face_body)].collider->faces[size_t(scene.face[size_t(overlap.face)])];
    const Vec3 &p = scene.place(edge_body, edge[0]), &q = scene.place(edge_body, edge[1]);
    const std::array<const Vec3*, 3> corner = {&scene.place(face_body, face[0]), &scene.place(face_body, face[1]),
                                               &scene.place(face_body, face[2])};
    const double before = six_volumes(*corner[0], *corner[1], *corner[2], p);
    const double after = six_volumes(*corner[0], *corner[1], *corner[2], q);
    if ((before > 0) == (after > 0)) return false;
    double sum = 0;
    std::array<double, 3> side;
    for (size_t k = 0; k < 3; ++k) {
        // The edge opposite to corner k.
        const size_t from = (k + 1) % 3, to = (k + 2) % 3;
        sum += side[k] = side_of(p, q, *corner[from], *corner[to], face[from] < face[to]);
    }
    const bool left = side[0] >= 0 && side[1] >= 0 && side[2] >= 0;
    const bool right = side[0] <= 0 && side[1] <= 0 && side[2] <= 0;
    if (!(left || right) || sum == 0) return false;
    overlap.along = before / (before - after);
    for (size_t k = 0; k < 3; ++k) overlap.weights[k] = side[k] / sum;
    return true;
}

// ---- the search ----

// The boxes of the tets are in search.queries already.
static void find_nodes_in_tets(OverlapSearch& search, const Groups& groups, const HashSettings& settings) {
    const OverlapScene& s = search.scene;
    fill_boxes(
        s, groups, s.node, s.node_body, search.items, [](const Collider&, int n) { return std::array<int, 1>{n}; },
        [](const Collider& c, int n) { return *c.node_pieces[n].begin(); });
    find_pairs(search, settings);
    search.nodes.clear();
    for (const auto& [node, tet] : search.pairs) {
        NodeOverlap overlap = {node, tet, {}};
        const int node_body = s.node_body[size_t(node)], tet_body = s.tet_body[size_t(tet)];
        const Collider& collider = *s.bodies[size_t(tet_body)].collider;
        const int t = s.tet[size_t(tet)], n = s.node[size_t(node)];
        if (node_body == tet_body && is_near(collider, n, collider.tet_piece[size_t(t)])) continue;
        if (is_in_tet(s, tet_body, collider.tets[size_t(t)], s.place(node_body, n), overlap.weights))
            search.nodes.push_back(overlap);
    }
    const auto key = [&s](const NodeOverlap& o) { return std::tuple(s.tet_body[size_t(o.tet)], o.node, o.tet); };
    std::sort(search.nodes.begin(), search.nodes.end(),
              [&](const NodeOverlap& a, const NodeOverlap& b) { return key(a) < key(b); });
    search.nodes.erase(std::unique(search.nodes.begin(), search.nodes.end(),
                                   [&](const NodeOverlap& a, const NodeOverlap& b) { return key(a) == key(b); }),
                       search.nodes.end());
}

static void find_edges_through_faces(OverlapSearch& search, const Groups& groups, const HashSettings& settings) {
    const OverlapScene& s = search.scene;
    fill_boxes(
        s, groups, s.edge, s.edge_body, search.items, [](const Collider& c, int e) { return c.edges[size_t(e)]; },
        [](const Collider& c, int e) { return *c.node_pieces[c.edges[size_t(e)][0]].begin(); });
    fill_boxes(
        s, groups, s.face, s.face_body, search.queries, [](const Collider& c, int f) { return c.faces[size_t(f)]; },
        [](const Collider& c, int f) { return c.tet_piece[size_t(c.face_tet[size_t(f)])]; });
    find_pairs(search, settings);
    search.edges.clear();
    for (const auto& [edge, face] : search.pairs) {
        EdgeOverlap overlap = {edge, face, 0, {}};
        const int edge_body = s.edge_body[size_t(edge)], face_body = s.face_body[size_t(face)];
        if (edge_body == face_body) {
            const Collider& collider = *s.bodies[size_t(edge_body)].collider;
            const int piece = collider.tet_piece[size_t(collider.face_tet[size_t(s.face[size_t(face)])])];
            const auto& ends = collider.edges[size_t(s.edge[size_t(edge)])];
            if (is_near(collider, ends[0], piece) || is_near(collider, ends[1], piece)) continue;
        }
        if (goes_through(s, overlap)) search.edges.push_back(overlap);
    }
    const auto key = [&s](const EdgeOverlap& o) {
        return std::tuple(s.face_body[size_t(o.face)], o.edge, o.along, o.face);
    };
    std::sort(search.edges.begin(), search.edges.end(),
              [&](const EdgeOverlap& a, const EdgeOverlap& b) { return key(a) < key(b); });
    search.edges.erase(std::unique(search.edges.begin(), search.edges.end(),
                                   [&](const EdgeOverlap& a, const EdgeOverlap& b) { return key(a) == key(b); }),
                       search.edges.end());
}

void find_overlaps(OverlapSearch& search, const std::vector<CollisionBody>& bodies, const HashSettings& settings) {
    search.nodes.clear();
    search.edges.clear();
    search.ms_hash = 0;
    OverlapScene& s = search.scene;
    const Timer timer;
    fill_tets(s, bodies);
    if (s.tet.empty()) return;
    const Groups groups(s);
    fill_boxes(
        s, groups, s.tet, s.tet_body, search.queries, [](const Collider& c, int t) { return c.tets[size_t(t)]; },
        [](const Collider& c, int t) { return c.tet_piece[size_t(t)]; });
    cull_tets(search, hash_row(settings.layout), cell_size_of(s, settings));
    fill_boundary(search);
    search.ms_hash += timer.ms();
    find_nodes_in_tets(search, groups, settings);
    find_edges_through_faces(search, groups, settings);
}

}  // namespace frond
