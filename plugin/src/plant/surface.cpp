// In: positions of a chain or a cage. Out: the surface that it carries along, and its normals.
//
// A chain carries it by its skin. In a cage a vertex is a weighted sum of its tet's nodes. Normals turn with the
// cofactor of the deformation gradient F = E M^-1 from the modelled shape, M being a tet's edges in it and E the
// present ones. One matrix per node, the volume-weighted mean over its tets, is interpolated like the positions, so
// that shading stays smooth across tets and hard edges stay hard. Times the volume det(M) / 6 the cofactor is cof(E)
// M^T / 6; for quadratic tets it is taken at the node.
#include <algorithm>

#include "core/lane_vectors.hpp"
#include "core/timer.hpp"
#include "mechanics/rotation.hpp"
#include "plant/seen.hpp"

namespace frond {

namespace {

// A part that is drawn as one: the plant, or a fragment that came off it.
struct Drawn {
    int fragment;          // -1: the plant itself
    const Follow* follow;  // x are the chain's positions and rotations; null: the positions of the cage's nodes
    const VecX& x;
    Mat3 turn;
    Vec3 shift;
};
bool belongs(const std::vector<int>& of, size_t i, int part) {
    return (of.empty() ? -1 : of[i]) == part;
}

// A matrix, by columns.
struct Columns {
    Quad column[3];
};

// Places the nodes of the cage in the world.
struct PlaceNodes {
    const Drawn& drawn;
    std::vector<Quad>& nodes;
    template <class>
    FROND_INLINE void run() const {
        const auto lanes = [](const auto& v) FROND_INLINED { return FourLanes{v[0], v[1], v[2], 0}; };
        const FourLanes x = lanes(drawn.turn.col(0)), y = lanes(drawn.turn.col(1)), z = lanes(drawn.turn.col(2));
        const FourLanes shift = lanes(drawn.shift);
        const double* from = drawn.x.data();
        for (Quad& node : nodes) {
            store(FourLanes(shift + (x * from[0] + y * from[1] + z * from[2])), node);
            from += 3;
        }
    }
};

struct PlaceVertices {
    const Plant& plant;
    const Drawn& drawn;
    const std::vector<Quad>& nodes;
    float* positions;
    template <class>
    FROND_INLINE void run() const {
        const Embedding& embedding = plant.model->embedding;
        const std::vector<Tet>& tets = plant.model->cage.tets;
        for (size_t v = 0; v < embedding.tet.size(); v++) {
            if (!belongs(plant.state.parting->of_vertex, v, drawn.fragment)) continue;
            FourLanes sum = {};
            const auto add_node = [&](int node, double weight)
                                      FROND_INLINED { sum += weight * load(nodes[size_t(node)]); };
            if (plant.nodes->order == 1) {
                const Tet& tet = tets[size_t(embedding.tet[v])];
                for (size_t k = 0; k < 4; k++) add_node(tet[k], embedding.weights[v][k]);
            } else {
                const TetPlace place = place_in_tet(*plant.nodes, tets, embedding.tet[v], embedding.weights[v]);
                for (size_t k = 0; k < size_t(place.count); k++) add_node(place.node[k], place.weight[k]);
            }
            store_three(sum, positions + 3 * v);
        }
    }
};

// Returns cof(E) M^T of four tets, for either order of their corners. edges(lane, a) gives the present edge a,
// modelled(lane, a) the same one at rest.
template <class Edges, class Modelled>
FROND_INLINE Lanes33<FourLanes> weighted_cofactors(const Edges& edges, const Modelled& modelled) {
    Lanes33<FourLanes> E, M;  // one row per edge
    for (int a = 0; a < 3; a++) {
        FourLanes now[4], then[4];
        turn_over(edges(0, a), edges(1, a), edges(2, a), edges(3, a), now);
        turn_over(modelled(0, a), modelled(1, a), modelled(2, a), modelled(3, a), then);
        E.r[a] = {now[0], now[1], now[2]};
        M.r[a] = {then[0], then[1], then[2]};
    }
    const FourLanes volume = dot(M.r[0], cross(M.r[1], M.r[2]));
    const FourLanes sign = select(volume < 0.0, constant<FourLanes>(-1), constant<FourLanes>(1));
    return sign * transposed_times(cofactor(E), M);
}

// Adds up one matrix per node.
struct AddCofactors {
    const Plant& plant;
    const Drawn& drawn;
    const std::vector<Quad>& nodes;
    std::vector<Columns>& cofactors;

    FROND_INLINE FourLanes modelled(int node) const {
        const Vec3& p = plant.model->cage.nodes[size_t(node)];
        return FourLanes{p[0], p[1], p[2], 0};
    }
    FROND_INLINE FourLanes now(int node) const { return load(nodes[size_t(node)]); }

