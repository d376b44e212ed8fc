// Contacts of nodes: nodes of one body within tets of another come in, contacts with depth and normal go out
// (Heidelberger et al. 2004). At the border, where an edge leads from a node inside to one outside, both come from the
// places where such edges enter and the faces' normals there; deeper nodes take them over from their neighbours.
#include <algorithm>

#include "collide/penetration.hpp"
#include "surface/triangle_distance.hpp"

namespace frond {

Vec3 face_normal(const OverlapScene& scene, int body, int face) {
    const Triangle& f = scene.bodies[size_t(body)].collider->faces[size_t(face)];
    const Vec3& a = scene.place(body, f[0]);
    return (scene.place(body, f[1]) - a).cross(scene.place(body, f[2]) - a).normalized();
}

ContactSide side_of_nodes(const Collider& collider, int body, const int* nodes, const double* weights, int count,
                          int tet) {
    ContactSide side = {body, collider.tet_organ[size_t(tet)], collider.tet_piece[size_t(tet)], count, {}, {}};
    std::copy(nodes, nodes + count, side.nodes.begin());
    std::copy(weights, weights + count, side.weights.begin());
    return side;
}

// Sums over the places where the edges of a node at the border enter, weighted by the inverse of the squared distance.
struct Entry {
    double weight = 0, depth = 0;
    Vec3 normal = Vec3::Zero();
};

static std::vector<Entry> find_entries(const OverlapSearch& search, const BodyPair& pair, const NodeMarks& inside) {
    const OverlapScene& scene = search.scene;
    const Collider& collider = *scene.bodies[size_t(pair.a)].collider;
    std::vector<Entry> entries(pair.nodes.size());
    for (size_t k = 0; k < pair.edges.size();) {
        // All places where an edge passes through faces.
        size_t end = k;
        const int edge = search.edges[size_t(pair.edges[k])].edge;
        while (end < pair.edges.size() && search.edges[size_t(pair.edges[end])].edge == edge) ++end;
        const size_t first = k, last = end - 1;
        k = end;

        const auto& ends = collider.edges[size_t(scene.edge[size_t(edge)])];
        const int base = scene.first_node[size_t(pair.a)];
        const bool begin_in = inside[size_t(base + ends[0])] >= 0, end_in = inside[size_t(base + ends[1])] >= 0;
        if (begin_in == end_in) continue;
        // Seen from outside it enters at the first.
        const EdgeOverlap& overlap = search.edges[size_t(pair.edges[begin_in ? last : first])];
        const Vec3 &p = scene.place(pair.a, ends[0]), &q = scene.place(pair.a, ends[1]);
        const Vec3 place = p + overlap.along * (q - p);
        const Vec3 normal = face_normal(scene, pair.b, scene.face[size_t(overlap.face)]);
        if (!normal.allFinite()) continue;
        const Vec3 from_node = place - (begin_in ? p : q);
        Entry& entry = entries[size_t(inside[size_t(base + ends[begin_in ? 0 : 1])])];
        const double weight = 1 / std::max(from_node.squaredNorm(), 1e-300);
        entry.weight += weight;
        entry.depth += weight * from_node.dot(normal);
        entry.normal += weight * normal;
    }
    return entries;
}

// Finds the nearest exit on the boundary of the regions that take part, for nodes that no edge connects with the
// outside.
static void leave_nearest(const OverlapScene& scene, int body, WayOut& way) {
    const Collider& collider = *scene.bodies[size_t(body)].collider;
    const std::vector<uint8_t>& pieces = scene.bodies[size_t(body)].pieces;
    double least = INFINITY;
    for (size_t k = 0; k < collider.faces.size(); ++k) {
        if (!pieces[size_t(collider.tet_piece[size_t(collider.face_tet[k])])]) continue;
        const Triangle& f = collider.faces[k];
        const Vec3 nearest =
            nearest_in_triangle({scene.place(body, f[0]), scene.place(body, f[1]), scene.place(body, f[2])}, way.point);
        const double away = (nearest - way.point).norm();
        if (away >= least) continue;
        const Vec3 normal = face_normal(scene, body, int(k));
        if (!normal.allFinite()) continue;
        least = away;
        way.normal = away > 0 ? Vec3((nearest - way.point) / away) : normal;
        way.depth = away;
        way.known = true;
    }
}

// Takes the nearest exit where it is much shorter. A node with few others inside, such as a leaf's tip, need not agree
// with many, and edges along a blade would make it leave lengthwise; for other nodes the exit has to be shorter still.
static void leave_shortly(const OverlapScene& scene, int body, size_t neighbours, WayOut& way) {
    constexpr double SHORTER = 0.25, FAR_SHORTER = 0.125;  // over the exit that is agreed on [-]
    constexpr size_t FEW = 2;                              // others inside
    if (scene.bodies[size_t(body)].is_slim) return;
    WayOut nearest;
    nearest.point = way.point;
    leave_nearest(scene, body, nearest);
    if (nearest.known && nearest.depth < (neighbours <= FEW ? SHORTER : FAR_SHORTER) * way.depth) way = nearest;
}

std::vector<WayOut> find_node_contacts(const OverlapSearch& search, const BodyPair& pair, const NodeMarks& inside,
                                       std::vector<CageContact>& out) {
    const OverlapScene& scene = search.scene;
    const Collider &a = *scene.bodies[size_t(pair.a)].collider, &b = *scene.bodies[size_t(pair.b)].collider;
    const int base = scene.first_node[size_t(pair.a)];

    // Exits at the border.
    const std::vector<Entry> entries = find_entries(search, pair, inside);
    std::vector<WayOut> ways(pair.nodes.size());
    std::vector<std::vector<int>> neighbours(pair.nodes.size());
    for (size_t i = 0; i < pair.nodes.size(); ++i) {
        const int node = scene.node[size_t(search.nodes[size_t(pair.nodes[i])].node)];
        const Entry& entry = entries[i];
        WayOut& way = ways[i];
        way.point = scene.place(pair.a, node);
        if (entry.weight > 0 && entry.normal.norm() > 1e-6 * entry.weight) {
            way.normal = entry.normal.normalized();
            way.depth = entry.depth / entry.weight;
            way.known = way.depth > 0;
            if (!way.known) way = WayOut{way.point};
        }
        for (const int other : a.neighbours[node])
            if (inside[size_t(base + other)] >= 0) neighbours[i].push_back(inside[size_t(base + other)]);
    }
    spread_ways_out(ways, neighbours);

    for (size_t i = 0; i < pair.nodes.size(); ++i) {
        const NodeOverlap& overlap = search.nodes[size_t(pair.nodes[i])];
        const int node = scene.node[size_t(overlap.node)], tet = scene.tet[size_t(overlap.tet)];
        WayOut& way = ways[i];
        if (way.known) leave_shortly(scene, pair.b, neighbours[i].size(), way);
        if (!way.known || !(way.depth > 0)) leave_nearest(scene, pair.b, way);
        if (!way.known || !(way.depth > 0)) continue;
        const double whole = 1;
        out.push_back({CONTACT_NODE_IN_TET, side_of_nodes(a, pair.a, &node, &whole, 1, a.node_tet[size_t(node)]),
                       side_of_nodes(b, pair.b, b.tets[size_t(tet)].data(), overlap.weights.data(), 4, tet), way.point,
                       way.normal, way.depth});
    }
    return ways;
}

}  // namespace frond
