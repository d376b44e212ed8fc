// Fill-reducing elimination order of the nodes of a matrix of 3x3 blocks.
#pragma once

#include "mechanics/block_matrix.hpp"

namespace frond {

// Finds it by approximate minimum degree (Amestoy, Davis, Duff 1996) on the graph of nodes, so that a node's three rows
// stay together.
std::vector<int> elimination_order(const BlockPattern& pattern);

}  // namespace frond
