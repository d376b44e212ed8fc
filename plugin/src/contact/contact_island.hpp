// ContactIsland: contacts and bonds that are coupled through plants or movable bodies, and are independent of all other
// islands, so that each island can be solved by a thread of its own.
#pragma once

#include "world/bond.hpp"
#include "world/plant_contact.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct ContactIsland {
    std::vector<PlantBody*> plants;  // each at index PlantBody::place
    // Pointers into the world's lists, in their order.
    std::vector<Contact*> with_bodies;
    std::vector<PlantContact*> with_plants;
    std::vector<Bond*> bonds;
};

// Finds the islands of plants that are awake.
std::vector<ContactIsland> find_contact_islands(World& world);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
