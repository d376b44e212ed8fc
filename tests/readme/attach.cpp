// A host with a Bullet world, to which the README's lines add plants.
#include <btBulletDynamicsCommon.h>

#include <frond/frond_bullet.hpp>

int main() {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
    btDynamicsWorld* my_bullet_world = &world;
    const btScalar dt = btScalar(1.0 / 60);
#include "attach.inc"
    return frond_world_is_valid(plants) || world.getNumCollisionObjects() != 0;
}
