// Fits the moduli of an organ's tets to its rods.
#pragma once

#include "calibration/lone_organ.hpp"

namespace frond {

// Scales tet_young of a sound organ until the cage's compliance, in elements of the given order, is that of the organ's
// rods. `hangs` has the chain node of each of the plant's tets. False, with meaningless moduli, if the rods or the cage
// do not bend.
bool fit_moduli(LoneOrgan& lone, const Model& plant, const std::vector<int>& hangs, int order);

}  // namespace frond
