// Chooses the side on which two regions of plants separate, where their contacts point to both sides.
#pragma once

#include "world/plant_contact.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Two regions separate on the side of the last substep, or on that of their deepest contact; contacts that point to the
// other side are dropped. Otherwise a point that has nearly passed through a blade would leave on the far side and hold
// in the points that have not: branches that cross would be pressed from both sides for ever.
void agree_on_sides(const std::vector<const PlantContact*>& last, std::vector<PlantContact>& contacts);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
