// Contact gap: the present distance of two cages where they touched before.
#pragma once

#include "collide/cage_contact.hpp"

namespace frond {

// Updates a contact to the present places: from a's node, or its edge near the point where it touched, to the nearest
// place on b's boundary, with exit direction and depth, below zero where the two are apart. The kind stays; b's region
// may become one near it. Returns false, and leaves the contact as it was, where nothing of b is within `reach` [m] or
// b now lies in another direction.
bool follow_contact(const CollisionBody& a, const CollisionBody& b, double reach, CageContact& contact);

}  // namespace frond
