// In: a plant as it is and the air of its world. Out: drags on its chain nodes, which take half of each piece beside them.
//
// The resistance is that of the air's speed past the plant at the start of the step; the velocity that it is multiplied
// with is the one at the end, so that still air takes energy at any time step, and what stands in a wind feels exactly its force.
#include "mechanics/rod_piece.hpp"
#include "plant/air_resistance.hpp"
#include "plant/plant.hpp"

namespace frond {

namespace {

// A chain node as a point of the mechanics, in a grip that may have been another one.
void take_hold(const Plant& plant, size_t node, Grip& grip) {
    if (!plant.follow) {
        grip = chain_grip(plant, int(node));
        return;
    }
    grip.count = 1;
    grip.turns = false;
    grip.node[0] = int(2 * node);
    grip.weight[0] = 1;
}

// Where the wide sides of pieces in a cage lie now.
void look_at_cage(const Plant& plant, AirState& air) {
    for (size_t i = 0; i < air.wide.size(); i++) {
        const AirPiece& piece = (*air.pieces)[i];
        air.wide[i] = wide_now(plant, piece.node, piece.wide, piece.spread);
    }
}

// Adds up what pieces do at their ends, a half at either, several pieces of a shape at once.
struct GatherPieces {
    const Plant& plant;
    AirState& air;
    double density, h;

