// Cage: the tetrahedra that carry the surface.
#pragma once

#include "skeleton/organ.hpp"

namespace frond {

struct Cage {
    std::vector<Vec3> nodes;       // rest positions [m]
    std::vector<Tet> tets;         // positive volume
    std::vector<int> tet_organ;    // index into Model::organs
    std::vector<double> tet_fill;  // share of the tet's volume that is plant [-], > 0
    // Volume of plant of each organ [m^3], also of one that shares all its tets with larger ones; empty: tets tell.
    std::vector<double> organ_tissue;
};

// Attachment of each surface vertex: position = sum of weights[k] * node(tet[k]). Weights add up to one; they are all
// in 0..1 for a vertex inside its tet.
struct Embedding {
    std::vector<int> tet;
    std::vector<std::array<double, 4>> weights;
};

struct CageOptions {
    double cell_size = 0;  // [m]; 0: chosen from the shape
    double offset = 0;     // reach of the cage outside the surface [m]
    double smoothness = 0.5;
};

struct CageReport {
    double min_dihedral, max_dihedral;  // [degree]
    double min_volume, volume;          // [m^3]
    double contained;                   // share of vertices inside their tets [-]
    double attachment_error;            // largest error in the position of a vertex [m]
};

// Makes the pseudo volume of a triangle soup (Spillmann, Wagner, Teschner 2006) on a lattice, with one copy of a cell
// for each organ or sheet that passes through it (Molino, Bao, Fedkiw 2004), so that organs that are merely close to
// each other are not welded.
void make_cage(const Surface& surface, const Topology& topology, const std::vector<Organ>& organs,
               const CageOptions& options, Cage& cage, Embedding& embedding);
// Attaches each vertex to the tet that contains it or is nearest, for a cage given by the caller.
Embedding embed(const Surface& surface, const Cage& cage);
CageReport measure_cage(const Surface& surface, const Cage& cage, const Embedding& embedding);

}  // namespace frond
