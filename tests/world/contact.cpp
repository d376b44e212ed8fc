// The host's bodies and plants: they push each other, rub, and do not pass through each other.
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <memory>
#include <vector>

#include "frond/frond_bullet.hpp"
#include "support/sanitized.hpp"
#include "support/stems.hpp"

namespace contact_tests {

constexpr btScalar H = btScalar(1.0 / 60);

// A world with one plant, and bodies.
struct Scene {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btMultiBodyConstraintSolver solver;
    btMultiBodyDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    std::vector<std::unique_ptr<btCollisionShape>> shapes;
    std::vector<std::unique_ptr<btRigidBody>> bodies;
    frond_world plants = {};
    frond_plant plant = {};

    explicit Scene(double gravity = -9.81, frond_response response = FROND_RESPONSE_IMPULSE) {
        world.setGravity(btVector3(0, btScalar(gravity), 0));
        frond_world_def def = frond_default_world_def();
        def.response = response;
        EXPECT_EQ(frond::attach(&world, &def, &plants), FROND_OK) << frond_last_error();
    }
    ~Scene() {
        frond_world_destroy(plants);
        for (auto& body : bodies) world.removeRigidBody(body.get());
    }
    btRigidBody& add(btCollisionShape* shape, double mass, const btVector3& place) {
        shapes.emplace_back(shape);
        btVector3 inertia(0, 0, 0);
        if (mass > 0) shape->calculateLocalInertia(btScalar(mass), inertia);
        bodies.push_back(std::make_unique<btRigidBody>(btScalar(mass), nullptr, shape, inertia));
        btTransform frame = btTransform::getIdentity();
        frame.setOrigin(place);
        bodies.back()->setWorldTransform(frame);
        world.addRigidBody(bodies.back().get());
        return *bodies.back();
    }
    void add_stems(const std::vector<frond_stem>& stems, double young, frond_mechanics mechanics,
                   double root_height = 0, double friction = 0.5) {
        frond_model_def def = frond_default_model_def();
        frond_organ_material organ = {"stem", {}};
        ASSERT_EQ(frond_material_preset("stem", &organ.material), FROND_OK);
        organ.material.young = young;
        organ.material.friction = friction;
        def.organs = &organ;
        def.organ_count = 1;
        def.scale = 1;
        def.up = {0, 1, 0};
        frond_model model;
        ASSERT_EQ(frond_model_from_stems(stems.data(), int(stems.size()), &def, &model), FROND_OK)
            << frond_last_error();
        frond_plant_def plant_def = frond_default_plant_def();
        plant_def.mechanics = mechanics;
        plant_def.root_height = root_height;
        ASSERT_EQ(frond_plant_create(plants, model, &plant_def, &plant), FROND_OK) << frond_last_error();
        frond_model_destroy(model);
    }
    void add_stem(const frond_vec3& begin, const frond_vec3& end, double radius, double young,
                  frond_mechanics mechanics, double root_height = 0, double friction = 0.5) {
        add_stems({{-1, begin, end, radius, radius}}, young, mechanics, root_height, friction);
    }
    void steps(int count) {
        for (int i = 0; i < count; i++) world.stepSimulation(H, 0);
    }
    frond_vec3 tip() const {
        frond_vec3 tip = {};
        EXPECT_EQ(frond_plant_get_tip(plant, &tip), FROND_OK);
        return tip;
    }
    frond_report report() const {
        frond_report report = {};
        EXPECT_EQ(frond_world_get_report(plants, &report), FROND_OK);
        return report;
    }
};

struct EveryBody : testing::TestWithParam<frond_mechanics> {};
std::vector<frond_mechanics> mechanics_that_touch() {
    if (SANITIZED) return {FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_ROD};
    return {FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_TET_NEOHOOKEAN, FROND_MECHANICS_ROD};
}
INSTANTIATE_TEST_SUITE_P(Contact, EveryBody, testing::ValuesIn(mechanics_that_touch()), [](const auto& info) {
    return std::string(info.param == FROND_MECHANICS_ROD              ? "rod"
                       : info.param == FROND_MECHANICS_TET_NEOHOOKEAN ? "tet_neohookean"
                                                                      : "tet_corotational");
});

TEST_P(EveryBody, ABallPushesAStemAsideAndIsSlowed) {
    Scene scene(0);
    scene.add_stem({0, 0, 0}, {0, 1, 0}, 0.01, 1e8, GetParam());
    btRigidBody& ball = scene.add(new btSphereShape(btScalar(0.05)), 0.2, btVector3(btScalar(-0.15), btScalar(0.9), 0));
    ball.setLinearVelocity(btVector3(1, 0, 0));
    double farthest = 0, slowest = 1;
    for (int i = 0; i < 60; i++) {
        scene.steps(1);
        farthest = std::max(farthest, scene.tip().x);
        slowest = std::min(slowest, double(ball.getLinearVelocity().x()));
        EXPECT_EQ(scene.report().trouble & FROND_TROUBLE_REWOUND, 0u);
    }
    EXPECT_GT(farthest, 0.05);
    EXPECT_LT(slowest, 0.5);
}

// A ball of 5 cm at 20 m/s against a stem of 1 cm: a light one bounces off, a heavy one loses speed to the stem.
TEST_P(EveryBody, AFastBallDoesNotTunnel) {
    for (const double mass : {0.003, 0.05})
        for (const double offset : {0.05, 0.0, 0.01, 0.13, 0.27}) {
            if (SANITIZED && offset != 0.05) break;
            Scene scene(0);
            scene.add_stem({0, 0, 0}, {0, 1, 0}, 0.005, 1e9, GetParam());
            btRigidBody& ball =
                scene.add(new btSphereShape(btScalar(0.025)), mass, btVector3(btScalar(-1 + offset), btScalar(0.5), 0));
            ball.setLinearVelocity(btVector3(20, 0, 0));
            scene.steps(20);
            EXPECT_LT(double(ball.getLinearVelocity().x()), mass < 0.01 ? 0 : 15) << mass << " " << offset;
            if (mass < 0.01) {
                EXPECT_LT(double(ball.getWorldTransform().getOrigin().x()), 0.1) << offset;
            }
        }
}

TEST_P(EveryBody, AFreeStemAndABallKeepTheirMomentum) {
    Scene scene(0);
    scene.add_stem({0, 0, 0}, {0, 0.5, 0}, 0.02, 1e8, GetParam(), -1);
    ASSERT_EQ(frond_plant_set_effects(scene.plant, FROND_EFFECT_DEFAULT & ~uint32_t(FROND_EFFECT_DAMPING)), FROND_OK);
    btRigidBody& ball = scene.add(new btSphereShape(btScalar(0.05)), 0.3, btVector3(btScalar(-0.2), btScalar(0.4), 0));
    ball.setLinearVelocity(btVector3(2, 0, 0));
    ball.setDamping(0, 0);
    scene.steps(60);
    frond_vec3 momentum = {};
    ASSERT_EQ(frond_plant_get_momentum(scene.plant, &momentum), FROND_OK);
    const btVector3 v = ball.getLinearVelocity();
    EXPECT_LT(double(v.x()), 1.9);
    EXPECT_NEAR(momentum.x + 0.3 * double(v.x()), 0.6, 6e-7);
    EXPECT_NEAR(momentum.y + 0.3 * double(v.y()), 0, 6e-7);
}

// A block on a stiff plank, with a slope a little below or above the limit of friction.
TEST_P(EveryBody, ABlockSlidesWhereFrictionEnds) {
    const double friction = 0.5;  // factor; the block's is 1
    const double limit = std::atan(friction);
    for (const double angle : {0.98 * limit, 1.02 * limit}) {
        Scene scene;
        scene.add_stem({-1, 1, 0}, {1, 1, 0}, 0.05, 1e10, GetParam(), 10, friction);
        btRigidBody& block = scene.add(new btBoxShape(btVector3(btScalar(0.2), btScalar(0.05), btScalar(0.2))), 1,
                                       btVector3(0, btScalar(1.1), 0));
        block.setFriction(1);
        block.setSleepingThresholds(0, 0);
        block.setAngularFactor(btVector3(0, 0, 1));
        // Gravity is tilted, not the plank. The block needs time to lose the velocity gained before friction acted.
        const btVector3 sloping(btScalar(9.81 * std::sin(angle)), btScalar(-9.81 * std::cos(angle)), 0);
        scene.world.setGravity(sloping);
        block.setGravity(sloping);
        scene.steps(150);
        const double before = double(block.getWorldTransform().getOrigin().x());
        scene.steps(60);
        const double moved = double(block.getWorldTransform().getOrigin().x()) - before;
        if (angle < limit) {
            EXPECT_LT(moved, 1e-4) << angle;
        } else {
            EXPECT_GT(moved, 0.1) << angle;
        }
    }
}

// A box is dropped onto four arms of a post.
TEST_P(EveryBody, ABoxComesToRestOnBranchesAndStays) {
    Scene scene;
    scene.add_stems({{-1, {0, 0, 0}, {0, 0.5, 0}, 0.03, 0.03},
                     {0, {0, 0.5, 0}, {0.3, 0.6, 0.05}, 0.012, 0.008},
                     {0, {0, 0.5, 0}, {-0.3, 0.6, -0.05}, 0.012, 0.008},
                     {0, {0, 0.5, 0}, {-0.05, 0.6, 0.3}, 0.012, 0.008},
                     {0, {0, 0.5, 0}, {0.05, 0.6, -0.3}, 0.012, 0.008}},
                    1e9, GetParam());
    btRigidBody& box = scene.add(new btBoxShape(btVector3(btScalar(0.2), btScalar(0.05), btScalar(0.2))), 0.3,
                                 btVector3(0, btScalar(0.75), 0));
    box.setSleepingThresholds(0, 0);
    scene.steps(360);
    const btVector3 before = box.getWorldTransform().getOrigin();
    btVector3 last = before;
    for (int i = 0; i < 60; i++) {
        scene.steps(1);
        const btVector3 now = box.getWorldTransform().getOrigin();
        EXPECT_LT(double((now - last).length()) / double(H), 0.001) << i;  // no jitter above 1 mm/s
        EXPECT_LT(double(box.getLinearVelocity().length()), 0.001) << i;
        last = now;
    }
    EXPECT_NEAR(double(last.y()), 0.62, 0.05);
    EXPECT_LT(double((last - before).length()), 0.002);
}

// A kinematic box that moves through a stem takes it along and is not affected.
TEST_P(EveryBody, AKinematicBoxTakesAStemAlong) {
    Scene scene(0);
    scene.add_stem({0, 0, 0}, {0, 1, 0}, 0.01, 1e8, GetParam());
    btRigidBody& box = scene.add(new btBoxShape(btVector3(btScalar(0.05), btScalar(0.05), btScalar(0.2))), 0,
                                 btVector3(btScalar(-0.1), btScalar(0.9), 0));
    box.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    box.setActivationState(DISABLE_DEACTIVATION);
    for (int i = 0; i < 60; i++) {
        btTransform frame = box.getWorldTransform();
        frame.setOrigin(frame.getOrigin() + btVector3(btScalar(0.005), 0, 0));
        box.setWorldTransform(frame);
        scene.steps(1);
    }
    EXPECT_GT(scene.tip().x, 0.2);
    EXPECT_NEAR(double(box.getWorldTransform().getOrigin().x()), 0.2, 1e-5);
}

// A rising floor, a plane or a slab, passes through the held foot: it cannot lift the plant, and does not stretch it.
TEST_P(EveryBody, AFloorDrivenThroughAHeldFootDoesNotStretchThePlant) {
    for (const bool is_plane : {true, false}) {
        Scene scene;
        scene.add_stems({{-1, {0, 0, 0}, {0, 0.8, 0}, 0.015, 0.01}, {0, {0, 0.4, 0}, {0.3, 0.6, 0}, 0.006, 0.004}}, 1e8,
                        GetParam());
        btCollisionShape* shape = new btBoxShape(btVector3(1, btScalar(0.1), 1));
        if (is_plane) {
            delete shape;
            shape = new btStaticPlaneShape(btVector3(0, 1, 0), 0);
        }
        btRigidBody& floor = scene.add(shape, 0, btVector3(0, btScalar(is_plane ? -0.05 : -0.15), 0));
        floor.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
        floor.setActivationState(DISABLE_DEACTIVATION);
        double highest = 0;
        for (int i = 0; i < 120; i++) {
            btTransform frame = floor.getWorldTransform();
            frame.setOrigin(frame.getOrigin() + btVector3(0, btScalar(0.005), 0));
            floor.setWorldTransform(frame);
            scene.steps(1);
            highest = std::max(highest, scene.tip().y);
            EXPECT_EQ(scene.report().trouble & FROND_TROUBLE_REWOUND, 0u) << i;
        }
        EXPECT_LT(highest, 0.85) << is_plane;  // it was 0.8 m high
    }
}

// A branch that would hang below the ground lies on it.
TEST_P(EveryBody, WhatHangsDownLiesOnAPlane) {
    for (const bool has_plane : {false, true}) {
        Scene scene;
        scene.add_stems({{-1, {0, 0, 0}, {0, 0.3, 0}, 0.02, 0.02}, {0, {0, 0.3, 0}, {0.6, 0.3, 0}, 0.01, 0.01}}, 1e7,
                        GetParam());
        // Its tip is pulled down and sideways, later to the other side.
        const int count = frond_plant_get_node_count(scene.plant);
        std::vector<double> x(3 * size_t(count));
        ASSERT_EQ(frond_plant_get_state(scene.plant, x.data(), nullptr, count), FROND_OK);
        int tip = 0;
        for (int i = 0; i < count; i++)
            if (x[3 * size_t(i)] > x[3 * size_t(tip)]) tip = i;
        if (has_plane) scene.add(new btStaticPlaneShape(btVector3(0, 1, 0), 0), 0, btVector3(0, 0, 0));
        double lowest = 1;
        for (int i = 0; i < 90; i++) {
            ASSERT_EQ(frond_plant_add_force(scene.plant, tip, {0, -0.8, i < 45 ? 0.1 : -0.1}), FROND_OK);
            scene.steps(1);
            std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(scene.plant)));
            ASSERT_EQ(frond_plant_get_capsules(scene.plant, capsules.data(), int(capsules.size())), FROND_OK);
            for (const frond_capsule& c : capsules)
                if (c.begin.y > 0.05 || c.end.x > 0.1) lowest = std::min(lowest, c.end.y - c.radius);
            EXPECT_EQ(scene.report().trouble & FROND_TROUBLE_REWOUND, 0u) << i;
        }
        if (has_plane)
            EXPECT_GT(lowest, -0.01);  // does not sink in up to its axis
        else
            EXPECT_LT(lowest, -0.02) << "the plane would have nothing to hold";
    }
}

