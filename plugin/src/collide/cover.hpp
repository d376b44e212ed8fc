// Cover: a capsule around each piece of a cage. Those of two cages, or of one, that meet say which pieces are looked at
// closer (section 3.3.1 of the paper); a plant near which nothing is costs no more.
#pragma once

#include "collide/capsule.hpp"
#include "collide/collider.hpp"

namespace frond {

// The axis of a piece: where the ends of its capsule of the chain are now [m].
using Axis = std::array<Vec3, 2>;

// A capsule around all nodes of each piece, and so around its tets: the chain's own capsules are fitted to the
// surface, thinner than a blade is wide and than the cage. `axes`: one a piece, in the frame of the places.
std::vector<Capsule> cover_pieces(const Collider& collider, const Vec3* places, const std::vector<Axis>& axes);

struct CoveredBody {
    const Collider* collider;
    const std::vector<Capsule>* capsules;  // of cover_pieces, in a frame that all bodies share
    bool with_itself;
};

// For each body, for each piece, whether its capsule comes nearer than `margin` [m] to one of another body, or of its
// own where it collides with itself and the pieces are not near each other anyhow. Empty for a body that meets nothing:
// CollisionBody::pieces takes it as it is.
std::vector<std::vector<uint8_t>> find_meeting_pieces(const std::vector<CoveredBody>& bodies, double margin);

}  // namespace frond
