// Finding the contacts of plants with each other and with themselves.
#pragma once

#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Sets the attachments of the points on both sides, by their present mechanics.
void take_attachments(PlantContact& contact);
// Returns whether the effects that let its plants touch are on.
bool may_touch(const World& world, const PlantContact& contact);

// Returns whether a plant takes part in an effect by which plants touch. One that broke does not: its cage still has
// the fragments' nodes.
bool touches_others(const World& world, const PlantBody& body, frond_effects effect);
// Finds groups of plants whose boxes overlap, or will within the step, and single plants with self-contact.
std::vector<std::vector<PlantBody*>> find_plant_islands(World& world, double h);
// Finds the contacts of plants. Bullet's broad phase finds plants that may meet, capsules around regions of their cages
// find the organs, and a spatial hash finds nodes, edges and tets (section 3.3 of the paper). Contacts of the last
// substep that the search misses are kept (remember_contacts.hpp), so that a plant that rests on another one does not
// sink into it again and again. Contacts that will occur within the step of h [s] at present velocities are included.
std::vector<PlantContact> find_plant_contacts(World& world, double h);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
