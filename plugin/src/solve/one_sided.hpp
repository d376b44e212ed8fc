// One-sided rows: forces that only pull; each either pulls or is zero.
#pragma once

#include "core/types.hpp"

namespace frond {

// Finds p >= 0 with W p >= b, and p zero where W p > b; W symmetric, positive definite. Returns false if it is not, or
// if no such p is found; p is then zero. Violations up to 1e-9 of the largest b count as rounding.
bool solve_one_sided(const Eigen::MatrixXd& W, const VecX& b, VecX& p);

}  // namespace frond
