// Joins regions to organs, as a part of vote_on_organs().
#pragma once

#include "model/organ_regions.hpp"
#include "model/organ_votes.hpp"
#include "model/union_find.hpp"

namespace frond {

// Returns whether a region begins a mesh on the ground, of a plant with this foot and height [m].
bool stands(const Region& region, double foot, double height);
UnionFind join_regions(const Surface& surface, const std::vector<Region>& regions,
                       const std::vector<FoundOrgan>& found);

}  // namespace frond
