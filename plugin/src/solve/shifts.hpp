// Shifts: what moves overlapping bodies apart and gives them no velocity.
#pragma once

#include "solve/impulses.hpp"

namespace frond {

// Impulses along the normals [N s], as those of find_impulses for touches at rest without friction that have to part by
// their least_shift: then only what touches answer along their normals counts, a ninth of W. Each round only comes nearer.
std::vector<Vec3> find_shifts(const std::vector<Touch>& touches, const CouplingTable& coupling, int rounds,
                              double tolerance, double unfelt);

}  // namespace frond
