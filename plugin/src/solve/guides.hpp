// Guides: nodes that rotate, but not about all axes.
#pragma once

#include "solve/workspace.hpp"

namespace frond {

bool guides_are_sound(const System& system, const std::vector<Guide>& guides);
// Returns the rotation vector that a guide allows next to another one.
Vec3 guided(const Guide& guide, const Vec3& turn);
// Returns the projection of a change of that rotation vector on what is held of it.
Mat3 held_part(const Guide& guide, const Vec3& turn);

// Finds the held parts of all guided nodes at x, which the following functions take away.
void look_at_guides(Workspace& workspace, const VecX& x);
// Returns the guide of a node that is not held as a whole; -1 if there is none.
int guide_of(const Workspace& workspace, int node);
// Takes the held parts from a vector of velocities, forces or impulses.
void keep_free_parts(const Workspace& workspace, VecX& of_nodes);
// Makes rows and columns of held parts in workspace.A those of a diagonal matrix.
void hold_parts(Workspace& workspace);

}  // namespace frond
