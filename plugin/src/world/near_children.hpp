// Near children: those of a plant's capsules and plates that a body of convex hulls may touch in this substep.
//
// Bullet's narrow phase takes every child whose box along the world's axes overlaps the hull's, and passes over all
// vertices of the hull several times for each. Around long parts that lie askew, such as an arm's links and leaves,
// most of such boxes are empty: three quarters of the pairs are too far apart to give contact points. They, and
// capsules that a plate replaces in contact, are taken out of the compound's tree of boxes while Bullet looks at the
// pair.
#pragma once

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <utility>
#include <vector>

#include "frond/frond_bullet.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct PlantBody;
struct PlantShape;

// The compound whose tree lacks nodes now, and the boxes of these; a world has one.
struct LackingShape {
    const PlantShape* shape = nullptr;
    std::vector<std::pair<btDbvtNode*, btDbvtVolume>> nodes;
};

// Takes children that cannot touch `other` out of the plant's tree; call it before Bullet looks at this pair in a step.
// Does nothing for bodies without convex hulls, and if the dispatcher may look at several pairs at once.
void leave_near_children(PlantBody& body, const btCollisionObject& other);
// Puts them back.
void put_back_children(LackingShape& lacking);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
