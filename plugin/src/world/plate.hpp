// Plate: a flat piece of a plant as bodies touch it.
#pragma once

#include "world/plant_body.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Points of a convex body that lie over a flat piece, world frame: the corners of the face, or the ends of the edge,
// with which it looks there, cut off where the piece ends. Bullet tells one point a step, on which a box that lands
// would tip. `towards` goes from the body to the piece. None where the body touches the piece's rim.
std::vector<Vec3> points_over_plate(const PlantBody& body, int capsule, const btCollisionObject& other,
                                    const Vec3& towards);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
