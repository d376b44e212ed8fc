// Looks at all tets with straight edges at once: of one plant, several tets at a time, or of several plants, a plant a
// lane. What is nearly as far as it may go counts as being there, so that they need not round as looks at each tet do.
#pragma once

#include "mechanics/mechanics.hpp"

namespace frond {

// Tells whether some tet may be strained or turned on the way by more than tets that are calm; and whether one may
// yield.
bool any_tet_is_wild(const Elements& elements, const VecX& from, const VecX& to);
bool any_tet_may_yield(const Elements& elements, const VecX& x);
// The same of several plants, a bit each: BatchMechanics.
unsigned tets_not_calm(const Elements& elements, const NumbersInLines& from, const NumbersInLines& to, double part);
unsigned tets_may_yield(const Elements& elements, const NumbersInLines& x);

}  // namespace frond
