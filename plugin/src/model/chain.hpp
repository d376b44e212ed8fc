// Chain: the skeleton of a plant, a tree (or several, one a root) of nodes; a node and its parent are the ends of a capsule.
#pragma once

#include "model/organ.hpp"

namespace frond {

struct ChainNode {
    Vec3 position;
    double radius;    // of the capsule [m]
    int parent;       // smaller than its own index; -1 at a root
    int organ;
    double distance;  // along the plant from the root [m]
};

struct Chain {
    std::vector<ChainNode> nodes;
    std::vector<int> vertex_node;  // surface vertex -> nearest chain node along the surface
    int root_count() const;
    int fork_count() const;   // nodes with more than one child
    double length() const;    // of all capsules [m]
};

struct ChainOptions {
    double height = 0;  // length of a capsule [m]; 0 chooses
    double radius = 0;  // [m]; 0 fits the shape
};

// Connected components of bands of geodesic distance from the root become nodes, so that forks and leaves come out as
// branches (Verroust, Lazarus 2000: level sets of geodesic distance). Always a forest without cycles that covers every vertex.
Chain make_chain(const Surface& surface, const Topology& topology, const ChainOptions& options);

}  // namespace frond
