// In: forces and moments on chain nodes, and on lengths of the chain. Out: forces on the nodes of the mechanics.
//
// Where the mechanics move tets, a chain node follows the corners of one; a moment on it is a couple of forces on
// these, perpendicular to their arms from their middle and in proportion to them.
#include <Eigen/LU>

#include "mechanics/rotation.hpp"
#include "plant/chain_state.hpp"

namespace frond {

static VecX& chain_load_of(Plant& plant) {
    VecX& load = forces_of(plant).on_chain;
    if (load.size() == 0) load = VecX::Zero(6 * Eigen::Index(plant.model->chain.nodes.size()));
    return load;
}

void add_chain_load(Plant& plant, int chain_node, const Vec3& force, const Vec3& moment) {
    VecX& load = chain_load_of(plant);
    point(load, 2 * chain_node) += force;
    point(load, 2 * chain_node + 1) += moment;
    plant.input.has_user_force = true;
}

void add_distributed_load(Plant& plant, size_t capsule, const Vec3& force_per_length) {
    const auto& [begin, end] = plant.model->capsules[capsule];
    const std::vector<ChainNode>& nodes = plant.model->chain.nodes;
    const Vec3 half = 0.5 * (nodes[size_t(end)].position - nodes[size_t(begin)].position).norm() * force_per_length;
    // The moments of a beam that is held at both ends: with them it bends as under the load itself.
    const auto ends = capsule_ends(plant, capsule);
    const Vec3 moment = plant.rotation * (ends[1] - ends[0]).cross(plant.rotation.conjugate() * half) / 6;
    add_chain_load(plant, begin, half, moment);
    add_chain_load(plant, end, half, -moment);
}

// Adds a couple on the nodes that an attachment follows.
static void add_couple(const Attachment& attachment, const VecX& x, const Vec3& moment, VecX& force) {
    Vec3 middle = Vec3::Zero();
    for (int k = 0; k < attachment.count; k++) middle += point(x, attachment.node[size_t(k)]) / attachment.count;
    Mat3 spread = Mat3::Zero();
    for (int k = 0; k < attachment.count; k++) {
        const Mat3 arm = cross_matrix<double>(Vec3(point(x, attachment.node[size_t(k)]) - middle));
        spread -= arm * arm;
    }
    const Vec3 turn = spread.inverse() * moment;
    for (int k = 0; k < attachment.count; k++) {
        const int node = attachment.node[size_t(k)];
        point(force, node) += turn.cross(Vec3(point(x, node) - middle));
    }
}

void gather_chain_loads(const Plant& plant, VecX& force) {
    const Quat to_model = plant.rotation.conjugate();
    const VecX& x = plant.state.motion.x;
    const VecX& given = plant.input.forces->on_chain;
    for (int i = 0; i < given.size() / 6; i++) {
        const Vec3 push = to_model * point(given, 2 * i);
        const Vec3 moment = to_model * point(given, 2 * i + 1);
        if (push == Vec3::Zero() && moment == Vec3::Zero()) continue;
        if (plant.follow) {
            point(force, 2 * i) += push;
            point(force, 2 * i + 1) += rate_matrix<double>(Vec3(point(x, 2 * i + 1))).transpose() * moment;
        } else {
            add_attachment_force(chain_attachment(plant, i), x, push, force);
            if (moment != Vec3::Zero()) add_couple(chain_attachment(plant, i), x, moment, force);
        }
    }
}

}  // namespace frond
