// Solves a few equations for many unknowns.
#pragma once

#include "core/types.hpp"

namespace frond {

using MatX = Eigen::MatrixXd;

// Returns the x, least in squares, that makes slope * x come nearest to `wanted`, with least <= x <= most: Tikhonov's
// regularization, `rigid` being the weight of a unit of all x together relative to a unit of error.
VecX least_change(const MatX& slope, const VecX& wanted, const VecX& least, const VecX& most, double rigid);

}  // namespace frond
