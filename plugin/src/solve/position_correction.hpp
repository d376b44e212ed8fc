// Shifts: what moves overlapping bodies apart and gives them no velocity.
#pragma once

#include "solve/impulses.hpp"

namespace frond {

// Impulses along the normals [N s], as those of find_impulses for touches at rest without friction that have to part by
// their least_correction, none by more than its most_correction: then only what touches answer along their normals
// counts, a ninth of W. Each round only comes nearer. Leaves that are pressed from two sides may have no answer at all,
// so rounds are few and what is left is for the next steps. `shifts` stays as it is where nothing has to part.
void correct_positions(const std::vector<Touch>& touches, const CouplingTable& coupling,
                       const ResponseSettings& settings, std::vector<Vec3>& corrections);

}  // namespace frond
