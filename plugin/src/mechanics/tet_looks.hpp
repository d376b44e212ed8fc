// Quick checks of all T4 tets: of one plant, several tets at a time, or of a batch, one plant a lane. A tet close to
// its limit counts as beyond it, so that rounding need not be the same as in the exact check of each tet.
#pragma once

#include "mechanics/mechanics.hpp"

namespace frond {

// Return whether any tet may go beyond the trust bound between `from` and `to`, and whether any may yield.
bool any_tet_is_wild(const Elements& elements, const VecX& from, const VecX& to);
bool any_tet_may_yield(const Elements& elements, const VecX& x);
// The same for a batch, a bit for each plant: see BatchMechanics.
unsigned tets_not_calm(const Elements& elements, const NumbersInLines& from, const NumbersInLines& to, double part);
unsigned tets_may_yield(const Elements& elements, const NumbersInLines& x);

}  // namespace frond
