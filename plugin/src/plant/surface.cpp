// What follows the cage: the surface with its normals, and the chain.
#include <algorithm>

#include "core/timer.hpp"
#include "mechanics/rotation.hpp"
#include "plant/plant.hpp"

namespace frond {

// Along the shape functions of the plant's elements, whatever they move.
static TetPlace bound_place(const Plant& plant, const Embedding& embedding, size_t i) {
    return place_in_tet(*plant.nodes, plant.model->cage.tets, embedding.tet[i], embedding.weights[i]);
}

static Vec3 bound_point(const Plant& plant, const Embedding& embedding, size_t i, const VecX& x) {
    const TetPlace place = bound_place(plant, embedding, i);
    Vec3 p = Vec3::Zero();
    for (size_t k = 0; k < size_t(place.count); k++) p += place.weight[k] * point(x, place.node[k]);
    return p;
}

static Mat3 edges_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    Mat3 edges;
    edges.col(0) = b - a;
    edges.col(1) = c - a;
    edges.col(2) = d - a;
    return edges;
}

// Edges of the linear tet as which a quadratic one is seen at its corner c (mechanics/tet_element.hpp).
static Mat3 edges_at_corner(const QuadraticTet& nodes, size_t c, const VecX& x) {
    const auto y = [&](size_t k) {
        if (k == c) return Vec3(3 * point(x, nodes[c]));
        return Vec3(4 * point(x, nodes[size_t(TET_BETWEEN[k][c])]) - point(x, nodes[k]));
    };
    return edges_of(y(0), y(1), y(2), y(3));
}

// cof(E) M^T, whichever way round the corners run.
static Mat3 weighted_cofactor(const Mat3& E, const Mat3& M) {
    Mat3 C;
    C.col(0) = E.col(1).cross(E.col(2));
    C.col(1) = E.col(2).cross(E.col(0));
    C.col(2) = E.col(0).cross(E.col(1));
    return (M.determinant() < 0 ? -1 : 1) * C * M.transpose();
}

// What is drawn as one: the plant, or a fragment that came off it.
struct Drawn {
    int fragment;  // -1: the plant itself
    const VecX& x;
    Mat3 turn;
    Vec3 shift;
};
static bool belongs(const std::vector<int>& of, size_t i, const Drawn& drawn) {
    return (of.empty() ? -1 : of[i]) == drawn.fragment;
}

// Normals turn with the cofactor of the deformation gradient F = E M^-1 from the modelled shape, M its edges and E
// those of now. One matrix a node, the volume-weighted mean over its tets, is interpolated like the positions, so that
// shading stays smooth across tets and hard edges stay hard. Times the volume det(M) / 6 the cofactor is cof(E) M^T
// / 6; of quadratic tets that at the node.
static void update_normals(Plant& plant, const Drawn& drawn) {
    const Model& model = *plant.model;
    const std::vector<Vec3>& modelled = model.cage.nodes;
    const VecX& x = drawn.x;
    std::vector<Mat3> cofactor(modelled.size(), Mat3::Zero());
    const auto modelled_edges = [&](const auto& tet) {
        return edges_of(modelled[size_t(tet[0])], modelled[size_t(tet[1])], modelled[size_t(tet[2])],
                        modelled[size_t(tet[3])]);
    };
    if (plant.nodes->order == 1) {
        for (size_t e = 0; e < model.cage.tets.size(); e++) {
            if (!belongs(plant.parting->of_tet, e, drawn)) continue;
            const Tet& tet = model.cage.tets[e];
            const Mat3 E = edges_of(point(x, tet[0]), point(x, tet[1]), point(x, tet[2]), point(x, tet[3]));
            const Mat3 weighted = weighted_cofactor(E, modelled_edges(tet));
            for (int corner : tet) cofactor[size_t(corner)] += weighted;
        }
    } else {
        for (size_t e = 0; e < model.cage.tets.size(); e++) {
            if (!belongs(plant.parting->of_tet, e, drawn)) continue;
            const QuadraticTet& tet = plant.nodes->of_tet[e];
            const Mat3 M = modelled_edges(tet);
            for (size_t c = 0; c < 4; c++) cofactor[size_t(tet[c])] += weighted_cofactor(edges_at_corner(tet, c, x), M);
        }
    }
    for (Mat3& C : cofactor) C = drawn.turn * C;

    for (size_t v = 0; v < model.surface.normals.size(); v++) {
        if (!belongs(plant.parting->of_vertex, v, drawn)) continue;
        const Tet& tet = model.cage.tets[size_t(model.embedding.tet[v])];
        const std::array<double, 4>& w = model.embedding.weights[v];
        const Vec3 rest = model.surface.normals[v].cast<double>();
        Vec3 normal = Vec3::Zero();
        for (size_t k = 0; k < 4; k++) normal += w[k] * (cofactor[size_t(tet[k])] * rest);
        const double length = normal.norm();
        normal = length > 0 ? Vec3(normal / length) : Vec3(drawn.turn * rest);
        for (int axis = 0; axis < 3; axis++) plant.surface_normals[3 * v + size_t(axis)] = float(normal[axis]);
    }
}

static VecX cage_of(const Plant& plant, const VecX& x) {
    if (!plant.follow) return x;
    VecX cage;
    follow_places(*plant.follow, x, cage);
    return cage;
}

// Of the cage nodes: the way that the last step took, over its time. What is not stepped in each substep goes on as it
// moves; what was put somewhere stands there [m/s].
static VecX way_of(const Plant& plant) {
    if (plant.lead > 0 || plant.swing) return cage_velocities(plant);
    const VecX now = cage_of(plant, plant.motion.x);
    if (plant.stepped_by == 0) return VecX::Zero(now.size());
    VecX way = (now - cage_of(plant, plant.x_good)) / plant.stepped_by;
    add_rate(plant.fade, way);
    return way;
}

