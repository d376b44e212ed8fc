// Moves the centre of masses by the least change of them.
#pragma once

#include "core/types.hpp"

namespace frond {

// Changes masses at places so that their centre comes to the wanted one, as far as the places allow, by the least
// change: each is multiplied by an exponential of its place. Their sum stays.
void shift_centre(const std::vector<Vec3>& places, const Vec3& wanted, std::vector<double>& masses);

}  // namespace frond
