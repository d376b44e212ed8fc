// The order in which the nodes of a matrix of 3x3 blocks are eliminated so that little is filled in.
#pragma once

#include "mechanics/block_matrix.hpp"

namespace frond {

// By approximate minimum degree (Amestoy, Davis, Duff 1996) on the graph of nodes, so that a node's three rows stay
// together.
std::vector<int> elimination_order(const BlockPattern& pattern);

}  // namespace frond
