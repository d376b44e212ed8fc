// What a plant is to the contact response: points on its capsules, and how its velocities answer to impulses there.
#pragma once

#include "collide/cage_contact.hpp"
#include "plant/plant.hpp"
#include "plant/sheath.hpp"

namespace frond {

// What of the plant's cage collides; shared by all plants of the model that ask while one of them keeps it.
std::shared_ptr<const Collider> collider_of(const Plant& plant);
// Likewise, what collides of one whose chain moves by itself.
std::shared_ptr<const Sheath> sheath_of(const Plant& plant);

// The point of a capsule's axis at `along` of the way from its first node to its second, 0..1. A push on the capsule's
// side is taken there: as a lever it would spin hairs by radians in a step, which no linear answer can tell.
Attachment capsule_attachment(const Plant& plant, int capsule, double along);

// A point of the cage, which moves by itself.
Attachment cage_attachment(const ContactSide& side);

// One touch of a plant, between the two halves of a step.
struct PlantTouch {
    Attachment attachment;
    Vec3 velocity;              // at the end of the step, without contact, world frame [m/s]
    NodeCompliance compliance;  // to impulses along the world's axes
};
// Without the answer, which takes longer by far. False if the step failed.
bool make_touch(const Plant& plant, const Attachment& attachment, PlantTouch& touch);
// False if there is none. Where all that the grip holds is pinned, it is zero.
bool find_compliance(Plant& plant, PlantTouch& touch);
// An impulse at a touch [N s], world frame; it adds to plant.contact_impulse.
void take_impulse(Plant& plant, const PlantTouch& touch, const Vec3& impulse);
// The same, but it only moves the plant, and gives it no velocity; it adds to plant.contact_correction.
void take_correction(Plant& plant, const PlantTouch& touch, const Vec3& impulse);

}  // namespace frond
