// LoneOrgan: the tets of one organ as a body of their own, held where the organ grows out of another one or the ground,
// and the masses that it bears. What calibration bends.
#pragma once

#include <map>

#include "model/model.hpp"

namespace frond {

struct LoneOrgan {
    int organ;
    Model model;                  // cage, root and material constants of tets
    std::vector<size_t> tets;     // of the plant's cage, those that are left
    std::map<int, double> borne;  // own node -> mass of what grows out of it there [kg]
    double firm_share;            // of the organ's volume: what was left, because it does not swing on a hinge [-]

    // Tells whether there is enough of it to be bent.
    bool is_sound() const;
};

// One an organ of the plant, in their order; organs without tets have none either.
std::vector<LoneOrgan> take_organs(const Model& plant);

}  // namespace frond
