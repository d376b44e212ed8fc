// Springs between points of tets and fixed targets: energy, force, stiffness.
#pragma once

#include "solve/system.hpp"

namespace frond {

bool springs_are_sound(const System& system, const std::vector<Spring>& springs);
double spring_energy(const System& system, const std::vector<Spring>& springs, const VecX& x);
void add_spring_force(const System& system, const std::vector<Spring>& springs, const VecX& x, VecX& f);
void add_spring_stiffness(const System& system, const std::vector<Spring>& springs, double scale, BlockMatrix& A);

}  // namespace frond
