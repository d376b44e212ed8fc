// Heads: flowers, ears and fruits, told by their place and by the small sheets that hang on them.
#pragma once

#include "skeleton/organ_regions.hpp"

namespace frond {

// All by region.
struct Heads {
    std::vector<int> hair_of;   // what it is a petal, an awn, a husk or a hair of; -1: none
    std::vector<char> flower;   // whether it is a flower or a part of one
    std::vector<char> swollen;  // whether it is a tube at a thin neck, much thicker than what bears it
};

// Finds the heads of a plant with this foot and height [m].
Heads find_heads(const std::vector<Region>& regions, double foot, double height);

}  // namespace frond
