// In: a plant as it is and the air of its world. Out: drags on its chain nodes, which take half of each piece beside them.
//
// The resistance is that of the air's speed past the plant at the start of the step; the velocity that it is multiplied
// with is the one at the end, so that still air takes energy at any time step, and what stands in a wind feels exactly its force.
#include "plant/flat.hpp"
#include "plant/plant.hpp"

namespace frond {

namespace {

// A chain node as a point of the mechanics.
Grip chain_grip(const Plant& plant, size_t node) {
    const Embedding& embedding = plant.model->chain_embedding;
    if (!plant.follow)
        return tet_grip(place_in_tet(*plant.nodes, plant.model->cage.tets, embedding.tet[node], embedding.weights[node]));
    Grip grip;
    grip.count = 1;
    grip.node[0] = int(2 * node);
    grip.weight[0] = 1;
    return grip;
}

// Pressure is along the normal of the step's start. What a wind could carry past itself within a step is held back from
// turning by more than that allows: of no effect on what rests, and of first order in the step [-].
double lag_of(const AirPiece& piece, const Vec3& wind, double h) {
    constexpr double MANY = 2;
    return MANY * wind.norm() * h / piece.chord_along;
}

// The air at the chain nodes, and how it passes them.
void look_at_air(Plant& plant, const Surroundings& surroundings, frond_effects effects) {
    AirState& air = *plant.air;
    const size_t count = plant.chain_positions.size();
    const Quat to_model = plant.rotation.conjugate();
    air.points.resize(count);
    air.wind.assign(count, frond_vec3{0, 0, 0});
    air.velocities.assign(count, Vec3::Zero());
    air.passing.resize(count);
    if (effects & FROND_WIND) {
        for (size_t i = 0; i < count; i++) {
            const Vec3 p = plant.to_world(plant.chain_positions[i]);
            air.points[i] = {p.x(), p.y(), p.z()};
        }
        if (!wind_velocities(*surroundings.wind, up_of(surroundings.gravity), surroundings.time, air.points, air.wind))
            plant.trouble |= FROND_TROUBLE_BAD_WIND;
    }
    for (size_t i = 0; i < count; i++) {
        if (effects & FROND_AIR_DRAG)
            air.velocities[i] = grip_velocity(chain_grip(plant, i), plant.motion.x, plant.motion.v);
        air.passing[i] = to_model * Vec3(air.wind[i].x, air.wind[i].y, air.wind[i].z) - air.velocities[i];
    }
}

}  // namespace

void gather_air(Plant& plant, const Surroundings& surroundings, frond_effects effects, double h) {
    std::vector<Drag>& drags = plant.loads.drags;
    drags.clear();
    if (!surroundings.wind || !(effects & (FROND_WIND | FROND_AIR_DRAG))) return;
    if (!plant.air) plant.air = std::make_unique<AirState>(AirState{air_pieces_of(plant), {}, {}, {}, {}, {}, {}});
    AirState& air = *plant.air;
    look_at_air(plant, surroundings, effects);

    // Each piece gives a half to either end.
    air.resistance.assign(air.points.size(), Mat3::Zero());
    air.lag.assign(air.points.size(), Mat3::Zero());
    for (const AirPiece& piece : *air.pieces) {
        const int parent = plant.model->chain.nodes[size_t(piece.node)].parent;
        Mat3 frame;
        if (!piece_frame(plant, piece.node, piece.wide, piece.spread, frame)) continue;
        for (size_t end : {size_t(parent), size_t(piece.node)}) {
            const Mat3 half = 0.5 * air_resistance(piece, frame, air.passing[end], surroundings.wind->def.density);
            air.resistance[end] += half;
            air.lag[end] += lag_of(piece, air.passing[end] + air.velocities[end], h) * half;
        }
    }

    for (size_t i = 0; i < air.resistance.size(); i++) {
        const Mat3& resistance = air.resistance[i];
        if (resistance.isZero(0)) continue;
        const Vec3 wind = air.passing[i] + air.velocities[i];
        drags.push_back({chain_grip(plant, i), resistance * wind,
                         effects & FROND_AIR_DRAG ? Mat3(resistance + air.lag[i]) : Mat3(Mat3::Zero())});
    }
}

Vec3 air_force(const Plant& plant) {
    Vec3 sum = Vec3::Zero();
    for (const Drag& drag : plant.loads.drags)
        sum += drag.force - drag.damping * grip_velocity(drag.grip, plant.motion.x, plant.motion.v);
    return plant.rotation * sum;
}

}  // namespace frond
