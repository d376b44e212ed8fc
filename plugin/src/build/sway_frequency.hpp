// How fast a plant sways.
#pragma once

#include <memory>

#include "model/model.hpp"

namespace frond {

// Frequency of the slowest sway as a whole, as rods held at their roots [Hz]: Rayleigh's quotient of the shape into
// which the plant's own weight, taken sideways, bends it.
double sway_frequency(const std::shared_ptr<const Model>& model);

}  // namespace frond
