// Model: everything about a plant that does not change. Built once, read-only, shared by all its plants.
#pragma once

#include "model/cage.hpp"
#include "model/chain.hpp"

namespace frond {

struct Model {
    Surface surface;
    Topology topology;
    std::vector<Organ> organs;
    Chain chain;
    Cage cage;
    Embedding embedding;          // surface vertices in the cage
    Embedding chain_embedding;    // chain nodes in the cage
    std::vector<double> tet_density;  // of the cage's tets, so that the organ weighs what it should [kg/m^3]
    std::vector<double> tet_young;    // so that it bends as it should [Pa]
    std::vector<double> tet_poisson;
    CageReport cage_report;
    double ms_import = 0, ms_cage = 0, ms_chain = 0, ms_total = 0;
};

}  // namespace frond