// Bullet's narrow phase skips pairs of planes and plants in a step; its contact tests, which hosts call, do not.
TEST(ContactWithPlanes, IsFoundByContactTestsButMakesNoManifolds) {
    Scene scene;
    scene.add_stem({0, 0, 0}, {0, 1, 0}, 0.01, 1e8, FROND_MECHANICS_ROD);
    btRigidBody& plane = scene.add(new btStaticPlaneShape(btVector3(0, 1, 0), 0), 0, btVector3(0, 0, 0));
    scene.steps(3);
    EXPECT_EQ(scene.dispatcher.getNumManifolds(), 0);
    struct Count : btCollisionWorld::ContactResultCallback {
        int points = 0;
        btScalar addSingleResult(btManifoldPoint&, const btCollisionObjectWrapper*, int, int,
                                 const btCollisionObjectWrapper*, int, int) override {
            points++;
            return 0;
        }
    } pair, all;
    for (int i = 0; i < scene.world.getNumCollisionObjects(); i++) {
        btCollisionObject* object = scene.world.getCollisionObjectArray()[i];
        if (object != &plane) scene.world.contactPairTest(object, &plane, pair);
    }
    EXPECT_GT(pair.points, 0);
    scene.world.contactTest(&plane, all);
    EXPECT_GT(all.points, 0);
}

