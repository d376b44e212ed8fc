// Plate: a flat segment of a plant as bodies touch it.
#pragma once

#include "world/plant_body.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Finds the points of a convex body over a plate, world frame: the corners of the face, or the ends of the edge, that
// faces the plate, clipped at the plate's outline. Bullet reports one point a step, on which a box that lands would
// tip. `towards` points from the body to the plate. None where the body touches the plate's rim.
std::vector<Vec3> points_over_plate(const PlantBody& body, int capsule, const btCollisionObject& other,
                                    const Vec3& towards);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
