// Patches: the surface in pieces of one organ that are manifold and oriented, each either a sheet or the skin of
// something solid. Tells how much tissue there is and on which side.
#pragma once

#include "model/cage_lattice.hpp"
#include "model/organ.hpp"

namespace frond {

struct Edges {
    std::vector<std::array<int, 3>> triangle_edges;  // edge k of a triangle goes from corner k to the next; -1: a point
    std::vector<int> first, triangle;  // the triangles at edge e are triangle[first[e]] .. triangle[first[e+1]-1]
};

struct Patch {
    int organ = 0;
    double area = 0;                        // [m^2]
    double tissue = 0;                      // volume of plant [m^3]
    bool solid = false;                     // the skin of a body; its holes, if any, are small against it
    bool filled = false;                    // and the body is thick enough to be filled by what it encloses
    std::vector<std::array<Vec3, 3>> caps;  // triangles that close the holes, outside to the front
};

struct Patches {
    Edges edges;
    std::vector<Patch> patches;
    std::vector<int> triangle_patch;
    std::vector<char> flipped;   // of each triangle: its front is the inside
    std::vector<char> repeated;  // a triangle that lies exactly on an earlier one
};

Patches make_patches(const Topology& topology, const std::vector<int>& triangle_organ,
                     const std::vector<Organ>& organs);

}  // namespace frond
