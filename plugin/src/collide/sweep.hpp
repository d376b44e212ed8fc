// Sweep: finds overlapping boxes along one axis, where there are too few for a hash.
#pragma once

#include "collide/hash.hpp"

namespace frond {

// Returns the pairs of boxes, lower number first, that overlap or touch and are of different groups, in the order of
// their numbers.
std::vector<std::array<int, 2>> find_pairs_by_sweep(const BoxSet& boxes);

}  // namespace frond
