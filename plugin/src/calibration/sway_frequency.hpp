// Natural frequency and damping of a plant's first mode.
#pragma once

#include <memory>

#include "solve/solve.hpp"

namespace frond {

// Returns the frequency of the slowest mode of the whole plant, as rods held at their roots [Hz]: Rayleigh's quotient
// of the shape into which the plant's own weight, applied sideways, bends it.
double sway_frequency(const std::shared_ptr<const Model>& model);

// Returns the stiffness-proportional damping b [s] at which that mode of a system that stands as modelled on the
// model's root is critically damped: b phi.K phi = 2 omega phi.M phi for its shape phi, K being the positive stiffness
// of which damping is made and omega the frequency under weight, which makes a mode slower. 0 if nothing of it can
// move.
double full_damping(const System& system, frond_mechanics which, int order);

}  // namespace frond
