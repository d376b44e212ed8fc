// A few equations for many unknowns.
#pragma once

#include "core/types.hpp"

namespace frond {

using MatX = Eigen::MatrixXd;

// The x, least in squares, that makes slope * x come nearest to `wanted`, with least <= x <= most: Tikhonov's
// regularization, `rigid` telling how much a unit of all x together counts beside a unit of error.
VecX least_change(const MatX& slope, const VecX& wanted, const VecX& least, const VecX& most, double rigid);

}  // namespace frond
