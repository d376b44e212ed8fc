// Bonds: shared by the calls that make one.
#pragma once

#include "api/handles.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Holds the plant's vertex nearest to the point to a body of its world, and gives the bond a handle.
void make_bond(PlantBody& plant, const frond_vec3& point, btCollisionObject& body, frond_bond* out);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
