// Chains of several plants of a model, one per lane: their positions, and the frames of their flat segments
// (plant/flat.hpp).
#pragma once

#include <vector>

#include "core/lines.hpp"
#include "core/types.hpp"

namespace frond {

struct Plant;
struct Flat;

struct ChainBatch {
    int lanes = 0;
    // Each number once per lane: six for a node, the first three its position; for each flat capsule the columns axis,
    // thin and wide, zero where it has collapsed.
    NumbersInLines x, frames;
    NumbersInLines turns;  // workspace: rotation matrices of nodes
};

// Finds chains and frames of `count` plants whose mechanics move the chain and that have no fragments; further lanes
// repeat the last plant.
void look_at_chains(const Plant* const* plants, int count, const std::vector<int>& capsules,
                    const std::vector<Flat>& flats, ChainBatch& out);

}  // namespace frond
