// Place index: vertices that have exactly the same position share one number.
#pragma once

#include "core/types.hpp"

namespace frond {

struct PlaceIndex {
    std::vector<int> place;  // number of each position, from 0 in order of first appearance
    int count = 0;
};

PlaceIndex index_places(const std::vector<Vec3>& positions);

}  // namespace frond
