// Binds the surface's vertices to the chain that its slabs became.
#pragma once

#include "skeleton/chain.hpp"
#include "skeleton/chain_tree.hpp"

namespace frond {

// What the chain's nodes have to do with slabs.
struct SlabNodes {
    std::vector<int> node;   // slab -> node at the end of its capsule
    std::vector<char> owns;  // whether that was made for the slab, else the slab joined the capsule that ends there
    int last_resort = -1;    // node at the end of the only capsule of a chain that had only feet
};

// Sets vertex_node, vertex_capsule and vertex_along of a chain whose nodes are in place.
void bind_vertices(const Surface& surface, const Topology& topology, const Bands& bands, const ChainTree& tree,
                   const SlabNodes& slabs, Chain& chain);

}  // namespace frond
