// The Bullet world that Frond makes when the host has none: one that takes multi-bodies, so that robots may be in it.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include "frond/frond_bullet.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Members are destroyed from the last to the first.
struct OwnBullet {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btMultiBodyConstraintSolver solver;
    btMultiBodyDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
};

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
