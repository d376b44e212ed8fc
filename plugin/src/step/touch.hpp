// Which plants are touched in a substep: contacts are found, sleepers woken, and the plants marked that others push.
#pragma once

#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Finds the contacts of the substep of h [s]. Wakes the sleepers that they move, and drops those of plants that sleep
// on.
void find_touches(World& world, double h);
// Notes plants that moving bodies touch: they are simulated for a while at any distance.
void note_touches(World& world);
// Drops contacts of modal plants, and of plants whose detail changed after their contacts were found; marks plants that
// others push, which are stepped now.
void mark_touched(World& world);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
