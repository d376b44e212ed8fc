// Chain: the skeleton of a plant, a tree (or several, one a root) of nodes; a node and its parent are the ends of a
// capsule.
#pragma once

#include "model/organ.hpp"

namespace frond {

struct ChainNode {
    Vec3 position;
    double radius;         // of the capsule [m]
    int parent;            // smaller than its own index; -1 at a root
    int organ;             // that most of its capsule belongs to; -1 if the surface's parts have none
    double distance;       // along the chain from the root [m]
    double fitted_radius;  // what the shape has, whatever radius was given [m]
};

struct Chain {
    std::vector<ChainNode> nodes;
    std::vector<int> vertex_node;  // surface vertex -> nearest chain node along the surface
    double height = 0;             // of a capsule, as given or chosen [m]
    int root_count() const;
    int fork_count() const;  // nodes with more than one child
    double length() const;   // of all capsules [m]
};

struct ChainOptions {
    double height = 0;  // length of a capsule [m]; 0 chooses
    double radius = 0;  // [m]; 0 fits the shape
};

// Connected components of bands of geodesic distance from the root become nodes, so that forks and leaves come out as
// branches (Verroust, Lazarus 2000: level sets of geodesic distance). Always a forest without cycles that covers every
// vertex. Where a leaf grows out of a stem, kinds of organs tell them apart; without organs only the surface's pieces
// do. A fitted radius is the root of the mean squared distance of the capsule's own surface from its axis: the radius
// of a tube, 0.29 of the width of a blade.
Chain make_chain(const Surface& surface, const Topology& topology, const std::vector<Organ>& organs,
                 const ChainOptions& options);
Chain make_chain(const Surface& surface, const Topology& topology, const ChainOptions& options);

// Where the chain begins: points at the foot of what stands on the ground (stems, branches, roots, pots and stakes if
// the organs tell them, so that a drooping leaf is no root), sorted, and how high each is above its lowest neighbour
// [m].
struct RootPoints {
    std::vector<int> points;
    std::vector<double> heights;
};
RootPoints find_root_points(const Surface& surface, const Topology& topology, const std::vector<Organ>& organs);

}  // namespace frond
