// System: what all plants of one model share for solving. Read-only once made.
#pragma once

#include "solve/direct.hpp"
#include "solve/solve.hpp"

namespace frond {

struct System {
    std::shared_ptr<const Model> model;
    TetElements elements;
    VecX node_mass;                 // lumped, one a node [kg]
    bool lumped = true;             // the mass matrix is diagonal
    std::vector<double> slot_mass;  // one a block of the pattern, times the identity [kg]
    std::vector<uint8_t> loose;     // one a node: no tet holds it
    double size = 0;                // longest side of the box around the nodes at rest [m]
    DirectPlan plan;
};

// y = M v
void multiply_mass(const System& system, const VecX& v, VecX& y);

}  // namespace frond
