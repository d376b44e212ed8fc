// The C++ part of the installed package: plants in the caller's own Bullet world.
#include <btBulletDynamicsCommon.h>
#include <frond/frond_bullet.hpp>

int main() {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
    frond_world plants;
    if (frond::attach(&world, nullptr, &plants) != FROND_OK) return 1;
    world.stepSimulation(btScalar(1.0 / 60));
    frond_world_destroy(plants);
    return 0;
}
