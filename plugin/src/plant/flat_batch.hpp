// Chains of several plants of a model side by side: where they are, and how their flat pieces lie (plant/flat.hpp).
#pragma once

#include <vector>

#include "core/lines.hpp"
#include "core/types.hpp"

namespace frond {

struct Plant;
struct Flat;

struct ChainBatch {
    int lanes = 0;
    // Each number once a lane: six of a node, of which the first three are its place; of each flat capsule the columns
    // axis, thin and wide, zero where it has lost its shape.
    NumbersInLines x, frames;
    NumbersInLines turns;  // room: how nodes are turned
};

// As many plants as that, whose chains move and have lost nothing; further lanes are as the last one's.
void look_at_chains(const Plant* const* plants, int count, const std::vector<int>& capsules,
                    const std::vector<Flat>& flats, ChainBatch& out);

}  // namespace frond
