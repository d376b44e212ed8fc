// Chain tree: which slab of a band grows out of which.
#pragma once

#include "skeleton/bands.hpp"

namespace frond {

// Group of slabs that are not part of the plant: stakes, trellises, pots.
constexpr int SUPPORT_GROUP = 3;

struct Shoot {
    int parent = -1;       // slab; -1 at a root
    int link = -1;         // index into ChainTree::links; -1 at a root
    bool down = false;     // grows towards smaller distances
    bool dropped = false;  // too small for a capsule: part of its parent
    int children = 0;      // children that are not dropped
    Vec3 end;              // end of its capsule [m]
};

struct ChainTree {
    std::vector<SlabLink> links;  // links of the bands, then one per joint and one per tie
    std::vector<Shoot> shoots;    // one per slab
    std::vector<int> order;       // slabs, parents first
    std::vector<Vec3> foot;       // slab -> foot, under the middle of its root points; only at roots
};

// Makes a forest over all slabs. Each grows from the widest level link with a slab that has grown already, else from
// a side, else over a joint; the slab nearest to the root grows first. Supports grow before the plant, and a stem grows
// out of the support wherever it is tied to it, because the support carries it.
ChainTree grow_tree(const Topology& topology, const Bands& bands, const std::vector<int>& roots,
                    const std::vector<Joint>& ties);
// Returns the level links up to which a stem has grown, and from which it goes on although its slab there grows out of
// a tie to a support.
std::vector<SlabLink> links_beside_ties(const Bands& bands, const ChainTree& tree);
// Drops slabs that are no twigs: lobes and teeth within half a band, and loose parts smaller than `loose` bands.
void prune_tree(const Bands& bands, ChainTree& tree, double loose);

}  // namespace frond
