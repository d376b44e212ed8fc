// Gives leaves, fruits, twigs and peduncles the ribs, stalks and wood that their files do not show.
#pragma once

#include "model/model.hpp"

namespace frond {

// Turns of an organ under its own weight applied sideways.
struct Turns {
    std::vector<double> moment;  // largest moment at each chain node's capsule, over three directions [N m]
    std::vector<double> organ;   // how far each organ turns from its base to its tip, by linear theory [rad]
};
Turns find_turns(const Model& model);

// Puts ribs into the sections of such organs, so thick that `load` times their weight, by organ, applied sideways,
// turns them by no more than `turn` [rad], but no thicker than ribs are. Organs with a load of zero stay. Returns
// whether there was such an organ.
bool grow_hidden_ribs(Model& model, const std::vector<double>& load, double turn);

}  // namespace frond
