// What movable bodies may gain from plants.
#pragma once

#include "contact/contact_rows.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Shortens the impulses on each movable body by which it would gain more energy than they took from the plants in their
// step of h [s], which is completed. Returns whether any are shorter.
bool bound_gain(const World& world, const std::vector<ContactRow>& rows, double h, std::vector<Vec3>& impulses);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
