// Piece: a capsule of a plant, or the flat piece of a blade for which it stands, as bodies touch it.
#pragma once

#include "world/plant_body.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// All of a piece is within that of its core: a capsule's axis, or a flat one's rectangle [m].
double radius_of(const PlantBody& body, int capsule);

// The point of a piece's core that is nearest to p, world frame [m].
struct OnCore {
    Vec3 point;
    double along, across;  // as in Contact
};
OnCore nearest_on_core(const PlantBody& body, int capsule, const Vec3& p);

double piece_friction(const PlantBody& body, int capsule);  // [-]
// Whether a body would push a flat piece against its end, where the blade goes on with the next one. `normal` leads
// away from the body.
bool is_between_pieces(const PlantBody& body, int capsule, const Vec3& normal);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
