// How fast a plant sways.
#pragma once

#include <memory>

#include "solve/solve.hpp"

namespace frond {

// Frequency of the slowest sway as a whole, as rods held at their roots [Hz]: Rayleigh's quotient of the shape into
// which the plant's own weight, taken sideways, bends it.
double sway_frequency(const std::shared_ptr<const Model>& model);

// The stiffness-proportional damping b [s] at which that sway of a system that stands as modelled on the model's root
// is critically damped: b phi.K phi = 2 omega phi.M phi for its shape phi, K being the positive stiffness of which
// damping is made and omega the frequency under weight, which makes a sway slower. 0 if nothing of it can sway.
double full_damping(const System& system, frond_mechanics which, int order);

}  // namespace frond
