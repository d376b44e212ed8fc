// Patches: manifold and oriented parts of the surface, of one organ each, either a sheet or the boundary of a solid,
// with the amount of tissue and the side it is on.
#pragma once

#include "cage/cage_lattice.hpp"
#include "skeleton/organ.hpp"

namespace frond {

struct Edges {
    std::vector<std::array<int, 3>> triangle_edges;  // edge k of a triangle: corner k to the next; -1: of no length
    std::vector<int> first, triangle;  // the triangles at edge e are triangle[first[e]] .. triangle[first[e+1]-1]
};

struct Patch {
    int organ = 0;
    double area = 0;             // [m^2]
    double volume = 0;           // enclosed [m^3]; 0 unless it is filled
    Vec3 centre = Vec3::Zero();  // of its tissue [m]
    double tissue = 0;           // volume of plant [m^3]; the rest of what a leaf drawn thick encloses is air
    bool solid = false;          // boundary of a body; its holes, if any, are small
    bool filled = false;         // solid, and thick enough to be filled with the volume inside
    std::vector<std::array<Vec3, 3>> caps;  // triangles that close the holes, front outwards
};

struct Patches {
    Edges edges;
    std::vector<Patch> patches;
    std::vector<int> triangle_patch;
    std::vector<char> flipped;   // for each triangle whether its front is the inside
    std::vector<char> repeated;  // for each triangle whether it lies exactly on an earlier one
};

Patches make_patches(const Topology& topology, const std::vector<int>& triangle_organ,
                     const std::vector<Organ>& organs);

}  // namespace frond
