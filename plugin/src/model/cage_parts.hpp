// Parts of the making of a cage that its stages hand to each other.
#pragma once

#include "model/cage.hpp"
#include "model/cage_copies.hpp"
#include "model/tet_geometry.hpp"

namespace frond {

// The tets of copy c are c * TETS_PER_COPY and the ones that follow.
constexpr int TETS_PER_COPY = 12;

// Data that the stages after the copies share.
struct Draft {
    const Topology& topology;
    const Patches& patches;
    const Cover& cover;
    const Copies& copies;
    Cage& cage;
    std::vector<int> vertex_copy;  // of each surface vertex
};

// A place counts as inside a tet down to this weight.
constexpr double LOWEST_WEIGHT = -1e-9;
// Cosines of the smallest and largest angle between two faces. False if a face has no area.
bool dihedral_cosines(const std::array<Vec3, 4>& corners, double& of_smallest, double& of_largest);

// A cell size that gives a cage of usual size.
double choose_cell_size(const Topology& topology, double offset);
// Moves the nodes on the outside; keeps every vertex inside.
void smooth_cage(const Surface& surface, const CageOptions& options, Draft& draft, Embedding& embedding);
// Sets tet_organ and tet_fill.
void fill_cage(const std::vector<int>& triangle_organ, const std::vector<Organ>& organs, Draft& draft);

}  // namespace frond
