// Finds a plant's weight, as its tets and its chain carry it.
#pragma once

#include "model/model.hpp"

namespace frond {

// The chain node that each tet's weight hangs on: of its organ's nodes that of most vertices in it, else the nearest;
// of all nodes where its organ has none.
std::vector<int> hang_tets(const Model& model);

// One a chain node.
struct Weights {
    std::vector<double> mass;  // [kg]
    std::vector<Vec3> moment;  // mass times position [kg m]
};
Weights weigh(const Model& model, const std::vector<int>& hangs);

// Sets tet_density from the materials and how full the tets are, and chain_mass. Where the sections are known exactly
// (stems) organs weigh what these say.
void give_mass(Model& model);

}  // namespace frond
