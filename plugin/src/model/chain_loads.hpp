// The effect of weight on the capsules of a chain. A tree is statically determinate: forces and moments follow from the
// masses alone, summed from the tips to the root.
#pragma once

#include "model/model.hpp"

namespace frond {

// By the chain node at the capsule's end; of roots nothing.
struct ChainLoads {
    std::vector<Vec3> force;   // on the end [N]
    std::vector<Vec3> moment;  // in the middle [N m]
};
// Of the plant's weight, taken along an axis of the room.
ChainLoads weigh_chain(const Model& model, int axis);

}  // namespace frond