    // Adds the lanes' matrices to one corner of four tets each, or to the four corners of one.
    FROND_INLINE void add(const Lanes33<FourLanes>& weighted, const int (&corner)[4], int lanes) const {
        FourLanes columns[3][4];
        const FourLanes none = {};
        turn_over(weighted.r[0].x, weighted.r[1].x, weighted.r[2].x, none, columns[0]);
        turn_over(weighted.r[0].y, weighted.r[1].y, weighted.r[2].y, none, columns[1]);
        turn_over(weighted.r[0].z, weighted.r[1].z, weighted.r[2].z, none, columns[2]);
        for (int lane = 0; lane < lanes; lane++) {
            Columns& to = cofactors[size_t(corner[lane])];
            for (int c = 0; c < 3; c++) store(FourLanes(load(to.column[c]) + columns[c][lane]), to.column[c]);
        }
    }

    // Adds four tets at once; lanes beyond the last one repeat a tet and are not added.
    FROND_INLINE void add_linear(const int (&tet)[4], int count) const {
        const std::vector<Tet>& tets = plant.model->cage.tets;
        const auto edge = [&](const auto& place) FROND_INLINED {
            return [&, place](int lane, int a) FROND_INLINED {
                const Tet& corners = tets[size_t(tet[lane])];
                return FourLanes(place(corners[size_t(a) + 1]) - place(corners[0]));
            };
        };
        const Lanes33<FourLanes> weighted = weighted_cofactors(edge([&](int n) FROND_INLINED { return now(n); }),
                                                               edge([&](int n) FROND_INLINED { return modelled(n); }));
        for (size_t k = 0; k < 4; k++) {
            const auto corner = [&](int lane) { return tets[size_t(tet[lane])][k]; };
            add(weighted, {corner(0), corner(1), corner(2), corner(3)}, count);
        }
    }

    // Adds one tet at its four corners, with the edges of the linear tet that a quadratic one is equivalent to there
    // (mechanics/tet_element.hpp).
    FROND_INLINE void add_quadratic(size_t e) const {
        const QuadraticTet& tet = plant.nodes->of_tet[e];
        const auto seen = [&](int k, int from) FROND_INLINED {
            const FourLanes own = now(tet[size_t(k)]);
            if (k == from) return FourLanes(3.0 * own);
            return FourLanes(4.0 * now(tet[size_t(TET_BETWEEN[k][from])]) - own);
        };
        add(weighted_cofactors(
                [&](int lane, int a) FROND_INLINED { return FourLanes(seen(a + 1, lane) - seen(0, lane)); },
                [&](int, int a) FROND_INLINED { return FourLanes(modelled(tet[size_t(a) + 1]) - modelled(tet[0])); }),
            {tet[0], tet[1], tet[2], tet[3]}, 4);
    }

