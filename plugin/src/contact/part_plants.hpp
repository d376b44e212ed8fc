// Parts plants that overlap, where they were made or pressed into each other.
#pragma once

#include "contact/touched_plant.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Moves overlapping plants apart, without velocity, as far as nothing goes through anything else by that. Call it once
// plants have taken the impulses of the step of h [s]. `touched`: compliances, by the plants' numbers.
void part_plants(World& world, double h, std::vector<TouchedPlant>& touched);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
