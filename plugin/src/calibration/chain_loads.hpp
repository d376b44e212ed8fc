// Loads of a plant's weight on the capsules of its chain. A tree is statically determinate: forces and moments follow
// from the masses alone, summed from the tips to the root.
#pragma once

#include "model/model.hpp"

namespace frond {

// Indexed by the chain node at the capsule's end; roots have no capsule.
struct ChainLoads {
    std::vector<Vec3> force;   // force on the capsule's end [N]
    std::vector<Vec3> moment;  // moment at its section's elastic centre [N m]
};
// Computes the loads of the plant's weight along a coordinate axis, 0..2.
ChainLoads weigh_chain(const Model& model, int axis);

}  // namespace frond
