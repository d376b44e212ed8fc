// Fits one factor for the organs of a plant that cannot be calibrated alone.
#pragma once

#include "model/model.hpp"

namespace frond {

// Scales tet_young of all organs except those that were calibrated `alone`, one flag per organ.
void calibrate_together(Model& model, const std::vector<char>& alone, int order);

}  // namespace frond
