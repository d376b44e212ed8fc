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

// Puts ribs into the sections of leaves and petals that are stiffer than their materials so that they stand, `stiffer`
// by organ: so thick that their weight, applied sideways, turns them by no more than `turn` [rad], but no thicker than
// ribs are. Returns whether there was such an organ.
bool grow_hidden_ribs(Model& model, const std::vector<double>& stiffer, double turn);

}  // namespace frond
