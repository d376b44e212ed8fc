// Drags: forces that resist the motion of points of the plant, linear in their velocities within a step.
#pragma once

#include "solve/system.hpp"

namespace frond {

bool drags_are_sound(const System& system, const std::vector<Drag>& drags);
// Returns the potential of the drags [W]: minus its gradient by v is the force.
double drag_potential(const std::vector<Drag>& drags, const VecX& x, const VecX& v);
void add_drag_force(const std::vector<Drag>& drags, const VecX& x, const VecX& v, VecX& f);
void add_drag_damping(const std::vector<Drag>& drags, const VecX& x, double scale, BlockMatrix& A);
// Computes scale times a damping of single nodes that bounds the points' damping from above.
void lump_drags(const std::vector<Drag>& drags, size_t node_count, double scale, std::vector<Mat3>& out);

}  // namespace frond