// A host may let plants pass through its ground.
TEST(ContactWithPlanes, IsNotWhereTheHostLetsThePlantThrough) {
    for (const bool let_through : {false, true}) {
        Scene scene;
        scene.add_stem({0, 0.5, 0}, {0.6, 0.5, 0}, 0.01, 1e8, FROND_MECHANICS_ROD, -1);
        btRigidBody& plane = scene.add(new btStaticPlaneShape(btVector3(0, 1, 0), 0), 0, btVector3(0, 0, 0));
        for (int i = 0; i < scene.world.getNumCollisionObjects(); i++) {
            btCollisionObject* object = scene.world.getCollisionObjectArray()[i];
            if (object != &plane && let_through) object->setIgnoreCollisionCheck(&plane, true);
        }
        scene.steps(60);
        if (let_through)
            EXPECT_LT(scene.tip().y, -1);
        else
            EXPECT_GT(scene.tip().y, 0);
    }
}

TEST(ContactEffects, OffMeansThatNothingTouches) {
    Scene scene(0);
    scene.add_stem({0, 0, 0}, {0, 1, 0}, 0.01, 1e8, FROND_MECHANICS_ROD);
    btRigidBody& ball = scene.add(new btSphereShape(btScalar(0.05)), 0.2, btVector3(btScalar(-0.15), btScalar(0.9), 0));
    ball.setLinearVelocity(btVector3(2, 0, 0));
    ASSERT_EQ(frond_plant_set_effects(scene.plant, FROND_EFFECT_DEFAULT & ~uint32_t(FROND_EFFECT_RIGID_CONTACT)),
              FROND_OK);
    scene.steps(60);
    EXPECT_NEAR(double(ball.getLinearVelocity().x()), 2, 1e-6);
    EXPECT_LT(scene.tip().x, 0.01);
}

