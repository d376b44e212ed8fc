// Plants let a kinematic or heavy body through that crowds them more than a step can answer: they touch it no more
// until their boxes in the broad phase are apart.
#pragma once

#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

void let_through(PlantBody& body, const btCollisionObject& object);
bool lets_through(const PlantBody& body, const btCollisionObject& object);
// Has plants that are awake touch again what they are apart from; the others report that something passes.
void touch_again(World& world);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
