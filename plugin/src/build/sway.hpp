// How a body that is held at its root sways.
#pragma once

#include "mechanics/mechanics.hpp"
#include "solve/block_factor.hpp"

namespace frond {

// Nodes that do not sway: those of the chain's roots, which are pairs of a place and a rotation; or of a cage those
// that the ground holds or that swing on a hinge.
std::vector<uint8_t> still_nodes(const Model& model, const Elements& elements, bool moves_chain);

struct Sway {
    VecX shape;         // of which the kinetic energy at a velocity of one is a half [1/sqrt kg]; empty: nothing moves
    double square = 0;  // of the angular frequency [1/s^2]
};
// The sways that are seen when the body is drawn aside by its own weight, in the horizontal direction in which that
// moves it farthest and across, and let go: of its modes the ones with the largest part in that, those of nearly one
// frequency together; the slower sway first. By a body's stiffness, factorized, and the masses of its nodes [kg].
std::array<Sway, 2> first_sways(BlockFactor& stiffness, const VecX& node_mass, const std::vector<uint8_t>& still);

}  // namespace frond
