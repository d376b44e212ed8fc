// In: a plant's motion and the air of its world. Out: drags on its chain nodes, half of each adjoining segment at each.
//
// The resistance is taken at the air's speed past the plant at the start of the step; the velocity that it multiplies
// is the one at the end, so that still air takes energy at any time step, and a plant at rest in a wind feels exactly
// the wind's force.
#include "core/product.hpp"
#include "plant/air_push.hpp"
#include "plant/plant_step.hpp"

namespace frond {

namespace {

// Sets an attachment, which may hold another one, to a chain node as a point of the mechanics.
void take_hold(const Plant& plant, size_t node, Attachment& attachment) {
    if (!plant.follow) {
        attachment = chain_attachment(plant, int(node));
        return;
    }
    attachment.count = 1;
    attachment.turns = false;
    attachment.node[0] = int(2 * node);
    attachment.weight[0] = 1;
}

// Finds the present directions of the wide sides of segments in a cage.
void look_at_cage(const Plant& plant, AirState& air) {
    for (size_t i = 0; i < air.wide.size(); i++) {
        const AirPiece& piece = (*air.pieces)[i];
        air.wide[i] = wide_now(plant, piece.node, piece.wide, piece.spread);
    }
}

// Adds up the air's push on segments, half of it at either end, several segments of one shape at once.
struct GatherPieces {
    const Plant& plant;
    AirState& air;
    double density, h;

