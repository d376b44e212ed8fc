// First modes of a body that is held at its root.
#pragma once

#include "mechanics/mechanics.hpp"
#include "solve/block_factor.hpp"

namespace frond {

// Returns the nodes that do not move: of a chain those of its roots, which are pairs of a position and a rotation; of a
// cage those that the ground holds or that swing on a hinge.
std::vector<uint8_t> still_nodes(const Model& model, const Elements& elements, bool moves_chain);

struct Sway {
    VecX shape;         // mode with a kinetic energy of a half at a velocity of one [1/sqrt kg]; empty: nothing moves
    double square = 0;  // square of the angular frequency [1/s^2]
    Vec3 direction = Vec3::Zero();  // horizontal direction of the pull, unit length
};
// Returns the modes that are seen when the body is pulled aside by its own weight, in the horizontal direction in which
// that moves it farthest and across, and released: the modes with the largest part in that, with those of nearly the
// same frequency combined; the slower one first. Takes a body's stiffness, factorized, and the masses of its nodes
// [kg].
std::array<Sway, 2> first_sways(BlockFactor& stiffness, const VecX& node_mass, const std::vector<uint8_t>& still);
// Does the same for a body of which nodes are `left_out` of the pull, those that are still among them: with leaves left
// out the modes are those of the stem, even where leaves of their own are in resonance with it.
std::array<Sway, 2> first_sways(BlockFactor& stiffness, const VecX& node_mass, const std::vector<uint8_t>& still,
                                const std::vector<uint8_t>& left_out);

}  // namespace frond
