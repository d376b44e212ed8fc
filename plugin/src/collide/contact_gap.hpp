// Contact gap: how far apart two cages are now where they touched before.
#pragma once

#include "collide/cage_contact.hpp"

namespace frond {

// A contact of before becomes what it is now: from a's node, or its edge near the point where it touched, to the
// nearest place on b's boundary, with its way out and its depth, below zero where the two are apart. Kind and piece of
// b are those of before. False, and the contact is as it was, where nothing of b is within `reach` [m] or b lies
// another way by now.
bool follow_contact(const CollisionBody& a, const CollisionBody& b, double reach, CageContact& contact);

}  // namespace frond
