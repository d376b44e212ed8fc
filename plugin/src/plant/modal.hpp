// ModalMotion: a plant of which only its two first sways are simulated, as the air drives them. The rest of the chain
// follows.
#pragma once

#include "plant/air.hpp"
#include "plant/blend_out.hpp"
#include "plant/wind.hpp"

namespace frond {

struct Plant;
struct Surroundings;

// One of the two. Of unit modal mass, so that coordinates are metres times the root of a kilogram.
struct NaturalMode {
    VecX shape;            // of the chain's places and rotations; empty: the plant has no such sway
    double square = 0;     // of the angular frequency, under weight [1/s^2]
    double stiffness = 0;  // shape.K shape, without weight [1/s^2]
    double ratio = 0;      // the same, each element times its organ's damping ratio [1/s^2]
    double reach = 0;      // of the place that moves farthest [1/sqrt kg]
    // Of air at 1 m/s along each axis, over its speed and density.
    std::array<Vec3, 3> push = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    std::array<double, 3> resist = {};  // of the mode's own motion likewise
};
// Shared by all plants of a model.
struct ModalBasis {
    std::array<NaturalMode, 2> modes;
    Vec3 middle = Vec3::Zero();  // where the air is asked for, model frame [m]
};
ModalBasis make_modal_basis(const System& rods, const AirPieces& pieces);

struct ModalMotion {
    std::shared_ptr<const ModalBasis> modes;
    std::array<double, 2> place = {}, speed = {};   // when the air was asked last
    std::array<double, 2> rest = {}, damping = {};  // to which the air drives them, and how they are damped since [1/s]
    double since = 0;                               // [s]
    bool comes_to_rest = false;                     // whatever the air does, damped half critically at least
    bool fresh = true;                              // the air was not asked yet
    bool stale = true;                              // the chain is not yet where the sway is
    BlendOut blend_out;                             // of the chain
    std::vector<frond_vec3> at, air;                // one each
};

// A chain goes on as a sway, and as what it was, from where it is. Nothing of it may be broken off.
void begin_modal(Plant& plant);
void end_modal(Plant& plant);
// The chain without what its two first sways cannot have of its shape and motion.
void keep_only_modes(Plant& plant);
// Time goes on; `ask`: the air is asked what it does now.
void step_modal(Plant& plant, const Surroundings& surroundings, double h, bool ask);
// Puts the chain where its sway is, if it has one.
void pose(Plant& plant);
// Where the places are that move farthest, one a mode [m].
std::array<double, 2> modal_reach(const Plant& plant);

}  // namespace frond
