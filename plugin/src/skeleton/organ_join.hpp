// Joins regions to organs, as a part of vote_on_organs().
#pragma once

#include "core/union_find.hpp"
#include "skeleton/organ_regions.hpp"
#include "skeleton/organ_votes.hpp"

namespace frond {

// Returns whether a region begins a mesh on the ground, of a plant with this foot and height [m].
bool stands(const Region& region, double foot, double height);
UnionFind join_regions(const Surface& surface, const std::vector<Region>& regions,
                       const std::vector<FoundOrgan>& found);

}  // namespace frond
