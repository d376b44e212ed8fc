// The chain's own state and loads: places, rotations and section forces of rods, and forces and moments on chain nodes.
#pragma once

#include "plant/plant.hpp"

namespace frond {

// Motion of a chain node, world frame; the rotation is that from the modelled shape.
struct ChainNodeState {
    Vec3 place;     // [m]
    Quat rotation;  // length one
    Vec3 velocity;  // [m/s]
    Vec3 spin;      // angular velocity [rad/s]
};
// Get and set it; only where the mechanics move the chain. Setting fails by BAD_ARGUMENT, with nothing changed, if the
// count is wrong.
std::vector<ChainNodeState> chain_state(const Plant& plant);
void set_chain_state(Plant& plant, const std::vector<ChainNodeState>& states);

// Force and moment in the middle of a capsule of what is beyond it on what is before it, world frame.
struct SectionForce {
    Vec3 axis, thin;     // directions along the capsule and across it, where it is thinnest
    Vec3 force, moment;  // [N], [N m]
};
// Returns one a capsule, zero in fragments; only where the mechanics move the chain.
std::vector<SectionForce> section_forces(const Plant& plant);

// Adds a force [N] and a moment [N m] on a chain node, world frame, until the end of the host's step.
void add_chain_load(Plant& plant, int chain_node, const Vec3& force, const Vec3& moment);
// Adds a force per length of a capsule as modelled [N/m], likewise.
void add_distributed_load(Plant& plant, size_t capsule, const Vec3& force_per_length);
// Adds all of these to the forces on the nodes of the mechanics.
void gather_chain_loads(const Plant& plant, VecX& force);

}  // namespace frond
