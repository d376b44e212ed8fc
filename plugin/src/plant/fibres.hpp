// Fibres: the tensile stiffness that an organ has and its cage lacks. A cage is fatter than its organ and fitted to the
// organ's bending, so its tensile stiffness is too low by the square of the ratio of their thicknesses: for a blade of
// 0.3 mm in cells of 24 mm it is the 1/6400th part.
//
// Fibres lie along capsules, and are slack up to a small stretch, so small motions, the rest shape and the fit of the
// cage are unaffected. A step that begins with a taut one is solved with all of them, further if one solve misses
// their energy.
#pragma once

#include "solve/solve.hpp"

namespace frond {

struct Plant;

// Those of organs whose cage has less than half of their own tensile stiffness, each from a chain node's parent to it,
// in the chain's order. Shared by all plants of a model.
struct Fibres {
    std::vector<Fibre> list;
    std::vector<int> node;                      // chain node at the end of each
    std::vector<int> of_node;                   // of a chain node: index into `list`; -1: none
    std::vector<int> of_cage_node;              // the same for the capsule that a cage node is nearest to
    std::vector<Attachment> axis_of_cage_node;  // and the point of its axis that bears a force on the node
};
Fibres make_fibres(const Model& model, const TetNodes& nodes, const VecX& modelled);

// Return what bears a pull on a node of the cage, and on a vertex: in an organ with fibres the capsule that it belongs
// to, as tissue holds a blade's edge to its middle; elsewhere the node itself, or its cell.
Attachment pulled_at_node(const Plant& plant, int node);
Attachment pulled_at_vertex(const Plant& plant, int vertex);

// Returns whether a fibre bears what pulls a vertex.
bool is_on_fibre(const Plant& plant, int vertex);

// Returns the plant's fibres for a solve, and ties of grabbed and bonded vertices to both ends of their capsules.
std::unique_ptr<FibreLoads> fibres_of(const Plant& plant);
// Looks what fibres store now.
void look_at_fibres(Plant& plant);
// Returns whether a fibre is taut after a solve that was slack before it, by energy that matters.
bool fibre_becomes_taut(const Plant& plant);
// Looks after a solve of one linear system, with fibres linearized at `from` or, if that is null, without fibres.
// Returns whether it holds.
bool holds_for_fibres(Plant& plant, const VecX* from);
// Lets fibres of an entangled plant lengthen, as crossed leaves come apart only by being stretched, and shorten
// afterwards: at once where they are slack, else slowly and as far as that stores no energy that matters; after a step
// of h [s].
void let_fibres_give(Plant& plant, double h);
// Returns their energy [J], and adds their forces [N]; none if the plant's steps have no fibres.
double fibre_energy(const Plant& plant, const VecX& x);
void add_fibre_forces(const Plant& plant, const VecX& x, VecX& f);

}  // namespace frond
