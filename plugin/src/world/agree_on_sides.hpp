// Which way a piece of a plant leaves a piece of another one, where its points want to leave on both sides.
#pragma once

#include "world/plant_contact.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// A point that has nearly gone through a blade is told to leave at the far side, and then holds in what has not;
// branches that cross were so pressed from both sides for ever. Two pieces leave each other on the side of the last
// substep, or on that of what is deepest; contacts that want the other side are dropped.
void agree_on_sides(const std::vector<const PlantContact*>& last, std::vector<PlantContact>& contacts);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
