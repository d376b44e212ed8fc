// Gives leaves the ribs that their files do not show.
#pragma once

#include "model/model.hpp"

namespace frond {

// Turns of an organ under its own weight applied sideways.
struct Turns {
    std::vector<double> moment;  // largest moment at each chain node's capsule, over three directions [N m]
    std::vector<double> organ;   // how far each organ turns from its base to its tip, by linear theory [rad]
};
Turns find_turns(const Model& model);

// Thickens the ribs of leaves and petals that could not carry themselves: to what turns them by no more than `turn`
// [rad], but to no more than a rib can be. Changes sections only.
void grow_hidden_ribs(Model& model, double turn);

}  // namespace frond
