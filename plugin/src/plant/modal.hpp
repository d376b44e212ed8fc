// ModalMotion: a plant of which only the first two modes are simulated, as the air drives them. The rest of the chain
// follows.
#pragma once

#include "plant/air.hpp"
#include "plant/blend_out.hpp"
#include "plant/wind.hpp"

namespace frond {

struct Plant;
struct Surroundings;

// One of the two modes, of unit modal mass, so that coordinates are metres times the root of a kilogram.
struct NaturalMode {
    VecX shape;            // positions and rotations of the chain; empty: the plant has no such mode
    double square = 0;     // square of the angular frequency, under weight [1/s^2]
    double stiffness = 0;  // shape.K shape, without weight [1/s^2]
    double ratio = 0;      // the same, each element times its organ's damping ratio [1/s^2]
    double reach = 0;      // largest displacement of a node [1/sqrt kg]
    // Push of air at 1 m/s along each axis, over its speed and density.
    std::array<Vec3, 3> push = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    std::array<double, 3> resist = {};  // likewise, resistance to the mode's own motion
};
// Shared by all plants of a model.
struct ModalBasis {
    std::array<NaturalMode, 2> modes;
    Vec3 middle = Vec3::Zero();  // point at which the air is sampled, model frame [m]
};
ModalBasis make_modal_basis(const System& rods, const AirPieces& pieces);

// The part of it that a snapshot keeps as it is.
struct ModalState {
    std::array<double, 2> place = {}, speed = {};   // at the last update of the air
    std::array<double, 2> rest = {}, damping = {};  // equilibria in that air, and damping since then [1/s]
    double since = 0;                               // time since then [s]
    bool comes_to_rest = false;                     // whatever the air does, with at least half of critical damping
    bool fresh = true;                              // the air was not sampled yet
    BlendOut blend_out;                             // remainder of the chain's turns and strains
};
struct ModalMotion : ModalState {
    std::shared_ptr<const ModalBasis> modes;
    bool stale = true;                // the chain is not yet where the modes put it
    std::vector<frond_vec3> at, air;  // point and air for a query, one each
};

// Switch a chain to modal motion and back from its present state. It must have no fragments.
void begin_modal(Plant& plant);
void end_modal(Plant& plant);
// Removes what the first two modes cannot represent of the chain's shape and motion.
void keep_only_modes(Plant& plant);
// Returns whether a plant is whole and held by its own roots alone, as modes suppose.
bool sways_on_its_roots(const Plant& plant);
// Advances time; `ask`: updates the air.
void step_modal(Plant& plant, const Surroundings& surroundings, double h, bool ask);
// Puts the chain where its modes are, if it is modal.
void pose(Plant& plant);
// Returns the displacements of the nodes that move farthest, one per mode [m].
std::array<double, 2> modal_reach(const Plant& plant);

}  // namespace frond
