// Bodies after a response: how fast they go on, and their work on plants.
#pragma once

#include "contact/contact_rows.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Tells contacts how fast their bodies go on once the rows' impulses have pushed them.
void go_on(const std::vector<ContactRow>& rows, const std::vector<Vec3>& impulses);
// Computes the work of bodies on plants, for the ledger, once nothing changes the plants' ways any more: impulses times
// the bodies' mean velocities, to which a bond adds that by which it comes back together. What nothing slows down gives
// a plant no more than that took of the impulse and of its way, where it was solved again or held back.
void count_work_of_bodies(const World& world, const std::vector<ContactRow>& rows, const std::vector<Vec3>& impulses);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
