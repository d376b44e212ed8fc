// Fibres: what an organ has against being drawn out and its cage has not. A cage is fatter than what it holds and is
// fitted to how that bends: against a pull it has the square of the ratio of their thicknesses too little, of a blade
// of 0.3 mm in cells of 24 mm the 1/6400th part.
#pragma once

#include "solve/solve.hpp"

namespace frond {

struct Plant;

// Along the capsule between a chain node and its parent.
struct Fibre {
    int node;
    double length;     // from which it pulls [m]
    double stiffness;  // what the organ's tissue has and the cage has not [N/m]
};

// One a chain node that has a parent, in the chain's order, of organs whose cage has less than half of their own
// stiffness against pull. Shared by all plants of a model.
struct Fibres {
    std::vector<Fibre> list;
    std::vector<int> of_node;  // index into `list`; -1: none
};
Fibres make_fibres(const Model& model, int order);

// Tells whether none would pull where the plant is now; chain_positions are brought there.
bool are_slack(Plant& plant);

// After a solve over h [s]: pulls together what is drawn out. Nothing is done where nothing is.
void hold_lengths(Plant& plant, double h);

}  // namespace frond
