// Finds tets of a cage that are held in place, and do not swing on a hinge or float.
#pragma once

#include "cage/cage.hpp"

namespace frond {

// Returns for each tet whether it belongs to a component, joined by whole faces, that is fixed by three held nodes not
// on one line; its nodes hold other components in turn.
std::vector<char> find_firm_tets(const Cage& cage, const std::vector<uint8_t>& held);
// Returns for each node whether it is held: nodes of the root, and of parts that swing on an edge or a corner of the
// cage, which no stiffness could hold upright.
std::vector<uint8_t> find_held_nodes(const Cage& cage, const std::vector<uint8_t>& root);

}  // namespace frond
