// Declarations that the stages of making a cage share.
#pragma once

#include "cage/cage.hpp"
#include "cage/cage_copies.hpp"
#include "cage/tet_geometry.hpp"

namespace frond {

// The tets of copy c begin at c * TETS_PER_COPY.
constexpr int TETS_PER_COPY = 12;

// Data that the stages after the copies share.
struct Draft {
    const Topology& topology;
    const Patches& patches;
    const Voxels& voxels;
    const Copies& copies;
    Cage& cage;
    std::vector<int> vertex_copy;  // copy of each surface vertex
};

// Smallest weight of a position that counts as inside a tet.
constexpr double LOWEST_WEIGHT = -1e-9;
// Computes the cosines of the smallest and largest angle between two faces. Returns false if a face has no area.
bool dihedral_cosines(const std::array<Vec3, 4>& corners, double& of_smallest, double& of_largest);

// Returns a cell size that gives a cage of usual size.
double choose_cell_size(const Topology& topology, double offset);
// Moves the nodes towards the surface; keeps every vertex in a tet.
void smooth_cage(const Surface& surface, const CageOptions& options, Draft& draft, Embedding& embedding);
// Sets tet_organ, tet_fill and tissue.
void fill_cage(const std::vector<Organ>& organs, Draft& draft);

}  // namespace frond
