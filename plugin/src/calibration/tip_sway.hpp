// How the tip of a plant's rods sways after a small force on it ceases, without damping: exactly, and in steps.
#pragma once

#include <memory>

#include "solve/solve.hpp"

namespace frond {

// Most modes that are kept: those that a force on the tip excites.
constexpr int MOST_SWAYS = 24;

// Numbers of modes, without a heap.
using Sways = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, MOST_SWAYS, 1>;
using SwayMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, MOST_SWAYS, MOST_SWAYS>;
using TipMatrix = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, MOST_SWAYS>;

// A plant's small motion in modes of unit mass.
struct TipSway {
    Sways square;   // squares of the modes' angular frequencies [1/s^2]
    Sways start;    // modes in the shape into which a unit force bends the plant [sqrt kg m/N]
    TipMatrix tip;  // displacement of the tip by each mode [1/sqrt kg]
    SwayMatrix
        positive;     // the positive stiffness, by which steps go on from exact forces [1/s^2]; empty: the exact one
    SwayMatrix gram;  // products of the modes as nodes' displacements and rotations, by which bdf2 judges its first
                      // step [1/kg]
    Vec3 direction;   // of the force
};

// Returns the chain node that is farthest from its root along the chain; the first one of those that are as far.
int find_tip(const Model& model);

// Finds the sway of the rods of a model that stands as modelled under its weight, or else has none, with their roots
// held: by Lanczos's method on K^-1 M from the shape of a force on the tip (Nour-Omid, Clough 1984, "Dynamic analysis
// of structures using Lanczos co-ordinates"), which finds the modes that the force excites. `direction`: that of the
// force, length one; null: the horizontal one in which the tip gives way most. Throws BAD_GEOMETRY if nothing can move.
TipSway find_tip_sway(const std::shared_ptr<const Model>& model, frond_mass mass, const Vec3* direction = nullptr);

// Returns the frequency of the mode that the tip shows most of along the force, with those of nearly the same frequency
// combined [Hz].
double main_frequency(const TipSway& sway);

// Returns the error of the tip of `sway`, stepped by h [s], against the exact motion of `exact`: rms over two periods
// of that one's main mode, over its displacement at release [-]. Steps are those of solve/, linearized, with one solve
// a stage. `integrator` may be implicit_euler, bdf2 or sdirk2.
double sway_error(const TipSway& sway, const TipSway& exact, frond_integrator integrator, double h);
// Returns the same for steps that are exact: what the lengths of the capsules and the kind of masses alone cost.
double sway_error(const TipSway& sway, const TipSway& exact);

}  // namespace frond
