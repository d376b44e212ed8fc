// Ribs: organs that run along a blade are one beam with it.
#pragma once

#include "skeleton/chain.hpp"

namespace frond {

// Removes the branches of ribs drawn as tubes of their own along blades, and sets Chain::rib_of. The blades' capsules
// then carry the ribs' vertices.
void join_ribs(const Surface& surface, const std::vector<Organ>& organs, Chain& chain);

}  // namespace frond
