// Chain: the skeleton of a plant, a tree (or several, one per root) of nodes; a node and its parent are the ends of a
// capsule.
#pragma once

#include "skeleton/organ.hpp"

namespace frond {

struct ChainNode {
    Vec3 position;
    double radius;         // radius of the capsule [m]
    int parent;            // smaller than its own index; -1 at a root
    int organ;             // organ of most of its capsule; -1 if the surface's parts have none
    double distance;       // distance from the root along the chain [m]
    double fitted_radius;  // radius fitted to the shape, whatever was given [m]
};

// A stem that is tied to a support grows out of that, so the tree has no capsule from its node below the tie to the
// later one above, where it goes on all the same.
struct ChainLoop {
    int below, above;
};

struct Chain {
    std::vector<ChainNode> nodes;
    std::vector<ChainLoop> loops;
    std::vector<int> vertex_node;  // surface vertex -> nearest chain node along the surface
    // Surface vertex -> chain node at the end of its capsule, and its share of the way along that: 0 where the surface
    // meets the capsule before, 1 where it meets the next ones. A root without a capsule of its own stands for itself.
    std::vector<int> vertex_capsule;
    std::vector<double> vertex_along;
    std::vector<int> rib_of;  // organ -> the blade that it runs along as a rib, or -1; empty: there are no ribs
    double height = 0;        // length of a capsule, as given or chosen [m]
    int root_count() const;
    int fork_count() const;  // nodes with more than one child
    double length() const;   // total of all capsules [m]
};

struct ChainOptions {
    double height = 0;             // length of a capsule [m]; 0: chosen from the shape
    double radius = 0;             // [m]; 0: fitted to the shape
    std::vector<int> rooted = {};  // organs that the plant stands on; empty: found by kind and place
};

// Makes a chain: connected parts of bands of geodesic distance from the root become nodes, so that forks and leaves
// become branches (Verroust, Lazarus 2000: level sets of geodesic distance). It is always a forest without cycles that
// covers every vertex. Where a leaf grows out of a stem, kinds of organs separate them; without organs only the
// surface's components do. A fitted radius is the root of the mean squared distance of the capsule's own surface from
// its axis: the radius of a tube, 0.29 of the width of a blade.
Chain make_chain(const Surface& surface, const Topology& topology, const std::vector<Organ>& organs,
                 const ChainOptions& options);
Chain make_chain(const Surface& surface, const Topology& topology, const ChainOptions& options);

// Points at which the chain begins, sorted: feet of components that stand on the ground (stems, branches, roots, pots
// and stakes if organs are given, so that a drooping leaf is no root). Heights are above the lowest such point of the
// component [m].
struct RootPoints {
    std::vector<int> points;
    std::vector<double> heights;
};
RootPoints find_root_points(const Surface& surface, const Topology& topology, const std::vector<Organ>& organs,
                            const std::vector<int>& rooted);

}  // namespace frond
