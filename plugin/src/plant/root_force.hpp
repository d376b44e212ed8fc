// Root force: force and moment that hold a plant.
#pragma once

#include "plant/plant.hpp"

namespace frond {

struct Wrench {
    Vec3 force = Vec3::Zero();   // [N]
    Vec3 moment = Vec3::Zero();  // [N m]
};
// Returns those of the ground on pinned nodes and pin springs, and of supports, about a point; world frame. `gravity`
// and `effects` are the world's.
Wrench root_force(const Plant& plant, const Vec3& gravity, frond_effects effects, const Vec3& about);
// Returns those of the support of a chain node, about the node.
Wrench support_force(const Plant& plant, const Vec3& gravity, frond_effects effects, int chain_node);

}  // namespace frond
