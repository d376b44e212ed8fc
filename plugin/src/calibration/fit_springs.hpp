// Fits a chain of springs to the rods.
#pragma once

#include "model/model.hpp"

namespace frond {

// Returns how much stiffer than its tissue each organ's capsules are, so that full cylinders of the radii fitted to the
// shape bend as its rods do [-]. Other radii change that as r^4.
std::vector<double> fit_springs(const Model& model);

}  // namespace frond
