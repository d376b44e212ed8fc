// Cage: the tetrahedra that carry the surface.
#pragma once

#include "model/organ.hpp"

namespace frond {

struct Cage {
    std::vector<Vec3> nodes;       // at rest [m]
    std::vector<Tet> tets;         // positive volume
    std::vector<int> tet_organ;    // index into Model::organs
    std::vector<double> tet_fill;  // share of the tet's volume that is plant [-], > 0
};

// Where each surface vertex sits: position = sum of weights[k] * node(tet[k]). Weights add up to one; they are all in
// 0..1 for a vertex inside its tet.
struct Embedding {
    std::vector<int> tet;
    std::vector<std::array<double, 4>> weights;
};

struct CageOptions {
    double cell_size = 0;  // [m]; 0 chooses
    double offset = 0;     // how far outside the surface cells are kept [m]
    double smoothness = 0.5;
};

struct CageReport {
    double min_dihedral, max_dihedral;  // [degree]
    double min_volume, volume;          // [m^3]
    double contained;                   // share of vertices inside [-]
    double attachment_error;            // [m]
};

// Pseudo volume of a soup (Spillmann, Wagner, Teschner 2006) on a lattice, with one copy of a cell for each organ or
// sheet that passes through it (Molino, Bao, Fedkiw 2004), so that organs which only come near each other are not
// welded.
void make_cage(const Surface& surface, const Topology& topology, const std::vector<Organ>& organs,
               const CageOptions& options, Cage& cage, Embedding& embedding);
// For a cage that the caller brought: binds each vertex to the tet it is in or nearest to.
Embedding embed(const Surface& surface, const Cage& cage);
CageReport measure_cage(const Surface& surface, const Cage& cage, const Embedding& embedding);

}  // namespace frond
