// Place index: vertices that lie at exactly the same place share one number.
#pragma once

#include "core/types.hpp"

namespace frond {

struct PlaceIndex {
    std::vector<int> place;  // of each position; numbered from 0 in order of first appearance
    int count = 0;
};

PlaceIndex index_places(const std::vector<Vec3>& positions);

}  // namespace frond
