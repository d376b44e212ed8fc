// Scenery: parts of a file that are no plant: collision shapes, ground planes, sky domes.
#pragma once

#include "surface/surface.hpp"

namespace frond {

// Returns whether a name marks a collision shape, as game engines read it: "UCX_trunk", "leaf-colonly", "PhysicsShape".
bool names_a_collider(const std::string& name);
// Drops the triangles of scenery and warns of each kind; keeps everything if nothing else is in the surface.
// 1. Parts whose node or material names a collision shape.
// 2. Ground: a level, thin component of few triangles at the foot, much wider than all the rest,
//    whose name is no organ's.
// 3. Sky: a component that encloses all the rest at a distance.
// Returns whether anything was dropped; the surface has to be cleaned again then.
bool leave_out_scenery(Surface& surface);

}  // namespace frond
