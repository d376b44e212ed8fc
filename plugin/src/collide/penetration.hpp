// Penetration: how deep what is in another cage is, and the way out, consistent over neighbours.
#pragma once

#include "collide/cage_contact.hpp"

namespace frond {

// Overlaps of one body's nodes and edges with one body: ranges of the search's sorted arrays.
struct BodyPair {
    int a, b;
    std::vector<int> nodes;  // overlaps, one a node: that in whose tet the node is deepest
    std::vector<int> edges;  // by edge and then along it
};

// Per node of the scene, between calls all -1.
using NodeMarks = std::vector<int>;

// The way out of a point.
struct WayOut {
    Vec3 point = Vec3::Zero();   // [m]
    Vec3 normal = Vec3::Zero();  // of length one once it is known
    double depth = 0;            // [m]
    bool known = false;
};

// Gives every point that does not know its way out that of its neighbours which do, from those outwards until none is
// left that could: inversely weighted by the squared distance, deeper by what is between them along their normal.
void spread_ways_out(std::vector<WayOut>& ways, const std::vector<std::vector<int>>& neighbours);

// Add the contacts of a pair of bodies. `inside` marks the nodes of a that are within b, by their number among
// pair.nodes; their ways out come back, for the edges at them.
std::vector<WayOut> find_node_contacts(const OverlapSearch& search, const BodyPair& pair, const NodeMarks& inside,
                                       std::vector<CageContact>& out);
void find_edge_contacts(const OverlapSearch& search, const BodyPair& pair, const NodeMarks& inside,
                        const std::vector<WayOut>& node_ways, std::vector<CageContact>& out);

// Both searches need these of the scene.
Vec3 face_normal(const OverlapScene& scene, int body, int face);
ContactSide side_of_nodes(const Collider& collider, int body, const int* nodes, const double* weights, int count,
                          int tet);

}  // namespace frond
