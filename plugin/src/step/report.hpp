// What a substep reports: counts, effects that ran, and their times.
#pragma once

#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Records that an effect ran, and its time [ms].
void add_effect(World& world, frond_effects effect, double ms);
// Adds a plant's counts, times and trouble in this substep to the world's report and profile.
void add_to_report(World& world, PlantBody& body);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