    template <class S>
    struct Group {
        const AirPiece* piece[LANES<S>];
        int number[LANES<S>], count;
    };
    // From the i-th piece on; past the last one of its shape that is taken again.
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
    // Of a piece of the chain, turned as one of its ends is.
    template <class S>
    FROND_INLINE Lanes3<S> turned(const Group<S>& group, const Lanes3<S>& v, int AirPiece::*end) const {
        const double* x = plant.motion.x.data();
        const Lanes3<S> turn = {gather<S>([&](int l) { return x[6 * (group.piece[l]->*end) + 3]; }),
                                gather<S>([&](int l) { return x[6 * (group.piece[l]->*end) + 4]; }),
                                gather<S>([&](int l) { return x[6 * (group.piece[l]->*end) + 5]; })};
        const RodEnd<S> at = rod_end(Lanes3<S>{}, turn);
        return rotation_of(at.w, at.p) * v;
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
    // Axis, thin, wide as rows; nothing where the piece has lost its shape.
    template <class S>
    FROND_INLINE Lanes33<S> frame_of(const Group<S>& group) const {
        constexpr double LEAST = 1e-9;  // [m], [-]
        const Lanes3<S> chord = vector(group, plant.chain_positions, &AirPiece::node) -
                                vector(group, plant.chain_positions, &AirPiece::parent);
        const S length = sqrt(dot(chord, chord));
        const auto is_long = length > LEAST;
        const Lanes3<S> axis = (1.0 / select(is_long, length, constant<S>(1))) * chord;
        const Lanes3<S> wide = wide_of(group), across = wide - dot(axis, wide) * axis;
        const S size = sqrt(dot(across, across));
        const auto is_wide = size > LEAST;
        const S over = select(is_wide, S(1.0 / select(is_wide, size, constant<S>(1))), S{});
        const Lanes3<S> along = select(is_long, over * size, S{}) * axis, beside = select(is_long, over, S{}) * across;
        return {{along, cross(beside, along), beside}};
    }
    template <class S>
    FROND_INLINE void add_at(const Group<S>& group, const AirLanes<S>& piece, const Lanes33<S>& frame,
                             int AirPiece::*end) const {
        const Lanes3<S> passing = vector(group, air.passing, end);
        const Lanes3<S> d = air_resistance(piece, group.piece[0]->shape, frame * passing, density);
        const Lanes33<S> by = scaled_rows(constant<S>(0.5) * d, frame), half = transposed_times(frame, by);
        const S six[6] = {half.r[0].x, half.r[0].y, half.r[0].z, half.r[1].y, half.r[1].z, half.r[2].z};
        // Pressure is along the normal of the step's start. What a wind could carry past itself within a step is held back
        // from turning by more than that allows: of no effect on what rests, and of first order in the step [-].
        constexpr double MANY = 2;
        const Lanes3<S> wind = passing + vector(group, air.velocities, end);
        const S lag = MANY * h * sqrt(dot(wind, wind)) / piece.chord_along;
        for (int lane = 0; lane < group.count; lane++) {
            SixOf& resistance = air.resistance[size_t(group.piece[lane]->*end)];
            SixOf& held_back = air.lag[size_t(group.piece[lane]->*end)];
            for (size_t k = 0; k < 6; k++) {
                resistance[k] += six[k][lane];
                held_back[k] += lag[lane] * six[k][lane];
            }
        }
    }
    template <class S>
    FROND_INLINE void run() const {
        for (size_t i = 0; i < air.pieces->size();) {
            const Group<S> group = group_at<S>(i);
            const AirLanes<S> piece([&](int lane) -> const AirPiece& { return *group.piece[lane]; });
            const Lanes33<S> frame = frame_of(group);
            add_at(group, piece, frame, &AirPiece::parent);
            add_at(group, piece, frame, &AirPiece::node);
            i += size_t(group.count);
        }
    }
};

// The air at the chain nodes, and how it passes them.
void look_at_air(Plant& plant, const Surroundings& surroundings, frond_effects effects) {
    AirState& air = *plant.air;
    const size_t count = plant.chain_positions.size();
    const Mat3 to_world = plant.rotation.toRotationMatrix();
    air.points.resize(count);
    air.wind.assign(count, frond_vec3{0, 0, 0});
    air.velocities.assign(count, Vec3::Zero());
    air.passing.resize(count);
    if (effects & FROND_WIND) {
        for (size_t i = 0; i < count; i++) {
            const Vec3 p = to_world * plant.chain_positions[i] + plant.position;
            air.points[i] = {p.x(), p.y(), p.z()};
        }
        if (!wind_velocities(*surroundings.wind, up_of(surroundings.gravity), surroundings.time, air.points, air.wind))
            plant.trouble |= FROND_TROUBLE_BAD_WIND;
    }
    for (size_t i = 0; i < count; i++) {
        if (effects & FROND_AIR_DRAG)
            air.velocities[i] = plant.follow ? Vec3(point(plant.motion.v, int(2 * i)))
                                             : grip_velocity(chain_grip(plant, int(i)), plant.motion.x, plant.motion.v);
        air.passing[i] = to_world.transpose() * Vec3(air.wind[i].x, air.wind[i].y, air.wind[i].z) - air.velocities[i];
    }
}

}  // namespace

void gather_air(Plant& plant, const Surroundings& surroundings, frond_effects effects, double h) {
    std::vector<Drag>& drags = plant.loads.drags;
    if (!surroundings.wind || !(effects & (FROND_WIND | FROND_AIR_DRAG))) return drags.clear();
    if (!plant.air) {
        plant.air = std::make_unique<AirState>();
        plant.air->pieces = air_pieces_of(plant);
    }
    AirState& air = *plant.air;
    look_at_air(plant, surroundings, effects);

    air.resistance.assign(air.points.size(), SixOf{});
    air.lag.assign(air.points.size(), SixOf{});
    air.wide.resize(plant.follow ? 0 : air.pieces->size());
    if (!plant.follow) look_at_cage(plant, air);
    run_in_lanes(GatherPieces{plant, air, surroundings.wind->def.density, h});

    // Drags of the step before are written over, since most of what they have room for is not used.
    drags.resize(air.resistance.size());
    size_t count = 0;
    for (size_t i = 0; i < air.resistance.size(); i++) {
        if (air.resistance[i] == SixOf{}) continue;
        Drag& drag = drags[count++];
        const Mat3 resistance = matrix_of(air.resistance[i]);
        take_hold(plant, i, drag.grip);
        drag.force = resistance * (air.passing[i] + air.velocities[i]);
        drag.damping.setZero();
        if (effects & FROND_AIR_DRAG) drag.damping = resistance + matrix_of(air.lag[i]);
    }
    drags.resize(count);
}

Vec3 air_force(const Plant& plant) {
    Vec3 sum = Vec3::Zero();
    for (const Drag& drag : plant.loads.drags)
        sum += drag.force - drag.damping * grip_velocity(drag.grip, plant.motion.x, plant.motion.v);
    return plant.rotation * sum;
}

}  // namespace frond
