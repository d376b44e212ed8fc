// The plant's part in the contact response: points on its capsules, and its compliance to impulses there.
#pragma once

#include "collide/cage_contact.hpp"
#include "plant/plant.hpp"
#include "plant/sheath.hpp"

namespace frond {

// Return what touches others where the mechanics move the chain, and where they move the cage, shared by all plants of
// the model as long as one of them keeps it.
std::shared_ptr<const Sheath> sheath_of(const Plant& plant);
std::shared_ptr<const SheathInCage> sheath_in_cage_of(const Plant& plant);
// Returns whether a plant touches others by its sheath, else by its cage.
inline bool touches_by_sheath(const Plant& plant) {
    return plant.follow || plant.input.collision == FROND_COLLISION_ORGANS;
}

// Returns the point of a capsule's axis at `along` of its length from its first node to its second, 0..1. A push on the
// capsule's side is applied there: with a lever it would spin hairs by radians in a step, which no linear response can
// predict.
Attachment capsule_attachment(const Plant& plant, int capsule, double along);

// Returns a point of a cage that the mechanics move.
Attachment cage_attachment(const ContactSide& side);

// A contact point of a plant, between the two halves of a step.
struct PlantTouch {
    Attachment attachment;
    Vec3 velocity;  // at the end of the step, without contact, world frame [m/s]
};
// False if the step failed.
bool make_touch(const Plant& plant, const Attachment& attachment, PlantTouch& touch);
// Returns how far it went in the step as it is now, world frame [m].
Vec3 way_of_touch(const Plant& plant, const PlantTouch& touch);
// Returns the velocities of a plant's nodes at the end of the next step if all that acts on it stays as it is, model
// frame [m/s].
VecX velocities_ahead(Plant& plant);
// Returns its velocity by those of the plant's nodes, world frame [m/s].
Vec3 velocity_of_touch(const Plant& plant, const PlantTouch& touch, const VecX& velocities);
// Finds the compliance to impulses along the world's axes; false if there is none. It is zero where all nodes of the
// attachment are pinned.
bool find_compliance(Plant& plant, const Attachment& attachment, NodeCompliance& compliance);
// Adds an impulse at a touch [N s], world frame, to impulses on the nodes, model frame; none are yet if `sum` is empty.
void add_impulse(const Plant& plant, const PlantTouch& touch, const Vec3& impulse, VecX& sum);

}  // namespace frond