    template <class S>
    struct Group {
        const AirPiece* piece[LANES<S>];
        int number[LANES<S>], count;
    };
    // What came off is carried by a body, and feels no air here.
    bool is_gone(int node) const {
        const std::vector<int>& of_chain = plant.state.parting->of_chain;
        return !of_chain.empty() && of_chain[size_t(node)] >= 0;
    }
    // Groups segments of one shape from the i-th on; lanes beyond the last one repeat it.
    template <class S>
    FROND_INLINE Group<S> group_at(size_t i) const {
        Group<S> group;
        group.count = 0;
        for (int lane = 0; lane < LANES<S>; lane++) {
            const bool goes_on = size_t(group.count) + i < air.pieces->size() &&
                                 (*air.pieces)[i + size_t(group.count)].shape == (*air.pieces)[i].shape;
            if (goes_on) group.count++;
            group.number[lane] = int(i) + group.count - 1;
            group.piece[lane] = &(*air.pieces)[size_t(group.number[lane])];
        }
        return group;
    }
    template <class S>
    FROND_INLINE static Lanes3<S> vector(const Group<S>& group, const std::vector<Vec3>& of, int AirPiece::*at) {
        return {gather<S>([&](int l) { return of[size_t(group.piece[l]->*at)][0]; }),
                gather<S>([&](int l) { return of[size_t(group.piece[l]->*at)][1]; }),
                gather<S>([&](int l) { return of[size_t(group.piece[l]->*at)][2]; })};
    }
    // Turns a vector of a segment with one of its end nodes.
    template <class S>
    FROND_INLINE Lanes3<S> turned(const Group<S>& group, const Lanes3<S>& v, int AirPiece::*end) const {
        const double* x = plant.state.motion.x.data();
        const Lanes3<S> turn = {gather<S>([&](int l) { return x[6 * (group.piece[l]->*end) + 3]; }),
                                gather<S>([&](int l) { return x[6 * (group.piece[l]->*end) + 4]; }),
                                gather<S>([&](int l) { return x[6 * (group.piece[l]->*end) + 5]; })};
        return turned_by(turn, v);
    }
    template <class S>
    FROND_INLINE Lanes3<S> wide_of(const Group<S>& group) const {
        const auto wide = [&](int l) -> const Vec3& {
            return plant.follow ? group.piece[l]->wide : air.wide[size_t(group.number[l])];
        };
        const Lanes3<S> v = {gather<S>([&](int l) { return wide(l)[0]; }), gather<S>([&](int l) { return wide(l)[1]; }),
                             gather<S>([&](int l) { return wide(l)[2]; })};
        return plant.follow ? turned(group, v, &AirPiece::parent) + turned(group, v, &AirPiece::node) : v;
    }
    template <class S>
    FROND_INLINE Lanes33<S> frame_of(const Group<S>& group) const {
        return air_frame(vector(group, plant.view.chain_positions, &AirPiece::node) -
                             vector(group, plant.view.chain_positions, &AirPiece::parent),
                         wide_of(group));
    }
    template <class S>
    FROND_INLINE AirPush<S> push_at(const Group<S>& group, const AirLanes<S>& piece, const Lanes33<S>& frame,
                                    int AirPiece::*end) const {
        return air_push(piece, group.piece[0]->shape, frame, vector(group, air.passing, end),
                        vector(group, air.velocities, end), density, h);
    }
    template <class S>
    FROND_INLINE void add(const AirPush<S>& push, int lane, int node) const {
        for (size_t k = 0; k < 6; k++) {
            air.resistance[size_t(node)][k] += push.resistance[k][lane];
            air.lag[size_t(node)][k] += push.lag[lane] * push.resistance[k][lane];
        }
    }
    template <class S>
    FROND_INLINE void run() const {
        for (size_t i = 0; i < air.pieces->size();) {
            const Group<S> group = group_at<S>(i);
            const AirLanes<S> piece([&](int lane) -> const AirPiece& { return *group.piece[lane]; });
            const Lanes33<S> frame = frame_of(group);
            const AirPush<S> at_parent = push_at(group, piece, frame, &AirPiece::parent),
                             at_node = push_at(group, piece, frame, &AirPiece::node);
            // Segment by segment: where three meet, another order would round differently.
            for (int lane = 0; lane < group.count; lane++) {
                if (is_gone(group.piece[lane]->node)) continue;
                add(at_parent, lane, group.piece[lane]->parent);
                add(at_node, lane, group.piece[lane]->node);
            }
            i += size_t(group.count);
        }
    }
};

// Finds the air's velocity at the chain nodes and relative to them.
void look_at_air(Plant& plant, const Surroundings& surroundings, frond_effects effects) {
    AirState& air = *plant.state.air;
    const size_t count = plant.view.chain_positions.size();
    const Mat3 to_world = plant.rotation.toRotationMatrix(), to_model = to_world.transpose();
    air.points.resize(count);
    air.wind.assign(count, frond_vec3{0, 0, 0});
    air.velocities.assign(count, Vec3::Zero());
    air.passing.resize(count);
    if (effects & FROND_EFFECT_WIND) {
        for (size_t i = 0; i < count; i++) {
            const Vec3 p = product(to_world, plant.view.chain_positions[i]) + plant.position;
            air.points[i] = {p.x(), p.y(), p.z()};
        }
        if (!wind_velocities(*surroundings.wind, up_of(surroundings.gravity), surroundings.time, air.points, air.wind))
            plant.trouble |= FROND_TROUBLE_BAD_WIND;
    }
    for (size_t i = 0; i < count; i++) {
        if (effects & FROND_EFFECT_AIR_DRAG)
            air.velocities[i] = plant.follow ? Vec3(point(plant.state.motion.v, int(2 * i)))
                                             : attachment_velocity(chain_attachment(plant, int(i)),
                                                                   plant.state.motion.x, plant.state.motion.v);
        air.passing[i] = product(to_model, Vec3(air.wind[i].x, air.wind[i].y, air.wind[i].z)) - air.velocities[i];
    }
}

}  // namespace

void gather_air(Plant& plant, const Surroundings& surroundings, frond_effects effects, double h) {
    std::vector<Drag>& drags = plant.step.loads->drags;
    plant.state.blown.setZero();
    if (!surroundings.wind || !(effects & (FROND_EFFECT_WIND | FROND_EFFECT_AIR_DRAG))) return drags.clear();
    if (!plant.state.air) {
        plant.state.air = std::make_unique<AirState>();
        plant.state.air->pieces = air_pieces_of(plant);
    }
    AirState& air = *plant.state.air;
    look_at_air(plant, surroundings, effects);

    air.resistance.assign(air.points.size(), SixOf{});
    air.lag.assign(air.points.size(), SixOf{});
    air.wide.resize(plant.follow ? 0 : air.pieces->size());
    if (!plant.follow) look_at_cage(plant, air);
    run_in_lanes(GatherPieces{plant, air, surroundings.wind->def.density, h});

    // Drags of the step before are overwritten in place, since most of an attachment's memory is unused.
    drags.resize(air.resistance.size());
    size_t count = 0;
    for (size_t i = 0; i < air.resistance.size(); i++) {
        if (air.resistance[i] == SixOf{}) continue;
        Drag& drag = drags[count++];
        const Mat3 resistance = matrix_of(air.resistance[i]);
        take_hold(plant, i, drag.attachment);
        drag.force = product(resistance, air.passing[i] + air.velocities[i]);
        drag.damping.setZero();
        if (effects & FROND_EFFECT_AIR_DRAG) drag.damping = resistance + matrix_of(air.lag[i]);
    }
    drags.resize(count);
}

Vec3 air_force(const Plant& plant) {
    Vec3 sum = plant.state.blown;
    for (const Drag& drag : plant.step.loads->drags)
        sum += drag.force -
               product(drag.damping, attachment_velocity(drag.attachment, plant.state.motion.x, plant.state.motion.v));
    return plant.rotation * sum;
}

}  // namespace frond
