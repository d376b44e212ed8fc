// In: a plant as it is. Out: how its flat pieces lie, and how to take hold of them.
#include "mechanics/rotation.hpp"
#include "plant/flat.hpp"
#include "plant/touch.hpp"

namespace frond {

Vec3 wide_now(const Plant& plant, int node, const Vec3& modelled, const TetSpread& spread) {
    const VecX& x = plant.motion.x;
    const int ends[2] = {plant.model->chain.nodes[size_t(node)].parent, node};
    Vec3 wide = Vec3::Zero();
    for (size_t k = 0; k < 2; k++) {
        if (plant.follow) {
            wide += rotation_of<double>(point(x, 2 * ends[k] + 1)) * modelled;
            continue;
        }
        const Tet& tet = plant.model->cage.tets[size_t(plant.model->chain_embedding.tet[size_t(ends[k])])];
        for (size_t c = 0; c < 4; c++) wide += spread[k][c] * point(x, tet[c]);
    }
    return wide;
}

bool piece_frame(const Plant& plant, int node, const Vec3& wide, const TetSpread& spread, Mat3& frame) {
    constexpr double LEAST = 1e-9;  // [m], [-]
    const int parent = plant.model->chain.nodes[size_t(node)].parent;
    const Vec3 chord = plant.chain_positions[size_t(node)] - plant.chain_positions[size_t(parent)];
    if (!(chord.norm() > LEAST)) return false;
    const Vec3 axis = chord.normalized(), now = wide_now(plant, node, wide, spread);
    const Vec3 across = now - axis * axis.dot(now);
    if (!(across.norm() > LEAST)) return false;
    frame.col(0) = axis;
    frame.col(2) = across.normalized();
    frame.col(1) = frame.col(2).cross(axis);
    return true;
}

Grip flat_grip(const Plant& plant, int capsule, const Flat& flat, double along, double across) {
    Grip grip = capsule_grip(plant, capsule, along);
    if (across == 0) return grip;
    if (plant.follow) {
        grip.turns = true;
        for (size_t k = 0; k < size_t(grip.count); k++) grip.arm[k] = grip.weight[k] * across * flat.wide;
        return grip;
    }
    // Quadratic tets have too many nodes for both ends of the capsule, and for a lever.
    if (plant.nodes->order == 2) return grip;
    const auto& ends = plant.model->capsules[size_t(capsule)];
    const double share[2] = {1 - along, along};
    for (size_t k = 0; k < 2; k++) {
        const Tet& tet = plant.model->cage.tets[size_t(plant.model->chain_embedding.tet[size_t(ends[k])])];
        for (size_t c = 0; c < 4; c++)
            for (size_t n = 4 * k; n < 4 * k + 4; n++)
                if (grip.node[n] == tet[c]) grip.weight[n] += share[k] * across * flat.spread[k][c];
    }
    return grip;
}

}  // namespace frond
