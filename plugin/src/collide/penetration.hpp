// Penetration: depth and exit direction of nodes and edges in another cage, consistent over neighbours.
#pragma once

#include "collide/cage_contact.hpp"

namespace frond {

// Overlaps of body a's nodes and edges with body b: indices into the search's sorted arrays.
struct BodyPair {
    int a, b;
    std::vector<int> nodes;  // one overlap per node: that in whose tet the node is deepest
    std::vector<int> edges;  // sorted by edge and then along it
};

// One number per node of the scene, all -1 between calls.
using NodeMarks = std::vector<int>;

// The exit of a point.
struct WayOut {
    Vec3 point = Vec3::Zero();   // [m]
    Vec3 normal = Vec3::Zero();  // exit direction, length one once it is known
    double depth = 0;            // [m]
    bool known = false;
};

// Spreads known exits to neighbouring points without one, round by round until no more can get one. Neighbours are
// weighted by the inverse of the squared distance; depth grows by the distance between the two along the neighbour's
// normal.
void spread_ways_out(std::vector<WayOut>& ways, const std::vector<std::vector<int>>& neighbours);

// Add the contacts of a pair of bodies. `inside` has for the nodes of a that are within b their index in pair.nodes;
// the first returns their exits, for the edges at them.
std::vector<WayOut> find_node_contacts(const OverlapSearch& search, const BodyPair& pair, const NodeMarks& inside,
                                       std::vector<CageContact>& out);
void find_edge_contacts(const OverlapSearch& search, const BodyPair& pair, const NodeMarks& inside,
                        const std::vector<WayOut>& node_ways, std::vector<CageContact>& out);

// Helpers of both searches.
Vec3 face_normal(const OverlapScene& scene, int body, int face);
ContactSide side_of_nodes(const Collider& collider, int body, const int* nodes, const double* weights, int count,
                          int tet);

}  // namespace frond
