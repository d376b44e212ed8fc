// Finds a plant's weight, as its tets and its chain carry it.
#pragma once

#include "model/model.hpp"

namespace frond {

// Returns the chain node on which each tet's weight hangs: of its organ's nodes the median one of the vertices in it,
// else the nearest; of all nodes if its organ has none.
std::vector<int> hang_tets(const Model& model);

// Sums of the tets on each chain node.
struct Weights {
    std::vector<double> mass;  // [kg]
    std::vector<Vec3> moment;  // mass times position [kg m]
};
Weights weigh(const Model& model, const std::vector<int>& hangs);

// Returns the mass that each chain node carries of the tets [kg]: a tet's mass is on the two ends of the capsule beside
// its centre, of its organ's, so that its centre along the capsule is right. For the caller's own tets, which may be
// longer than capsules. Those of a lattice hold tissue anywhere; their vertices tell where (hang_tets).
std::vector<double> spread_over_capsules(const Model& model);

// Sets tet_density from the materials and how full the tets are, chain_mass and organ_mass. Where the sections are
// known exactly (stems) organs weigh what these say.
void give_mass(Model& model);

// Returns the mass of each organ with all that it bears, from their own masses and the organs that they grow out of; a
// loop of organs bears only itself.
std::vector<double> borne_masses(const std::vector<double>& own, const std::vector<int>& parents);

}  // namespace frond
