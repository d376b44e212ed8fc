// Beams: organs in a row, as tools write one stem in several parts, bend as one body.
#pragma once

#include "model/model.hpp"

namespace frond {

// Returns the model with each organ that continues another one counted to it: of the same kind, where that one ends,
// with a section like its own. Calibrated alone, such a piece would be held by the few nodes that it shares with the
// one before, which are far from rigid. What an organ is stiffer than its material is then in the sections.
Model join_beams(const Model& model);

}  // namespace frond
