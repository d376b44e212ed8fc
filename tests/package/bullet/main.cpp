// A body falls in a world of Bullet's; numbers have as many bytes as the argument says.
#include <btBulletDynamicsCommon.h>

#include <cstdlib>

int main(int argument_count, char** arguments) {
    if (argument_count != 2 || int(sizeof(btScalar)) != atoi(arguments[1])) return 1;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
    btSphereShape ball(1);
    btRigidBody body(btRigidBody::btRigidBodyConstructionInfo(1, nullptr, &ball));
    world.addRigidBody(&body);
    world.stepSimulation(btScalar(0.1), 10, btScalar(0.01));
    const bool has_fallen = body.getWorldTransform().getOrigin().y() < btScalar(-0.01);
    world.removeRigidBody(&body);
    return has_fallen ? 0 : 2;
}
