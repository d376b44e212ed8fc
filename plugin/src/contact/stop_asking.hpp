// Asking: contacts that ask for more than that nothing comes nearer, to part what overlaps or what passed.
#pragma once

#include "contact/contact_island.hpp"
#include "contact/coupled_rows.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Has contacts ask for no more than that nothing comes nearer if the rest would give energy: steps are shortened
// instead. Returns whether it did.
bool stop_asking(const ContactIsland& island, const CoupledRows& coupled, const std::vector<Vec3>& impulses, double h);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