// Contacts that do not push are no reason to step a plant in another way, nor to leave out a check of its step.
TEST_P(EveryBody, ThatOnlyReportsContactsStepsAsWithoutThem) {
    const auto tip = [](bool on_ground) {
        Scene scene(-9.81, FROND_RESPONSE_NONE);
        scene.add_stem({0, 0, 0}, {0, 0.1, 0}, 0.002, 1e8, GetParam());
        if (on_ground) scene.add(new btStaticPlaneShape(btVector3(0, 1, 0), 0), 0, btVector3(0, 0, 0));
        scene.steps(1);
        EXPECT_EQ(scene.report().contact_count > 0, on_ground);
        const int count = frond_plant_get_node_count(scene.plant);
        std::vector<double> x(3 * size_t(count)), v(3 * size_t(count));
        EXPECT_EQ(frond_plant_get_state(scene.plant, x.data(), v.data(), count), FROND_OK);
        for (int i = 0; i < count; i++) v[3 * size_t(i)] += 40 * x[3 * size_t(i) + 1];
        EXPECT_EQ(frond_plant_set_state(scene.plant, nullptr, v.data(), count), FROND_OK);
        scene.steps(3);
        return scene.tip();
    };
    const frond_vec3 with = tip(true), without = tip(false);
    EXPECT_EQ(with.x, without.x);
    EXPECT_EQ(with.y, without.y);
    EXPECT_EQ(with.z, without.z);
}

