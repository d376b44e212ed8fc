// Segment as bodies touch it: a capsule of a plant, or the plate of a blade that replaces it.
#pragma once

#include "world/plant_body.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Returns a segment's radius around its core, a capsule's axis or a plate's rectangle [m].
double radius_of(const PlantBody& body, int capsule);

// The point of a segment's core that is nearest to p, world frame [m].
struct OnCore {
    Vec3 point;
    double along, across;  // place on the core, as in Contact
};
OnCore nearest_on_core(const PlantBody& body, int capsule, const Vec3& p);

// Returns whether a child of the plant's compound is a capsule that a plate replaces in contact.
bool is_covered(const PlantBody& body, int child);
double piece_friction(const PlantBody& body, int capsule);  // [-]
// Returns whether a body would push a plate at its end where the blade continues with the next one. `normal` points
// away from the body.
bool is_between_pieces(const PlantBody& body, int capsule, const Vec3& normal);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
