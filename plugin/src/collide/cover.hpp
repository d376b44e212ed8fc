// Cover: a capsule around each region of a cage. Regions of two cages, or of one, are tested further where their covers
// meet (section 3.3.1 of the paper); a plant with nothing near it costs no more.
#pragma once

#include "collide/capsule.hpp"
#include "collide/collider.hpp"

namespace frond {

// The axis of a region: the present ends of its capsule of the chain [m].
using Axis = std::array<Vec3, 2>;

// The radius of a cover around nothing.
constexpr double NOTHING = -1;

// Returns a capsule around all nodes of each region, and so around its tets: the chain's own capsules are fitted to the
// surface, narrower than blades and than the cage. `axes`: one per region, in the frame of the places.
std::vector<Capsule> cover_pieces(const Collider& collider, const Vec3* places, const std::vector<Axis>& axes);

struct CoveredBody {
    const Collider* collider;
    const std::vector<Capsule>* capsules;  // from cover_pieces, in a frame that all bodies share
    bool with_itself;
};

// Finds for each region of each body whether its capsule comes nearer than `margin` [m] to one of another body, or of
// its own where it collides with itself and the regions are not near each other anyhow. Empty for a body that meets
// nothing, as in CollisionBody::pieces.
std::vector<std::vector<uint8_t>> find_meeting_pieces(const std::vector<CoveredBody>& bodies, double margin);

}  // namespace frond
