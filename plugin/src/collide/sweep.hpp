// Sweep: finds overlapping boxes along one axis, where there are too few for a hash.
#pragma once

#include "collide/capsule.hpp"
#include "collide/hash.hpp"

namespace frond {

// Returns the box around all that comes nearer to a capsule than `margin` [m].
BoxSet::Bounds box_around(const Capsule& capsule, double margin);
// Returns the pairs of boxes, lower number first, that overlap or touch and are of different groups, in the order of
// their numbers.
std::vector<std::array<int, 2>> find_pairs_by_sweep(const BoxSet& boxes);

}  // namespace frond
