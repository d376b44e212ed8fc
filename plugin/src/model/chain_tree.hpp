// Chain tree: which piece of a band grows out of which.
#pragma once

#include "model/bands.hpp"

namespace frond {

// The group of the pieces that are no plant: stakes, trellises, pots.
constexpr int SUPPORT_GROUP = 3;

struct Shoot {
    int parent = -1;       // piece; -1 at a root
    int contact = -1;      // index into ChainTree::contacts; -1 at a root
    bool down = false;     // grows towards smaller distances
    bool dropped = false;  // too small to be a capsule: part of its parent
    int children = 0;      // that are not dropped
    Vec3 end;              // where its capsule ends [m]
};

struct ChainTree {
    std::vector<Contact> contacts;  // those of the bands, then one a joint
    std::vector<Shoot> shoots;      // one a piece
    std::vector<int> order;         // pieces, parents first
    std::vector<Vec3> foot;         // piece -> middle of its root points; only at roots
};

// A forest over all pieces. Each grows from the widest level contact with what is there already, else from a side, else
// over a joint; what is nearest to the root grows first. Supports grow before the plant, and a stem grows out of the
// support wherever it is tied to it: that is what carries it.
ChainTree grow_tree(const Topology& topology, const Bands& bands, const std::vector<int>& roots);
// Drops twigs that are no twigs: lobes and teeth within half a band, loose parts smaller than `loose` bands.
void prune_tree(const Bands& bands, ChainTree& tree, double loose);

}  // namespace frond
