// Overlap: nodes of one cage inside tets of another or of another region of itself, and boundary edges of one through
// boundary faces of the other. Results do not depend on the layout of the hash.
#pragma once

#include "collide/collider.hpp"
#include "collide/hash.hpp"

namespace frond {

// A cage that takes part in the search.
struct CollisionBody {
    const Collider* collider;
    const Vec3* places;           // places of the nodes, finite, in a frame that all bodies share [m]
    std::vector<uint8_t> pieces;  // per region, 1: takes part; empty: none does, which costs nothing
    bool with_itself = false;     // its regions collide with each other too
    bool is_slim = false;         // so thin everywhere that the shortest exit is not reliable
};

// All bodies in one numbering, without parts that take no part or are near nothing; only nodes are numbered throughout.
struct OverlapScene {
    std::vector<CollisionBody> bodies;
    std::vector<int> first_node;       // first node of each body
    std::vector<Vec3> places;          // places of all nodes [m]
    std::vector<int> node, node_body;  // in its body's numbering; one per node that takes part
    std::vector<int> tet, tet_body;    // likewise
    std::vector<int> face, face_body;
    std::vector<int> edge, edge_body;
    const Vec3& place(int body, int n) const { return places[size_t(first_node[size_t(body)] + n)]; }
};

// Indices into the scene's arrays.
struct NodeOverlap {
    int node, tet;
    std::array<double, 4> weights;  // weights of the tet's corners
};
struct EdgeOverlap {
    int edge, face;
    double along;                   // position from the edge's first node to its second, 0..1 [-]
    std::array<double, 3> weights;  // weights of the face's corners
};

struct OverlapSearch {
    OverlapScene scene;
    std::vector<NodeOverlap> nodes;  // sorted by tet's body, node, tet
    std::vector<EdgeOverlap> edges;  // sorted by face's body, edge, along, face
    // Memory that is kept between searches.
    BoxSet items, queries;
    HashMemory hash;
    std::vector<std::array<int, 2>> pairs;
    std::vector<uint8_t> marks;
    double ms_hash = 0;  // time for boxes and the hash
};

void find_overlaps(OverlapSearch& search, const std::vector<CollisionBody>& bodies, const HashSettings& settings);

}  // namespace frond
