// Plants' own parts of a substep, alone and in batches, shared out into jobs.
#pragma once

#include "plant/plant_step.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Steps all plants that are awake, each up to where contacts push it; plants that nothing touches complete their step.
void step_plants(World& world, const Surroundings& surroundings, double h);
// Completes the steps of the plants that waited for the response to contacts.
void finish_touched(World& world, const Surroundings& surroundings);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