TEST(ContactEffects, OneWayPushesThePlantOnly) {
    Scene scene(0);
    scene.add_stem({0, 0, 0}, {0, 1, 0}, 0.01, 1e8, FROND_MECHANICS_ROD);
    btRigidBody& ball = scene.add(new btSphereShape(btScalar(0.05)), 0.2, btVector3(btScalar(-0.15), btScalar(0.9), 0));
    ball.setLinearVelocity(btVector3(2, 0, 0));
    ASSERT_EQ(frond_plant_set_effects(scene.plant, FROND_EFFECT_DEFAULT & ~uint32_t(FROND_EFFECT_TWO_WAY)), FROND_OK);
    scene.steps(15);
    EXPECT_NEAR(double(ball.getLinearVelocity().x()), 2, 1e-6);
    EXPECT_GT(scene.tip().x, 0.05);
}

// A robot's link that swings into a stem is held back, and the impulse is reported.
TEST_P(EveryBody, IsFeltByALinkOfAMultiBody) {
    const auto swing = [](bool with_plant, double& impulse) {
        Scene scene(0);
        if (with_plant) scene.add_stem({0, 0, 0}, {0, 1, 0}, 0.01, 1e9, GetParam());
        btBoxShape shape(btVector3(btScalar(0.2), btScalar(0.02), btScalar(0.02)));
        btMultiBody arm(1, 0, btVector3(0, 0, 0), true, false);
        arm.setBasePos(btVector3(btScalar(-0.5), btScalar(0.8), btScalar(-0.2)));
        arm.setupRevolute(0, 1, btVector3(btScalar(0.01), btScalar(0.02), btScalar(0.02)), -1,
                          btQuaternion::getIdentity(), btVector3(0, 1, 0), btVector3(0, 0, 0),
                          btVector3(btScalar(0.4), 0, 0), true);
        arm.finalizeMultiDof();
        arm.setLinearDamping(0);
        arm.setAngularDamping(0);
        scene.world.addMultiBody(&arm);
        btMultiBodyLinkCollider collider(&arm, 0);
        collider.setCollisionShape(&shape);
        scene.world.addCollisionObject(&collider);
        arm.getLink(0).m_collider = &collider;
        arm.setJointVel(0, btScalar(-2));
        impulse = 0;
        for (int i = 0; i < 30; i++) {
            scene.steps(1);
            if (!with_plant) continue;
            std::vector<frond_contact> contacts(size_t(frond_plant_get_contact_count(scene.plant)));
            EXPECT_EQ(frond_plant_get_contacts(scene.plant, contacts.data(), int(contacts.size())), FROND_OK);
            for (const frond_contact& contact : contacts) {
                EXPECT_EQ(contact.body, &collider);
                impulse += contact.impulse.z;
            }
        }
        const double speed = double(arm.getJointVel(0));
        scene.world.removeCollisionObject(&collider);
        scene.world.removeMultiBody(&arm);
        return speed;
    };
    double impulse = 0;
    EXPECT_NEAR(swing(false, impulse), -2, 0.01);
    EXPECT_GT(swing(true, impulse), -1.5);
    EXPECT_GT(impulse, 0.1);
}

}  // namespace contact_tests
