// Crossing: whether the core lines of two things went through each other while both moved along straight lines.
#pragma once

#include <array>
#include <vector>

#include "frond/frond.h"

namespace frond::stability {

using Segment = std::array<frond_vec3, 2>;
// The core of a thing: its axis, or lines in its middle plane [m].
using Core = std::vector<Segment>;

// Returns how often lines of a went through lines of b between two moments, counted by side: one that went through and
// came back gives 0. Both cores have as many lines before as after.
int crossings(const Core& a_before, const Core& a_after, const Core& b_before, const Core& b_after);

}  // namespace frond::stability
