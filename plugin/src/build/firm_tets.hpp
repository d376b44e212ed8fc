// Which tets of a cage are held in place, and do not swing on a hinge or float.
#pragma once

#include "model/cage.hpp"

namespace frond {

// One a tet: whether it belongs to a piece, joined by whole faces, that three held nodes off one line fix; the nodes of
// such a piece hold others in turn.
std::vector<char> find_firm_tets(const Cage& cage, const std::vector<uint8_t>& held);
// One a node: those of the root, and those of bits that swing on an edge or a corner of the cage, which no stiffness
// could hold upright.
std::vector<uint8_t> find_held_nodes(const Cage& cage, const std::vector<uint8_t>& root);

}  // namespace frond
