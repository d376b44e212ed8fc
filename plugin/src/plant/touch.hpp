// What a plant is to the contact response: points on its capsules, and how its velocities answer to impulses there.
#pragma once

#include <array>

#include "plant/plant.hpp"

namespace frond {

// The point of a capsule's axis at `along` of the way from its first node to its second, 0..1. A push on the capsule's
// side is taken there: as a lever it would spin hairs by radians in a step, which no linear answer can tell.
Grip capsule_grip(const Plant& plant, int capsule, double along);

// One touch of a plant, between the two halves of a step.
struct PlantTouch {
    Grip grip;
    Vec3 velocity;                // at the end of the step, without contact, world frame [m/s]
    std::array<VecX, 3> answers;  // of the nodes' velocities to impulses along the world's axes [1/kg]
};
// False if the step failed. Where all that the grip holds is pinned, answers are zero.
bool make_touch(Plant& plant, const Grip& grip, PlantTouch& touch);
// Velocity at a grip by an impulse at a touch, both in the world's frame [1/kg].
Mat3 answer_at(const Plant& plant, const Grip& grip, const PlantTouch& touch);
// An impulse at a touch [N s], world frame; it adds to plant.contact_impulse.
void take_impulse(Plant& plant, const PlantTouch& touch, const Vec3& impulse);

}  // namespace frond
