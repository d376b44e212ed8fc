// Plants abreast: steps of plants of one model that are worked on side by side (solve/batch.hpp), to the last bit as
// those of each alone.
#pragma once

#include "core/lanes.hpp"
#include "plant/plant.hpp"

namespace frond {

// What goes on in a step of h [s] is what goes on in every healthy one, as far as that is known before it. Leaves in
// the plant which method that will be.
bool may_be_batched(Plant& plant, const Surroundings& surroundings, double h);
// Both of them may: whether they may with each other, in steps of a length.
bool go_alike(const Plant& a, const Plant& b);
// As many as go at once on this processor.
int most_in_batch();
// solve_plant() for up to so many plants that go alike. Those that turn out to need more are stepped alone.
void solve_batch(Plant* const* plants, int count, const Surroundings& surroundings, double h);

}  // namespace frond
