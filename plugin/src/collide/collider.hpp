// Collider: the colliding parts of a cage, its tets and their boundary, cut into regions as long as a capsule of the
// chain. Made once per model, read-only, shared.
#pragma once

#include "core/types.hpp"

namespace frond {

struct Model;

// Several short lists of numbers in one array.
struct NumberLists {
    struct Range {
        const int *first, *last;
        const int* begin() const { return first; }
        const int* end() const { return last; }
    };
    std::vector<int> start = {0};  // one more than there are lists
    std::vector<int> numbers;
    Range operator[](int i) const { return {numbers.data() + start[size_t(i)], numbers.data() + start[size_t(i) + 1]}; }
};

struct Collider {
    int node_count = 0, piece_count = 0;
    double mean_edge = 0;  // mean length of the boundary's edges, at rest [m]
    std::vector<Tet> tets;
    std::vector<int> tet_piece, tet_organ;

    // The boundary: faces of one tet only.
    std::vector<Triangle> faces;  // anticlockwise seen from outside
    std::vector<int> face_tet;
    NumberLists tet_faces;                       // boundary faces of each tet
    std::vector<Triangle> face_edges;            // edge k is between corners k and k + 1
    std::vector<std::array<int, 2>> edges;       // nodes, ascending
    std::vector<std::array<int, 2>> edge_faces;  // two of each edge's faces, of which there may be more

    std::vector<int> node_tet;  // one of a node's tets; 0 for a node without any
    NumberLists neighbours;     // nodes at the other ends of the tets' edges at each node
    NumberLists node_pieces;    // regions of each node's tets
    NumberLists piece_nodes;

    // Pairs of regions that do not collide: a region and itself, regions that share a node, as at a joint, and regions
    // that overlap at rest, because a cage is fatter than the organ in it, or whose capsules are then close together.
    std::vector<bool> near_pieces;  // piece_count * piece_count
    bool are_near(int a, int b) const { return near_pieces[size_t(a) * size_t(piece_count) + size_t(b)]; }
};

// Makes a collider. `nodes`: at rest; `tet_piece`: 0 .. piece_count - 1; `tet_organ`: as in Cage.
Collider make_collider(const std::vector<Vec3>& nodes, const std::vector<Tet>& tets, const std::vector<int>& tet_piece,
                       const std::vector<int>& tet_organ, int piece_count);
// Makes a collider with a region for each of the model's capsules: tets go to the nearest capsule of their own organ.
Collider make_collider(const Model& model);
// Excludes regions, one per capsule of the model, from colliding where their capsules are close together at rest.
void separate_near_capsules(const Model& model, Collider& collider);

}  // namespace frond
