// TetNodes: the nodes of a cage's tets for elements of one order. Corners come first, as in the cage; with order 2 one
// node in the middle of each edge follows, in the order of the edge's lower and then its higher corner.
#pragma once

#include "core/types.hpp"

namespace frond {

using Edge = std::array<int, 2>;           // corners, ascending
using QuadraticTet = std::array<int, 10>;  // four corners ascending, then the middles of TET_EDGES: all ascending

// Of the corners of a tet.
constexpr std::array<std::array<int, 2>, 6> TET_EDGES = {{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
// Which of a QuadraticTet's nodes lies between two corners; a corner itself between it and itself.
constexpr int TET_BETWEEN[4][4] = {{0, 4, 5, 6}, {4, 1, 7, 8}, {5, 7, 2, 9}, {6, 8, 9, 3}};

struct TetNodes {
    int order = 1, corner_count = 0;
    std::vector<Edge> edges;           // the corners of node corner_count + k; none with order 1
    std::vector<QuadraticTet> of_tet;  // one a tet; none with order 1
    int count() const { return corner_count + int(edges.size()); }
};

// The tets' corners must be within corner_count.
TetNodes make_tet_nodes(int corner_count, const std::vector<Tet>& tets, int order);

// Places of all nodes, edges straight.
template <class Places>
VecX node_places(const TetNodes& nodes, const Places& corner) {
    VecX x(3 * nodes.count());
    for (int i = 0; i < nodes.corner_count; ++i) point(x, i) = corner(i);
    for (size_t k = 0; k < nodes.edges.size(); ++k)
        point(x, nodes.corner_count + int(k)) = 0.5 * (corner(nodes.edges[k][0]) + corner(nodes.edges[k][1]));
    return x;
}

// Which nodes are held, from the corners that are: the middle of an edge is where both of its corners are.
std::vector<uint8_t> with_middles(const TetNodes& nodes, std::vector<uint8_t> held);

// A place in a tet: the nodes that it follows, and how much.
struct TetPlace {
    int count;  // of nodes
    std::array<int, 10> node;
    std::array<double, 10> weight;  // the shape functions; they add up to one
};
// By barycentric weights L of the tet's corners in the cage's order: L themselves with order 1; with order 2
// L (2 L - 1) at a corner and 4 L L' between two.
TetPlace place_in_tet(const TetNodes& nodes, const std::vector<Tet>& tets, int tet, const std::array<double, 4>& L);

}  // namespace frond