// A fragment goes as a free body does.
static Drawn draw_fragment(const Fragment& fragment, int number, double back) {
    if (back == 0) return {number, fragment.cage_x, fragment.turn, fragment.shift};
    const Mat3 turned = rotation_of<double>(Vec3(-back * fragment.spin));
    const Vec3 centre = fragment.centre - back * fragment.velocity;
    return {number, fragment.cage_x, turned * fragment.turn, turned * (fragment.shift - fragment.centre) + centre};
}

void update_surface(Plant& plant, frond_effects effects, double back) {
    const Model& model = *plant.model;
    const size_t vertex_count = model.surface.positions.size();
    Timer timer;
    plant.ms_normals = 0;
    plant.surface_positions.resize(3 * vertex_count);
    plant.surface_normals.resize(3 * vertex_count);
    const VecX cage_then = back == 0 ? VecX() : VecX(cage_places(plant) - back * way_of(plant));
    const VecX& cage = back == 0 ? cage_places(plant) : cage_then;
    std::vector<Drawn> list = {{-1, cage, plant.rotation.toRotationMatrix(), plant.position}};
    for (const Fragment& fragment : plant.fragments)
        list.push_back(draw_fragment(fragment, int(list.size()) - 1, back));
    for (const Drawn& drawn : list) {
        for (size_t v = 0; v < vertex_count; v++) {
            if (!belongs(plant.parting->of_vertex, v, drawn)) continue;
            const Vec3 p = drawn.turn * bound_point(plant, model.embedding, v, drawn.x) + drawn.shift;
            for (int axis = 0; axis < 3; axis++) plant.surface_positions[3 * v + size_t(axis)] = float(p[axis]);
        }
        const Timer normals_timer;
        if (effects & FROND_NORMALS) update_normals(plant, drawn);
        plant.ms_normals += normals_timer.ms();
    }
    plant.surface_stale = false;
    plant.surface_back = float(back);
    plant.ms_surface = timer.ms();
}

Vec3 vertex_position(const Plant& plant, int vertex) {
    const Fragment* fragment = fragment_of_vertex(plant, size_t(vertex));
    const auto bound = [&](const VecX& x) { return bound_point(plant, plant.model->embedding, size_t(vertex), x); };
    return fragment ? fragment->place(bound(fragment->cage_x)) : plant.to_world(bound(cage_places(plant)));
}

int nearest_vertex(const Plant& plant, const Vec3& point) {
    int nearest = 0;
    double best = INFINITY;
    for (size_t v = 0; v < plant.model->surface.positions.size(); v++) {
        const double distance = (vertex_position(plant, int(v)) - point).squaredNorm();
        if (distance < best) {
            best = distance;
            nearest = int(v);
        }
    }
    return nearest;
}

// Of a cage. A node whose tet is gone goes with its parent.
static Vec3 chain_point(const Plant& plant, size_t i) {
    const Embedding& embedding = plant.model->chain_embedding;
    const int parent = plant.model->chain.nodes[i].parent;
    const std::vector<int>& of_tet = plant.parting->of_tet;
    const int fragment = of_tet.empty() ? -1 : of_tet[size_t(embedding.tet[i])];
    if (fragment < 0 || parent < 0) return bound_point(plant, embedding, i, plant.motion.x);
    const std::vector<Vec3>& then = plant.fragments[size_t(fragment)].chain_x;
    return plant.chain_positions[size_t(parent)] + then[i] - then[size_t(parent)];
}

void update_chain(Plant& plant) {
    const size_t count = plant.model->chain.nodes.size();
    plant.chain_positions.resize(count);
    const VecX& x = plant.motion.x;
    for (size_t i = 0; i < count; i++) {
        const Fragment* fragment = fragment_of_chain_node(plant, i);
        plant.chain_positions[i] = fragment          ? plant.to_model(fragment->place(fragment->chain_x[i]))
                                   : plant.follow ? Vec3(point(x, int(2 * i)))
                                                  : chain_point(plant, i);
    }
}

// One that came off begins where it broke.
std::array<Vec3, 2> capsule_ends(const Plant& plant, size_t capsule) {
    const auto& [begin, end] = plant.model->capsules[capsule];
    const Fragment* fragment = fragment_of_chain_node(plant, size_t(end));
    return {fragment ? plant.to_model(fragment->place(fragment->chain_x[size_t(begin)]))
                     : plant.chain_positions[size_t(begin)],
            plant.chain_positions[size_t(end)]};
}

Grip chain_grip(const Plant& plant, int node) {
    return tet_grip(bound_place(plant, plant.model->chain_embedding, size_t(node)));
}

// Of a chain: the corner of the vertex's tet that it is nearest to stands for it, and a rigid arm reaches the rest.
Grip vertex_grip(const Plant& plant, int vertex) {
    const Embedding& embedding = plant.model->embedding;
    const Tet& tet = plant.model->cage.tets[size_t(embedding.tet[size_t(vertex)])];
    const std::array<double, 4>& weights = embedding.weights[size_t(vertex)];
    if (!plant.follow) return tet_grip(bound_place(plant, embedding, size_t(vertex)));
    const size_t most = size_t(std::max_element(weights.begin(), weights.end()) - weights.begin());
    Grip grip = plant.follow->grips[size_t(tet[most])];
    Vec3 reach = -plant.model->cage.nodes[size_t(tet[most])];
    for (size_t k = 0; k < 4; k++) reach += weights[k] * plant.model->cage.nodes[size_t(tet[k])];
    for (size_t k = 0; k < size_t(grip.count); k++) grip.arm[k] += grip.weight[k] * reach;
    return grip;
}

}  // namespace frond
