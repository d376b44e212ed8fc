// Springs between points of a plant and fixed targets: energy, force, stiffness.
#pragma once

#include "solve/system.hpp"

namespace frond {

bool springs_are_sound(const System& system, const std::vector<Spring>& springs);
double spring_energy(const std::vector<Spring>& springs, const VecX& x);
void add_spring_force(const std::vector<Spring>& springs, const VecX& x, VecX& f);
void add_spring_stiffness(const std::vector<Spring>& springs, const VecX& x, Tangent tangent, double scale,
                          BlockMatrix& A);

}  // namespace frond
