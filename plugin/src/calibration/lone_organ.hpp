// LoneOrgan: the tets of one organ as a body of their own, held where the organ grows out of another one or the ground,
// and the masses that it bears. Calibration bends this body.
#pragma once

#include <map>

#include "model/model.hpp"

namespace frond {

struct LoneOrgan {
    int organ;
    Model model;                  // cage, root and material constants of tets
    std::vector<size_t> tets;     // the plant's tets that are left
    std::map<int, double> borne;  // own node -> mass of what grows out of it there [kg]
    double firm_share;            // share of the organ's volume that is left because it does not swing on a hinge [-]

    // Returns whether enough of it is left to be bent.
    bool is_sound() const;
};

// Returns one per organ of the plant, in their order; organs without tets have none here either.
std::vector<LoneOrgan> take_organs(const Model& plant);

}  // namespace frond
