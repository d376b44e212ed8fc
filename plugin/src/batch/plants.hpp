// Batch: steps of plants of one model taken together, a plant per lane (batch/batch_step.hpp), with the same results to
// the last bit as each alone.
#pragma once

#include "core/lanes.hpp"
#include "plant/plant_step.hpp"

namespace frond {

// Returns whether a step of h [s] needs only what every healthy step does, as far as that is known before it. Stores in
// the plant which method it will use.
bool may_be_batched(Plant& plant, const Surroundings& surroundings, double h);
// Returns whether the prediction of that method holds and the pins are at rest; after a batched step they are.
bool goes_on(const Plant& plant, double h);
// Returns whether two plants that may both be batched may share a batch, in steps of one length.
bool go_alike(const Plant& a, const Plant& b);
// Returns how many plants a batch holds on this processor.
int most_in_batch();
// Does solve_plant() for up to that many plants that go alike. Plants that turn out to need more are stepped alone.
void solve_batch(Plant* const* plants, int count, const Surroundings& surroundings, double h);

}  // namespace frond
