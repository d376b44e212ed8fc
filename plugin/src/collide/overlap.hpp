// Overlap: nodes of one cage inside tets of another or of another part of itself, and boundary edges of one through
// boundary faces of the other. What is found does not depend on the layout of the hash.
#pragma once

#include "collide/collider.hpp"
#include "collide/hash.hpp"

namespace frond {

// A cage that takes part.
struct CollisionBody {
    const Collider* collider;
    const Vec3* places;           // of the nodes, finite, in a frame that all bodies share [m]
    std::vector<uint8_t> pieces;  // 1: takes part; empty: none does, which costs nothing
    bool with_itself = false;     // its parts collide with each other too
    bool is_slim = false;         // so thin everywhere that the nearest way out says little
};

// All bodies in one numbering; what takes no part, or is near nothing, is left out, except that nodes are numbered
// through.
struct OverlapScene {
    std::vector<CollisionBody> bodies;
    std::vector<int> first_node;       // of a body
    std::vector<Vec3> places;          // of all nodes
    std::vector<int> node, node_body;  // in its body's numbering; one a node that takes part
    std::vector<int> tet, tet_body;    // likewise
    std::vector<int> face, face_body;
    std::vector<int> edge, edge_body;
    const Vec3& place(int body, int n) const { return places[size_t(first_node[size_t(body)] + n)]; }
};

// Numbers are those of the scene's arrays.
struct NodeOverlap {
    int node, tet;
    std::array<double, 4> weights;  // of the tet's corners
};
struct EdgeOverlap {
    int edge, face;
    double along;                   // from the edge's first node to its second, 0..1 [-]
    std::array<double, 3> weights;  // of the face's corners
};

struct OverlapSearch {
    OverlapScene scene;
    std::vector<NodeOverlap> nodes;  // by tet's body, node, tet
    std::vector<EdgeOverlap> edges;  // by face's body, edge, along, face
    // Memory that is kept.
    BoxSet items, queries;
    HashMemory hash;
    std::vector<std::array<int, 2>> pairs;
    std::vector<uint8_t> marks;
    double ms_hash = 0;  // of that, for boxes and the hash
};

void find_overlaps(OverlapSearch& search, const std::vector<CollisionBody>& bodies, const HashSettings& settings);

}  // namespace frond
