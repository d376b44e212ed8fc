// Contacts of edges: edges of one body that pass through faces of another come in, contacts with depth and normal go
// out. An edge without an end inside leaves across a boundary edge of the other body near the faces it passes through,
// if both edges are outermost along their common perpendicular (the Gauss-map test of edge pairs in separating-axis
// tests: Gregorius 2013, "The Separating Axis Test between Convex Polyhedra"). Edges deeper inside take the exit over
// from their neighbours, as nodes do. An edge that hangs on a node inside leaves as that does. A ridge of the other
// body may be above an edge along its exit, beyond the depth of its end or of its first exit: then the edge has to pass
// the ridge too.
#include <algorithm>
#include <map>

#include "collide/penetration.hpp"
#include "core/lists.hpp"

namespace frond {

// A stretch of an edge of a that is inside b.
struct Chord {
    int edge;
    int first = -1, last = -1;  // overlaps where it goes in and comes out; -1: the edge's end is inside there
    int other_edge = -1;        // edge of b across which it leaves
    double along = 0, other_along = 0;
    bool hangs() const { return first < 0 || last < 0; }
};

static Vec3 edge_place(const OverlapScene& scene, int body, int edge, double along) {
    const auto& ends = scene.bodies[size_t(body)].collider->edges[size_t(edge)];
    return scene.place(body, ends[0]) + along * (scene.place(body, ends[1]) - scene.place(body, ends[0]));
}

// Returns whether the edge goes into b at an overlap, seen from its first node.
static bool goes_in(const OverlapSearch& search, const BodyPair& pair, int edge, int overlap) {
    const OverlapScene& scene = search.scene;
    const Vec3 along = edge_place(scene, pair.a, edge, 1) - edge_place(scene, pair.a, edge, 0);
    return face_normal(scene, pair.b, scene.face[size_t(search.edges[size_t(overlap)].face)]).dot(along) < 0;
}

// Cuts an edge at the overlaps from first to last. Where copies of cells overlap it may go in twice before it comes
// out.
static void cut_edge(const OverlapSearch& search, const BodyPair& pair, int edge, const int* first, const int* last,
                     bool begins_inside, std::vector<Chord>& chords) {
    int level = 0, least = 0;
    for (const int* k = first; k != last; ++k)
        least = std::min(least, level += goes_in(search, pair, edge, *k) ? 1 : -1);
    level = begins_inside ? std::max(1, -least) : -least;
    Chord chord = {edge};
    if (!begins_inside && level > 0) chord.first = *first;  // only by rounding
    for (const int* k = first; k != last; ++k) {
        const int before = level;
        level += goes_in(search, pair, edge, *k) ? 1 : -1;
        if (before == 0) chord.first = *k;
        if (level > 0) continue;
        chord.last = *k;
        chords.push_back(chord);
        chord = {edge};
    }
    if (level > 0) chords.push_back(chord);
}

static std::vector<Chord> find_chords(const OverlapSearch& search, const BodyPair& pair, const NodeMarks& inside) {
    const OverlapScene& scene = search.scene;
    const Collider& a = *scene.bodies[size_t(pair.a)].collider;
    const int base = scene.first_node[size_t(pair.a)];
    std::vector<Chord> chords;
    for (size_t k = 0; k < pair.edges.size();) {
        const size_t first = k;
        const int edge = search.edges[size_t(pair.edges[k])].edge;
        while (k < pair.edges.size() && search.edges[size_t(pair.edges[k])].edge == edge) ++k;
        const int number = scene.edge[size_t(edge)];
        const bool begins_inside = inside[size_t(base + a.edges[size_t(number)][0])] >= 0;
        cut_edge(search, pair, number, pair.edges.data() + first, pair.edges.data() + k, begins_inside, chords);
    }
    return chords;
}

// Gathers the boundary edges of the faces that a chord passes through, and of the faces adjacent to those.
static void gather_edges(const Collider& b, const OverlapScene& scene, const OverlapSearch& search, const Chord& chord,
                         std::vector<int>& out) {
    out.clear();
    for (const int overlap : {chord.first, chord.last}) {
        if (overlap < 0) continue;
        for (const int edge : b.face_edges[size_t(scene.face[size_t(search.edges[size_t(overlap)].face)])])
            for (const int face : b.edge_faces[size_t(edge)])
                out.insert(out.end(), b.face_edges[size_t(face)].begin(), b.face_edges[size_t(face)].end());
    }
    sort_unique(out);
}

// Computes the normals of the two faces at an edge; false unless they form a ridge.
static bool make_ridge(const OverlapScene& scene, int body, int edge, Vec3& n, Vec3& m) {
    constexpr double FLAT = 1e-4;  // square of a sine below which two faces are one plane, 0.6 degrees [-]
    const Collider& collider = *scene.bodies[size_t(body)].collider;
    const auto [f, g] = collider.edge_faces[size_t(edge)];
    n = face_normal(scene, body, f);
    m = face_normal(scene, body, g);
    const double cosine = n.dot(m);
    if (!(1 - cosine * cosine > FLAT)) return false;
    // The far corner of the one face is below the other.
    const auto& ends = collider.edges[size_t(edge)];
    const Triangle& other = collider.faces[size_t(g)];
    int far_corner = other[0];
    for (const int corner : other)
        if (corner != ends[0] && corner != ends[1]) far_corner = corner;
    return n.dot(scene.place(body, far_corner) - scene.place(body, ends[0])) < 0;
}

// Returns whether a direction across an edge points between the normals of its two faces, which form a ridge.
static bool is_outward(const OverlapScene& scene, int body, int edge, const Vec3& direction) {
    constexpr double ROUNDING =
        0.01;  // share of the span between the normals by which a direction may lie beside it [-]
    Vec3 n, m;
    if (!make_ridge(scene, body, edge, n, m)) return false;
    const double cosine = n.dot(m), sine_squared = 1 - cosine * cosine;
    const double along_n = direction.dot(n), along_m = direction.dot(m);
    return along_n - cosine * along_m >= -ROUNDING * sine_squared &&
           along_m - cosine * along_n >= -ROUNDING * sine_squared;
}

// Finds the edge of b across which the chord leaves by the shortest distance.
static WayOut leave_across(const OverlapScene& scene, const BodyPair& pair, const std::vector<int>& candidates,
                           Chord& chord) {
    WayOut best;
    const Vec3 p = edge_place(scene, pair.a, chord.edge, 0), d = edge_place(scene, pair.a, chord.edge, 1) - p;
    for (const int edge : candidates) {
        const Vec3 q = edge_place(scene, pair.b, edge, 0), e = edge_place(scene, pair.b, edge, 1) - q;
        const Vec3 across = d.cross(e);
        const double squared = across.squaredNorm();
        if (!(squared > 1e-6 * d.squaredNorm() * e.squaredNorm())) continue;
        // Parameters of the lines' nearest points.
        const double along = (q - p).cross(e).dot(across) / squared;
        const double other_along = (q - p).cross(d).dot(across) / squared;
        if (along < 0 || along > 1 || other_along < 0 || other_along > 1) continue;
        Vec3 normal = across / std::sqrt(squared);
        double depth = normal.dot(q - p);
        if (depth < 0) {
            normal = -normal;
            depth = -depth;
        }
        if (!(depth > 0) || (best.known && depth >= best.depth) || !is_outward(scene, pair.b, edge, normal)) continue;
        best = {p + along * d, normal, depth, true};
        chord.other_edge = edge;
        chord.along = along;
        chord.other_along = other_along;
    }
    return best;
}

// Finds the ridge that is highest above the chord along its exit direction, if that is higher than `depth`.
static bool find_ridge_above(const OverlapSearch& search, const BodyPair& pair, const std::vector<int>& candidates,
                             const WayOut& way, Chord& chord, double& depth) {
    constexpr double PARALLEL = 0.02, FACES = 0.2, BEYOND = 0.5;  // the last over the chord's length
    const OverlapScene& scene = search.scene;
    const Vec3 p = edge_place(scene, pair.a, chord.edge, 0), d = edge_place(scene, pair.a, chord.edge, 1) - p;
    double begin = chord.first < 0 ? 0 : search.edges[size_t(chord.first)].along;
    double end = chord.last < 0 ? 1 : search.edges[size_t(chord.last)].along;
    const double beyond = BEYOND * (end - begin);
    begin = std::max(0.0, begin - beyond);
    end = std::min(1.0, end + beyond);
    bool found = false;
    for (const int edge : candidates) {
        const Vec3 q = edge_place(scene, pair.b, edge, 0), e = edge_place(scene, pair.b, edge, 1) - q;
        const double squared = d.cross(e).dot(way.normal);
        if (!(std::abs(squared) > PARALLEL * d.norm() * e.norm())) continue;
        // Parameters of their crossing, seen along the exit direction.
        const double along = (q - p).cross(e).dot(way.normal) / squared;
        const double other_along = (q - p).cross(d).dot(way.normal) / squared;
        if (along < begin || along > end || other_along < 0 || other_along > 1) continue;
        const double height = way.normal.dot(q + other_along * e - p - along * d);
        Vec3 n, m;
        if (!(height > depth) || !make_ridge(scene, pair.b, edge, n, m)) continue;
        if (std::max(n.dot(way.normal), m.dot(way.normal)) < FACES) continue;
        depth = height;
        chord.other_edge = edge;
        chord.along = along;
        chord.other_along = other_along;
        found = true;
    }
    return found;
}

// Chooses an exit where no neighbour has one: above the ridge of the two planes that the chord passes through, else
// against a's own outside by half of the length inside.
static void leave_anyhow(const OverlapSearch& search, const BodyPair& pair, const Chord& chord, WayOut& way) {
    const OverlapScene& scene = search.scene;
    const EdgeOverlap &first = search.edges[size_t(chord.first)], &last = search.edges[size_t(chord.last)];
    const Vec3 n = face_normal(scene, pair.b, scene.face[size_t(first.face)]);
    const Vec3 m = face_normal(scene, pair.b, scene.face[size_t(last.face)]);
    const Vec3 inside =
        edge_place(scene, pair.a, chord.edge, last.along) - edge_place(scene, pair.a, chord.edge, first.along);
    // Depths of its ends below the plane of the other end: an edge that hardly dips in may be inside for long.
    const double first_below = m.dot(inside), last_below = -n.dot(inside);
    Vec3 normal = n + m;
    if (normal.norm() > 0.2 && first_below > 0 && last_below > 0) {
        way.depth = first_below * last_below / (first_below + last_below) / n.dot(normal.normalized());
    } else {
        const auto& faces = scene.bodies[size_t(pair.a)].collider->edge_faces[size_t(chord.edge)];
        normal = -face_normal(scene, pair.a, faces[0]) - face_normal(scene, pair.a, faces[1]);
        way.depth = 0.5 * inside.norm();
    }
    if (!(normal.norm() > 1e-6)) return;
    way.normal = normal.normalized();
    way.known = true;
}

// Finds, among the first `count` chords, those of different edges that share a node.
static std::vector<std::vector<int>> find_neighbours(const Collider& a, const std::vector<Chord>& chords,
                                                     size_t count) {
    std::map<int, std::vector<int>> at_node;
    for (size_t i = 0; i < count; ++i)
        for (const int end : a.edges[size_t(chords[i].edge)]) at_node[end].push_back(int(i));
    std::vector<std::vector<int>> neighbours(count);
    for (const auto& [node, list] : at_node)
        for (const int i : list)
            for (const int j : list)
                if (chords[size_t(i)].edge != chords[size_t(j)].edge) neighbours[size_t(i)].push_back(j);
    return neighbours;
}

static CageContact contact_of(const OverlapSearch& search, const BodyPair& pair, const Chord& chord,
                              const WayOut& way) {
    const OverlapScene& scene = search.scene;
    const Collider &a = *scene.bodies[size_t(pair.a)].collider, &b = *scene.bodies[size_t(pair.b)].collider;
    const int a_tet = a.face_tet[size_t(a.edge_faces[size_t(chord.edge)][0])];
    const bool across = chord.other_edge >= 0;
    const EdgeOverlap& overlap = search.edges[size_t(chord.first >= 0 ? chord.first : chord.last)];
    const double along = across ? chord.along : overlap.along;
    const std::array<double, 2> weights = {1 - along, along};
    CageContact contact;
    contact.kind = across ? CONTACT_EDGE_ON_EDGE : CONTACT_EDGE_IN_FACE;
    contact.a = side_of_nodes(a, pair.a, a.edges[size_t(chord.edge)].data(), weights.data(), 2, a_tet);
    if (across) {
        const std::array<double, 2> other = {1 - chord.other_along, chord.other_along};
        const int tet = b.face_tet[size_t(b.edge_faces[size_t(chord.other_edge)][0])];
        contact.b = side_of_nodes(b, pair.b, b.edges[size_t(chord.other_edge)].data(), other.data(), 2, tet);
    } else {
        const int face = scene.face[size_t(overlap.face)];
        contact.b =
            side_of_nodes(b, pair.b, b.faces[size_t(face)].data(), overlap.weights.data(), 3, b.face_tet[size_t(face)]);
    }
    contact.point = edge_place(scene, pair.a, chord.edge, along);
    contact.normal = way.normal;
    contact.depth = way.depth;
    return contact;
}

// Returns the exit of a hanging edge: that of the deeper one of its ends inside.
static WayOut way_of_end(const Collider& a, const NodeMarks& inside, int base, const std::vector<WayOut>& node_ways,
                         const Chord& chord) {
    WayOut way;
    for (size_t k = 0; k < 2; ++k) {
        const int node = inside[size_t(base + a.edges[size_t(chord.edge)][k])];
        if ((k == 0 ? chord.first : chord.last) >= 0 || node < 0) continue;
        const WayOut& end = node_ways[size_t(node)];
        if (end.known && (!way.known || end.depth > way.depth)) way = end;
    }
    return way;
}

void find_edge_contacts(const OverlapSearch& search, const BodyPair& pair, const NodeMarks& inside,
                        const std::vector<WayOut>& node_ways, std::vector<CageContact>& out) {
    const OverlapScene& scene = search.scene;
    const Collider &a = *scene.bodies[size_t(pair.a)].collider, &b = *scene.bodies[size_t(pair.b)].collider;
    std::vector<Chord> chords = find_chords(search, pair, inside);
    const auto first_hanging =
        std::stable_partition(chords.begin(), chords.end(), [](const Chord& c) { return !c.hangs(); });
    const size_t through = size_t(first_hanging - chords.begin());
    std::vector<WayOut> ways(through);
    std::vector<int> candidates;
    for (size_t i = 0; i < through; ++i) {
        gather_edges(b, scene, search, chords[i], candidates);
        ways[i] = leave_across(scene, pair, candidates, chords[i]);
        if (ways[i].known) continue;
        const double first = search.edges[size_t(chords[i].first)].along;
        const double last = search.edges[size_t(chords[i].last)].along;
        ways[i].point = edge_place(scene, pair.a, chords[i].edge, 0.5 * (first + last));
    }
    spread_ways_out(ways, find_neighbours(a, chords, through));
    for (size_t i = 0; i < through; ++i) {
        if (!ways[i].known || !(ways[i].depth > 0)) leave_anyhow(search, pair, chords[i], ways[i]);
        if (ways[i].known && ways[i].depth > 0) out.push_back(contact_of(search, pair, chords[i], ways[i]));
    }

    // Ridges that are higher above an edge than its exit so far is deep, unless it has a shorter exit of its own.
    for (size_t i = 0; i < chords.size(); ++i) {
        Chord &chord = chords[i], alone = chord;
        WayOut way = i < through ? ways[i] : way_of_end(a, inside, scene.first_node[size_t(pair.a)], node_ways, chord);
        if (!way.known || !(way.depth > 0)) continue;
        gather_edges(b, scene, search, chord, candidates);
        if (!find_ridge_above(search, pair, candidates, way, chord, way.depth)) continue;
        const WayOut shorter = i < through ? WayOut() : leave_across(scene, pair, candidates, alone);
        if (shorter.known && shorter.depth < way.depth)
            out.push_back(contact_of(search, pair, alone, shorter));
        else
            out.push_back(contact_of(search, pair, chord, way));
    }
}

}  // namespace frond
