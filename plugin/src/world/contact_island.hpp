// ContactIsland: contacts and bonds that have to do with each other, through a plant or a body that can be pushed, and
// with none of another island: so each can be answered by a thread of its own.
#pragma once

#include "world/bond.hpp"
#include "world/plant_contact.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct ContactIsland {
    std::vector<PlantBody*> plants;  // each at its PlantBody::place
    // The world's, in its order.
    std::vector<Contact*> with_bodies;
    std::vector<PlantContact*> with_plants;
    std::vector<Bond*> bonds;
};

// Finds the islands of plants that are awake.
std::vector<ContactIsland> find_contact_islands(World& world);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
