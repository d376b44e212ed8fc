// Show: sleeping plants are hidden from what is static, and with it from kinematic bodies, which Bullet filters alike.
#pragma once

#include "world/plant_body.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// This world's plants in a box.
std::vector<PlantBody*> plants_in(World& world, const btVector3& lower, const btVector3& upper);
// Shows those that sleep where a kinematic body comes within the next substeps of h, so that the broad phase pairs
// them.
void show_sleepers_to(World& world, const btCollisionObject& mover, double h);
// Hides those again that have gone on sleeping, some of them in each substep.
void hide_sleepers_again(World& world);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
