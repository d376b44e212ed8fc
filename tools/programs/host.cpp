#include "programs/host.hpp"

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorldMt.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include "frond/frond_bullet.hpp"
#include "scenes/scene.hpp"

namespace frond::programs {

struct Host::Parts {
    btSoftBodyRigidBodyCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btMultiBodyConstraintSolver multi_solver;
    btDeformableBodySolver deformable_body_solver;
    btDeformableMultiBodyConstraintSolver deformable_solver;
    btConstraintSolverPoolMt pool{1};
    std::unique_ptr<btDiscreteDynamicsWorld> world;

    std::unique_ptr<btDiscreteDynamicsWorld> make(int kind) {
        switch (kind) {
            case 0:
                return std::make_unique<btDiscreteDynamicsWorld>(&dispatcher, &broadphase, &solver, &configuration);
            case 1:
                return std::make_unique<btDiscreteDynamicsWorldMt>(&dispatcher, &broadphase, &pool, nullptr,
                                                                   &configuration);
            case 2:
                return std::make_unique<btMultiBodyDynamicsWorld>(&dispatcher, &broadphase, &multi_solver,
                                                                  &configuration);
            case 3:
                return std::make_unique<btSoftRigidDynamicsWorld>(&dispatcher, &broadphase, &solver, &configuration);
            case 4:
                return std::make_unique<btSoftMultiBodyDynamicsWorld>(&dispatcher, &broadphase, &multi_solver,
                                                                      &configuration);
            default:
                deformable_solver.setDeformableSolver(&deformable_body_solver);
                return std::make_unique<btDeformableMultiBodyDynamicsWorld>(
                    &dispatcher, &broadphase, &deformable_solver, &configuration, &deformable_body_solver);
        }
    }
};

Host::Host(int kind, const frond_world_def& def, frond_world* out) : parts(std::make_unique<Parts>()) {
    parts->world = parts->make(kind);
    parts->world->setGravity(btVector3(btScalar(def.gravity.x), btScalar(def.gravity.y), btScalar(def.gravity.z)));
    tools::must(frond::attach(parts->world.get(), &def, out));
}

Host::~Host() = default;

void Host::step(double dt) {
    parts->world->stepSimulation(btScalar(dt), 0);
}

std::string host_headers() {
    return "#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorldMt.h>\n"
           "#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>\n"
           "#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>\n"
           "#include <BulletSoftBody/btDeformableBodySolver.h>\n"
           "#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>\n"
           "#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>\n"
           "#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>\n"
           "#include <BulletSoftBody/btSoftMultiBodyDynamicsWorld.h>\n"
           "#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>\n"
           "#include <btBulletDynamicsCommon.h>\n"
           "#include <frond/frond_bullet.hpp>\n";
}

std::string host_lines(int kind) {
    static const char* const SOLVERS[] = {
        "btSequentialImpulseConstraintSolver solver;\n",
        "btConstraintSolverPoolMt solver(1);\n",
        "btMultiBodyConstraintSolver solver;\n",
        "btSequentialImpulseConstraintSolver solver;\n",
        "btMultiBodyConstraintSolver solver;\n",
        "btDeformableBodySolver body_solver;\n    btDeformableMultiBodyConstraintSolver solver;\n"
        "    solver.setDeformableSolver(&body_solver);\n"};
    static const char* const WORLDS[] = {
        "btDiscreteDynamicsWorld host(&dispatcher, &broadphase, &solver, &configuration);",
        "btDiscreteDynamicsWorldMt host(&dispatcher, &broadphase, &solver, nullptr, &configuration);",
        "btMultiBodyDynamicsWorld host(&dispatcher, &broadphase, &solver, &configuration);",
        "btSoftRigidDynamicsWorld host(&dispatcher, &broadphase, &solver, &configuration);",
        "btSoftMultiBodyDynamicsWorld host(&dispatcher, &broadphase, &solver, &configuration);",
        "btDeformableMultiBodyDynamicsWorld host(&dispatcher, &broadphase, &solver, &configuration, &body_solver);"};
    return std::string(
               "    btSoftBodyRigidBodyCollisionConfiguration configuration;\n"
               "    btCollisionDispatcher dispatcher(&configuration);\n"
               "    btDbvtBroadphase broadphase;\n    ") +
           SOLVERS[kind] + "    " + WORLDS[kind] + "\n";
}

}  // namespace frond::programs
