// Finds a plant's weight, as its tets and its chain carry it.
#pragma once

#include "model/model.hpp"

namespace frond {

// Returns the chain node on which each tet's weight hangs: of its organ's nodes the median one of the vertices in it,
// else the nearest; of all nodes if its organ has none.
std::vector<int> hang_tets(const Model& model);

// What a capsule weighs, shared between its ends so that its centre is right [kg].
struct CapsuleMass {
    double at_begin = 0, at_end = 0;
};
// Returns one per chain node, at the capsule's end: sheets by the surface that is bound to them, other organs by their
// sections, as heavy as organ_mass says and with their tissue's centre as far as capsules pass it; sections that are
// known exactly (stems) weigh what they say. An organ without capsules hangs on others.
std::vector<CapsuleMass> weigh_capsules(const Model& model);

// Returns the mass that each chain node carries of the tets [kg]: a tet's mass is on the two ends of the capsule beside
// its centre, of its organ's, so that its centre along the capsule is right. For the caller's own tets, which may be
// longer than capsules.
std::vector<double> spread_over_capsules(const Model& model);

// Sets organ_mass, and tet_density and chain_mass, which both carry it. Organs weigh what their tissue does, or their
// sections where these are known exactly (stems).
void give_mass(Model& model);

}  // namespace frond
