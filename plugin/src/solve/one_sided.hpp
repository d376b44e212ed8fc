// One-sided rows: forces that only pull, of which each either pulls or has nothing to do.
#pragma once

#include "core/types.hpp"

namespace frond {

// p >= 0 with W p >= b, and p zero where W p > b; W symmetric, positive definite. False if it is not, or if no such p
// is found; p is then zero. Rounding is let be up to 1e-9 of the largest b.
bool solve_one_sided(const Eigen::MatrixXd& W, const VecX& b, VecX& p);

}  // namespace frond
