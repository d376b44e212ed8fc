// Which contacts of plants go on from substep to substep, where the search does not see them any more or sees them
// otherwise.
#pragma once

#include "world/plant_contact.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Plants that may touch, with their cages and sheaths as they are now.
struct PlacedIsland {
    const World& world;
    const std::vector<PlantBody*>& plants;
    std::vector<CollisionBody> bodies;  // one a plant
};

// Contacts of the last substep that were not found again are kept as long as they push and both sides are beside each
// other; those that were begin with what they had to push. Where two cages touch, a contact is followed to where they
// are nearest now: what is held out by it is not in the other, and light leaves spring back by centimetres in a step.
// Sheaths are so thin that the nearest place soon is on their other side: theirs is moved with its points, for some
// substeps, and what gets deeper all at once is doubted.
void remember_contacts(const PlacedIsland& island, const std::vector<const PlantContact*>& last,
                       std::vector<PlantContact>& contacts);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
