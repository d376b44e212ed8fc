// game: a typical small Bullet game: its own world, a walking character, crates with motion states, a debug drawer.
// game_before is the game without plants; game_after is the same game with them: `diff before.cpp after.cpp`.
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletDynamics/Character/btKinematicCharacterController.h>
#include <btBulletDynamicsCommon.h>

#include <cstdio>
#include <memory>
#include <vector>

// Counts what it should draw; a real one draws it.
struct CountingDrawer : btIDebugDraw {
    int lines = 0, mode = DBG_DrawWireframe | DBG_DrawContactPoints;
    void drawLine(const btVector3&, const btVector3&, const btVector3&) override { lines++; }
    void drawContactPoint(const btVector3&, const btVector3&, btScalar, int, const btVector3&) override { lines++; }
    void reportErrorWarning(const char* text) override { std::fprintf(stderr, "%s\n", text); }
    void draw3dText(const btVector3&, const char*) override {}
    void setDebugMode(int wanted) override { mode = wanted; }
    int getDebugMode() const override { return mode; }
};

struct Crate {
    btBoxShape shape{btVector3(btScalar(0.2), btScalar(0.2), btScalar(0.2))};
    btDefaultMotionState motion;
    std::unique_ptr<btRigidBody> body;
};

struct Game {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    btGhostPairCallback ghost_pairs;
    CountingDrawer drawer;
    btStaticPlaneShape ground_shape{btVector3(0, 1, 0), 0};
    btRigidBody ground{0, nullptr, &ground_shape};
    std::vector<std::unique_ptr<Crate>> crates;
    btCapsuleShape walker_shape{btScalar(0.25), btScalar(1.2)};
    btPairCachingGhostObject ghost;
    std::unique_ptr<btKinematicCharacterController> walker;

    Game() {
        world.setGravity(btVector3(0, btScalar(-9.81), 0));
        broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(&ghost_pairs);
        world.setDebugDrawer(&drawer);
        world.addRigidBody(&ground);
        for (int i = 0; i < 3; i++) add_crate(btVector3(2, btScalar(0.2 + 0.41 * i), btScalar(1.5)));
        add_walker(btVector3(-3, btScalar(0.9), 0));
    }
    ~Game() {
        world.removeAction(walker.get());
        world.removeCollisionObject(&ghost);
        for (const auto& crate : crates) world.removeRigidBody(crate->body.get());
        world.removeRigidBody(&ground);
    }
    void add_crate(const btVector3& place) {
        auto crate = std::make_unique<Crate>();
        crate->motion.m_graphicsWorldTrans.setOrigin(place);
        crate->motion.m_startWorldTrans = crate->motion.m_graphicsWorldTrans;
        btVector3 inertia;
        crate->shape.calculateLocalInertia(5, inertia);
        crate->body = std::make_unique<btRigidBody>(5, &crate->motion, &crate->shape, inertia);
        world.addRigidBody(crate->body.get());
        crates.push_back(std::move(crate));
    }
    void add_walker(const btVector3& place) {
        ghost.setWorldTransform(btTransform(btQuaternion::getIdentity(), place));
        ghost.setCollisionShape(&walker_shape);
        ghost.setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
        walker =
            std::make_unique<btKinematicCharacterController>(&ghost, &walker_shape, btScalar(0.3), btVector3(0, 1, 0));
        world.addCollisionObject(&ghost, btBroadphaseProxy::CharacterFilter,
                                 btBroadphaseProxy::StaticFilter | btBroadphaseProxy::DefaultFilter);
        world.addAction(walker.get());
        walker->setWalkDirection(btVector3(btScalar(0.02), 0, 0));
    }
};

int main(int, char** argv) {
    Game game;
    for (int frame = 0; frame < 300; frame++) game.world.stepSimulation(btScalar(1.0 / 60));
    game.world.debugDrawWorld();
    const btVector3 at = game.ghost.getWorldTransform().getOrigin();
    std::printf("%s: the walker came to x = %.2f m, the top crate is %.2f m high, %d lines drawn\n", argv[0],
                double(at.x()), double(game.crates[2]->motion.m_graphicsWorldTrans.getOrigin().y()), game.drawer.lines);
    return at.x() > -2 && game.drawer.lines > 0 ? 0 : 1;
}
