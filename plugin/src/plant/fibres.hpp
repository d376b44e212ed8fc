// Fibres: the tensile stiffness that an organ has and its cage lacks. A cage is fatter than its organ and fitted to the
// organ's bending, so its tensile stiffness is too low by the square of the ratio of their thicknesses: for a blade of
// 0.3 mm in cells of 24 mm it is the 1/6400th part.
#pragma once

#include "solve/solve.hpp"

namespace frond {

struct Plant;

// Fibre along the capsule between a chain node and its parent.
struct Fibre {
    int node;
    double length;     // length from which it pulls [m]
    double stiffness;  // tensile stiffness that the organ's tissue has and the cage lacks [N/m]
};

// One per chain node that has a parent, in the chain's order, of organs whose cage has less than half of their own
// tensile stiffness. Shared by all plants of a model.
struct Fibres {
    std::vector<Fibre> list;
    std::vector<int> of_node;       // of a chain node: index into `list`; -1: none
    std::vector<int> of_cage_node;  // the same for the capsule that a cage node is nearest to
};
Fibres make_fibres(const Model& model, const TetNodes& nodes, const VecX& modelled);

// Returns whether no fibre would pull at the plant's present position; updates chain_positions.
bool are_slack(Plant& plant);

// Ends a solve over h [s], or a part of a step: pulls back what it stretched; does nothing if all fibres are slack. A
// step in parts needs it after each: what all of them stretched is too much for the impulses of the last.
// `is_step`: of the host's, from x_good; else who calls looks at the energy.
void hold_lengths(Plant& plant, double h, bool is_step = true);

}  // namespace frond
