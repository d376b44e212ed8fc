// The response to contacts: impulses by which plants and bodies no longer go into each other.
#pragma once

#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Computes the impulses of the world's contacts, of plants with bodies and with each other, and applies them to both
// sides. Call it between the two halves of all plants' steps.
void respond_to_contacts(World& world, double h);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
