// What the response known so far leaves undone: contacts that ask for more, and plants that are held back.
#pragma once

#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Looks at the ways that watched plants went with the contacts that are known. Where strips went through each other, or
// nearly, it adds contacts or has those that are known ask for more. Returns whether it did.
bool find_missed_contacts(World& world, double h);
// Reports plants that a kinematic body has come past, whatever was asked of their contacts.
void tell_what_is_behind(World& world, double h);
// Has islands in which strips still go through each other go only as far along the step as none does.
void hold_back_what_passes(World& world, double h);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
