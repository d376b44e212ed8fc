// Show: sleeping plants are hidden from static bodies, and thereby from kinematic ones, which Bullet filters alike.
#pragma once

#include "world/plant_body.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Finds this world's plants in a box.
std::vector<PlantBody*> plants_in(World& world, const btVector3& lower, const btVector3& upper);
// Shows sleepers that a kinematic body may reach within the next substeps of h [s], so that the broad phase pairs them.
void show_sleepers_to(World& world, const btCollisionObject& mover, double h);
// Hides again the plants that have gone on sleeping, some of them in each substep.
void hide_sleepers_again(World& world);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
