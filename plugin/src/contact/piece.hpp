// Segment as bodies touch it: a capsule of a plant, or the plate of a blade that replaces it.
#pragma once

#include "world/contact.hpp"

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

// Returns whether two segments meet at a chain node.
bool are_joined(const Plant& plant, int capsule, int other);
// Returns the segment on which a point of a body is that was found at this one: past its end, where the stem goes on,
// it is on the next one, whose side it touches. Its round end there is inside the stem and would catch what slides
// along.
int piece_under(const PlantBody& body, int capsule, const Vec3& p);

// Returns whether a point on a segment's round end is inside another segment that meets it there.
bool is_in_joint(const PlantBody& body, int capsule, const Vec3& p);

// Returns whether a child of the plant's compound is a capsule that a plate replaces in contact.
bool is_covered(const PlantBody& body, int child);
// Sets friction and restitution of a body's contact with a segment: multiplied, as in Bullet.
void set_surface_of(Contact& contact);
// Returns whether a body would push a plate at its end where the blade continues with the next one. `normal` points
// away from the body.
bool is_between_pieces(const PlantBody& body, int capsule, const Vec3& normal);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
