// Returns whether a body is still in a Bullet world, without dereferencing it: its memory may be gone.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

#include "frond/frond_bullet.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

inline bool is_in(const btCollisionWorld& world, const btCollisionObject* object) {
    const btCollisionObjectArray& objects = world.getCollisionObjectArray();
    return objects.findLinearSearch2(const_cast<btCollisionObject*>(object)) >= 0;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
