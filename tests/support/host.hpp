// A host with a Bullet world of any of the six kinds.
#pragma once

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
#include <LinearMath/btThreads.h>
#include <btBulletDynamicsCommon.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

// A host with one kind of world, a ground plane and a ball.
struct Host {
    btSoftBodyRigidBodyCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btMultiBodyConstraintSolver multi_solver;
    btDeformableBodySolver deformable_body_solver;
    btDeformableMultiBodyConstraintSolver deformable_solver;
    btConstraintSolverPoolMt pool{1};
    std::unique_ptr<btDiscreteDynamicsWorld> world;
    btStaticPlaneShape plane{btVector3(0, 1, 0), 0};
    btSphereShape sphere{btScalar(0.05)};
    btRigidBody ground{0, nullptr, &plane};
    btRigidBody ball{1, nullptr, &sphere, btVector3(1, 1, 1)};
    bool has_set_scheduler = false;

    explicit Host(int kind) {
        deformable_solver.setDeformableSolver(&deformable_body_solver);
        switch (kind) {
            case 0:
                world = std::make_unique<btDiscreteDynamicsWorld>(&dispatcher, &broadphase, &solver, &configuration);
                break;
            case 1:
                // Where Bullet was built with threads, it steps this world by a scheduler, which the host has to set.
                has_set_scheduler = !btGetTaskScheduler();
                if (has_set_scheduler) btSetTaskScheduler(btGetSequentialTaskScheduler());
                world = std::make_unique<btDiscreteDynamicsWorldMt>(&dispatcher, &broadphase, &pool, nullptr,
                                                                    &configuration);
                break;
            case 2:
                world =
                    std::make_unique<btMultiBodyDynamicsWorld>(&dispatcher, &broadphase, &multi_solver, &configuration);
                break;
            case 3:
                world = std::make_unique<btSoftRigidDynamicsWorld>(&dispatcher, &broadphase, &solver, &configuration);
                break;
            case 4:
                world = std::make_unique<btSoftMultiBodyDynamicsWorld>(&dispatcher, &broadphase, &multi_solver,
                                                                       &configuration);
                break;
            default:
                world = std::make_unique<btDeformableMultiBodyDynamicsWorld>(
                    &dispatcher, &broadphase, &deformable_solver, &configuration, &deformable_body_solver);
        }
        world->setGravity(btVector3(0, btScalar(-9.81), 0));
        world->addRigidBody(&ground);
        btTransform place = btTransform::getIdentity();
        place.setOrigin(btVector3(1, 3, 0));
        ball.setWorldTransform(place);
        world->addRigidBody(&ball);
    }
    ~Host() {
        if (!world) return;
        world->removeRigidBody(&ball);
        world->removeRigidBody(&ground);
        if (has_set_scheduler) btSetTaskScheduler(nullptr);
    }
};

inline std::string host_name(const ::testing::TestParamInfo<int>& info) {
    static const char* const names[] = {"Discrete",  "DiscreteMt",    "MultiBody",
                                        "SoftRigid", "SoftMultiBody", "Deformable"};
    return names[info.param];
}
