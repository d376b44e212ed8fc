// Toppling: the way in which a body gives way first under its weight. Linear buckling: with P the stiffness that resists
// and G what weight takes from it, the mode of the largest eigenvalue of P^-1 G; a body is stable while that is below
// one (Greenhill 1881 for a single stem).
#pragma once

#include "build/static_stiffness.hpp"

namespace frond {

struct Toppling {
    VecX mode;            // empty: none was found
    double overload = 0;  // how many times too heavy the body is [-]
};

// What weight takes from a body's stiffness at x: the positive one less the exact one.
void take_by_weight(const Elements& elements, frond_mechanics which, const VecX& x, BlockMatrix& taken);

// `resisting` has its factor.
Toppling find_toppling(StaticStiffness& resisting, const BlockMatrix& taken, const std::vector<uint8_t>& held);

}  // namespace frond
