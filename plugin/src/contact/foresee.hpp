// What is foreseen of the contacts of links, for the rows of Bullet's solver (world/link_loads.hpp).
#pragma once

#include "contact/contact_rows.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Takes back what was given to links in Bullet's step, so that contacts are found, and respond, as if nothing had been
// foreseen.
void take_back_from_links(World& world);
// Returns the velocity with which a body has moved in this step, before that [m/s].
Vec3 velocity_as_moved(const World& world, const ContactBody& at);
// Foresees how plants go on where rows push links, once it is known how they go in this step.
void foresee(const World& world, const std::vector<ContactRow>& rows, double h);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
