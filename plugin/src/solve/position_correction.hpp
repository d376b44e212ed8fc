// Position correction: moves overlapping bodies apart and gives them no velocity.
#pragma once

#include "solve/impulses.hpp"

namespace frond {

// Finds impulses along the normals [N s], as find_impulses() for contacts at rest without friction that have to part at
// their least_correction, none above its most_correction: then only compliance along the normals counts, a ninth of W.
// Leaves that are pressed from two sides may have no solution at all, so rounds are few and the rest is left to the
// next steps. Empty if nothing has to part.
std::vector<Vec3> correct_positions(const std::vector<Touch>& touches, const CouplingTable& coupling,
                                    const ImpulseLimits& limits);

}  // namespace frond
