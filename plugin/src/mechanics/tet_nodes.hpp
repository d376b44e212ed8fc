// TetNodes: the nodes of a cage's tets for elements of one order. Corners come first, as in the cage; with order 2 one
// node in the middle of each edge follows, sorted by the edge's lower and then its higher corner.
#pragma once

#include "core/types.hpp"

namespace frond {

using Edge = std::array<int, 2>;           // corners, ascending
using QuadraticTet = std::array<int, 10>;  // four corners ascending, then the middles of TET_EDGES: all ascending

// Edges of a tet, as pairs of its corners.
constexpr std::array<std::array<int, 2>, 6> TET_EDGES = {{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
// Index of a QuadraticTet's node between two corners; on the diagonal the corner itself.
constexpr int TET_BETWEEN[4][4] = {{0, 4, 5, 6}, {4, 1, 7, 8}, {5, 7, 2, 9}, {6, 8, 9, 3}};

struct TetNodes {
    int order = 1, corner_count = 0;
    std::vector<Edge> edges;           // the corners of node corner_count + k; empty with order 1
    std::vector<QuadraticTet> of_tet;  // one a tet; empty with order 1
    int count() const { return corner_count + int(edges.size()); }
};

// Makes the nodes; the tets' corners must be below corner_count.
TetNodes make_tet_nodes(int corner_count, const std::vector<Tet>& tets, int order);

// Returns the positions of all nodes, with straight edges.
template <class Places>
VecX node_places(const TetNodes& nodes, const Places& corner) {
    VecX x(3 * nodes.count());
    for (int i = 0; i < nodes.corner_count; ++i) point(x, i) = corner(i);
    for (size_t k = 0; k < nodes.edges.size(); ++k)
        point(x, nodes.corner_count + int(k)) = 0.5 * (corner(nodes.edges[k][0]) + corner(nodes.edges[k][1]));
    return x;
}

// Extends flags of held corners to all nodes: the middle of an edge is held if both of its corners are.
std::vector<uint8_t> with_middles(const TetNodes& nodes, std::vector<uint8_t> held);

// A point in a tet: the nodes that it follows and their weights.
struct TetPlace {
    int count;  // number of nodes
    std::array<int, 10> node;
    std::array<double, 10> weight;  // values of the shape functions; they add up to one
};
// Returns the point with barycentric coordinates L, corners in the cage's order. Weights are L with order 1; with order
// 2 L (2 L - 1) at a corner and 4 L L' between two.
TetPlace place_in_tet(const TetNodes& nodes, const std::vector<Tet>& tets, int tet, const std::array<double, 4>& L);

}  // namespace frond
