// Keeps contacts of plants from substep to substep, where the search no longer finds them or finds them otherwise.
#pragma once

#include "world/plant_contact.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Plants that may touch, with the present places of their cages and sheaths.
struct PlacedIsland {
    const World& world;
    const std::vector<PlantBody*>& plants;
    std::vector<CollisionBody> bodies;  // one per plant
};

// Keeps contacts of the last substep that were not found again as long as they push and both sides are close to each
// other; contacts found again begin with their last impulse. A contact of two cages is followed to where they are
// nearest now: while it holds them apart no overlap is found, and without it light leaves would spring back by
// centimetres in a step. Sheaths are so thin that the nearest place is soon on their other side: their contacts move
// with their points, for some substeps, and sudden increases of depth are limited.
void remember_contacts(const PlacedIsland& island, const std::vector<const PlantContact*>& last,
                       std::vector<PlantContact>& contacts);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