    template <class>
    FROND_INLINE void run() const {
        int group[4], count = 0;
        const size_t tets = plant.model->cage.tets.size();
        for (size_t e = 0; e < tets; e++) {
            if (!belongs(plant.state.parting->of_tet, e, drawn.fragment)) continue;
            if (plant.nodes->order == 2) {
                add_quadratic(e);
                continue;
            }
            group[count++] = int(e);
            if (count < 4) continue;
            add_linear(group, 4);
            count = 0;
        }
        if (count == 0) return;
        std::fill(group + count, group + 4, group[0]);
        add_linear(group, count);
    }
};

struct TurnNormals {
    const Plant& plant;
    const Drawn& drawn;
    const std::vector<Columns>& cofactors;
    float* normals;
    template <class>
    FROND_INLINE void run() const {
        const Model& model = *plant.model;
        for (size_t v = 0; v < model.surface.normals.size(); v++) {
            if (!belongs(plant.state.parting->of_vertex, v, drawn.fragment)) continue;
            const Tet& tet = model.cage.tets[size_t(model.embedding.tet[v])];
            const Vec3f& rest = model.surface.normals[v];
            FourLanes columns[3] = {};
            for (size_t k = 0; k < 4; k++) {
                const Columns& of = cofactors[size_t(tet[k])];
                const double weight = model.embedding.weights[v][k];
                for (int c = 0; c < 3; c++) columns[c] += weight * load(of.column[c]);
            }
            FourLanes normal =
                columns[0] * double(rest[0]) + columns[1] * double(rest[1]) + columns[2] * double(rest[2]);
            const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
            if (length > 0) {
                normal *= 1 / length;
            } else {
                const Vec3 turned = drawn.turn * rest.cast<double>();
                normal = FourLanes{turned[0], turned[1], turned[2], 0};
            }
            store_three(normal, normals + 3 * v);
        }
    }
};

// Returns the state of the mechanics' nodes `back` before the end of the last substep. A plant that is not stepped in
// each substep continues at its own velocities; one that was placed stands still.
VecX state_then(const Plant& plant, double back) {
    const Motion& motion = plant.state.motion;
    if (plant.view.lead > 0 || plant.state.modal) return motion.x + (plant.view.lead - back) * motion.v;
    if (plant.state.stepped_by == 0 || back == 0) return motion.x;
    const VecX& before = plant.step.x_good.size() > 0 ? plant.step.x_good : motion.history.x_prev;
    return motion.x - back / plant.state.stepped_by * (motion.x - (plant.follow ? wound_as(motion.x, before) : before));
}

// Returns where a fragment was `back` before, as a free body moves.
Drawn drawn_fragment(const Fragment& fragment, int number, double back) {
    const Follow* follow = fragment.follow.get();
    const VecX& x = follow ? fragment.x : fragment.cage_x;
    if (back == 0) return {number, follow, x, fragment.turn, fragment.shift};
    const Mat3 turned = rotation_of<double>(Vec3(-back * fragment.angular_velocity));
    const Vec3 centre = fragment.centre - back * fragment.velocity;
    return {number, follow, x, turned * fragment.turn, turned * (fragment.shift - fragment.centre) + centre};
}

// Writes the vertices of one part, and their normals if they are wanted.
void draw_in_cage(Plant& plant, const Drawn& drawn, float* positions, float* normals) {
    std::vector<Quad> nodes(size_t(drawn.x.size() / 3));
    run_in_lanes(PlaceNodes{drawn, nodes});
    run_in_lanes(PlaceVertices{plant, drawn, nodes, positions});
    if (!normals) return;
    const Timer timer;
    std::vector<Columns> cofactors(plant.model->cage.nodes.size(), Columns());
    run_in_lanes(AddCofactors{plant, drawn, nodes, cofactors});
    run_in_lanes(TurnNormals{plant, drawn, cofactors, normals});
    plant.ms_normals += timer.ms();
}

void draw_on_chain(Plant& plant, const Drawn& drawn, float* positions, float* normals) {
    draw_skin(drawn.follow->skin, {drawn.x, drawn.turn, drawn.shift, plant.state.parting->of_vertex, drawn.fragment,
                                   plant.model->surface.normals, positions, normals});
}

// Adds to a drawn surface what it has beside what the mechanics carry. Normals stay as they are.
void add_blend(const Plant& plant, const Look& look, const Mat3& turn, float* positions) {
    const size_t count = plant.model->surface.positions.size();
    std::vector<float> seen, own;
    if (look.own.size() > 0) {
        const auto carried = [&](const VecX& chain, std::vector<float>& to) {
            to.resize(3 * count);
            draw_skin(marks_of(plant)->follow->skin, {chain, turn, Vec3::Zero(), plant.state.parting->of_vertex, -1,
                                                      plant.model->surface.normals, to.data(), nullptr});
        };
        carried(look.chain, seen);
        carried(look.own, own);
    }
    for (size_t v = 0; v < count; v++) {
        if (!belongs(plant.state.parting->of_vertex, v, -1)) continue;
        for (size_t k = 3 * v; k < 3 * v + 3 && !seen.empty(); k++) positions[k] += seen[k] - own[k];
        if (look.left.size() > 0)
            Eigen::Map<Vec3f>(positions + 3 * v) += (turn * point(look.left, int(v))).cast<float>();
    }
}

}  // namespace

void update_surface(Plant& plant, frond_effects effects, double back) {
    const size_t vertex_count = plant.model->surface.positions.size();
    const Timer timer;
    plant.ms_normals = 0;
    plant.view.surface_positions.resize(3 * vertex_count);
    plant.view.surface_normals.resize(3 * vertex_count);
    float *positions = plant.view.surface_positions.data(),
          *normals = effects & FROND_EFFECT_NORMALS ? plant.view.surface_normals.data() : nullptr;
    const auto draw = [&](const Drawn& drawn) {
        (drawn.follow ? draw_on_chain : draw_in_cage)(plant, drawn, positions, normals);
    };
    const Mat3 turn = plant.rotation.toRotationMatrix();
    const Look look = look_of(plant, state_then(plant, back), plant.view.lead - back);
    draw({-1, plant.follow.get(), plant.follow ? look.chain : look.cage, turn, plant.position});
    if (blends(plant)) add_blend(plant, look, turn, positions);
    for (size_t i = 0; i < plant.state.fragments.size(); i++)
        draw(drawn_fragment(plant.state.fragments[i], int(i), back));
    plant.view.surface_stale = false;
    plant.view.surface_back = float(back);
    plant.ms_surface = timer.ms();
}

}  // namespace frond
