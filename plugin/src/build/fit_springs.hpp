// Fits a chain of springs to the rods.
#pragma once

#include "model/model.hpp"

namespace frond {

// How much stiffer than its tissue each organ's capsules are, so that full cylinders of the radii that the shape has
// bend as its rods do [-]. Other radii change that as r^4.
std::vector<double> fit_springs(const Model& model);

}  // namespace frond
