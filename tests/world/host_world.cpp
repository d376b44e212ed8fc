// Plants in a Bullet world owned by the host, of every kind.
#include <BulletSoftBody/btSoftBodyHelpers.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "frond/frond_bullet.hpp"
#include "support/host.hpp"
#include "support/sanitized.hpp"
#include "support/stems.hpp"

class HostWorld : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Kinds, HostWorld, ::testing::Range(0, 6), host_name);

// The host shifts its own bodies: a ball that flies at the plant hits it as it would have.
TEST_P(HostWorld, GoesOnAsItWasAfterItsOriginMoved) {
    std::vector<double> places[2];
    for (const bool moves : {false, true}) {
        Host host(GetParam());
        frond_world plants;
        ASSERT_EQ(frond::attach(host.world.get(), nullptr, &plants), FROND_OK) << frond_last_error();
        const frond_model model = make_small_model();
        const frond_plant_def def = frond_default_plant_def();
        frond_plant plant;
        ASSERT_EQ(frond_plant_create(plants, model, &def, &plant), FROND_OK) << frond_last_error();
        btTransform place = btTransform::getIdentity();
        place.setOrigin(btVector3(btScalar(-0.5), btScalar(0.4), 0));
        host.ball.setCenterOfMassTransform(place);
        host.ball.setLinearVelocity(btVector3(3, 1, 0));
        const auto step = [&](int count) {
            for (int i = 0; i < count; i++) host.world->stepSimulation(btScalar(1.0 / 60), 1, btScalar(1.0 / 60));
        };
        step(5);
        if (moves) {
            ASSERT_EQ(frond_world_shift_origin(plants, {256, 8, -64}), FROND_OK) << frond_last_error();
            for (btRigidBody* body : {&host.ground, &host.ball}) {
                btTransform frame = body->getWorldTransform();
                frame.setOrigin(frame.getOrigin() - btVector3(256, 8, -64));
                body->setCenterOfMassTransform(frame);
            }
        }
        step(25);
        EXPECT_LT(host.ball.getLinearVelocity().x(), 2);  // it hit the plant
        std::vector<double>& x = places[size_t(moves)];
        x.resize(size_t(3 * frond_plant_get_node_count(plant)));
        ASSERT_EQ(frond_plant_get_state(plant, x.data(), nullptr, int(x.size() / 3)), FROND_OK);
        frond_world_destroy(plants);
        frond_model_destroy(model);
    }
    const double way[] = {-256, -8, 64};
    for (size_t i = 0; i < places[0].size(); i++)
        ASSERT_NEAR(places[1][i] - way[i % 3], places[0][i], sizeof(btScalar) == 8 ? 1e-7 : 1e-3) << i;
}

TEST_P(HostWorld, StepsItsPlantsInEachSubstep) {
    Host host(GetParam());
    frond_world plants;
    ASSERT_EQ(frond::attach(host.world.get(), nullptr, &plants), FROND_OK) << frond_last_error();
    const frond_model model = make_small_model();
    frond_plant_def def = frond_default_plant_def();
    def.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;  // falls by g h^2 n (n + 1) / 2
    def.root_height = -1;
    def.effects = FROND_EFFECT_GRAVITY;
    def.position = {0, 5, 0};
    frond_plant plant;
    ASSERT_EQ(frond_plant_create(plants, model, &def, &plant), FROND_OK) << frond_last_error();
    std::vector<double> before(size_t(3 * frond_plant_get_node_count(plant))), after = before;
    frond_plant_get_state(plant, before.data(), nullptr, int(before.size() / 3));
    host.world->stepSimulation(btScalar(4.0 / 120), 10, btScalar(1.0 / 120));
    frond_plant_get_state(plant, after.data(), nullptr, int(after.size() / 3));
    EXPECT_NEAR(after[1] - before[1], -9.81 / 14400 * 4 * 5 / 2, 1e-5);
    frond_report report;
    frond_world_get_report(plants, &report);
    EXPECT_NEAR(report.time, 4.0 / 120, 1e-6);
    EXPECT_EQ(frond_world_step(plants, 0.01), FROND_RESULT_UNSUPPORTED);
    frond_world_destroy(plants);
    frond_model_destroy(model);
}

// Two free stems over a ground plane: one has the plane in its mask, the other does not.
TEST_P(HostWorld, ItsFilterTellsWhatAPlantMeets) {
    Host host(GetParam());
    frond_world plants;
    ASSERT_EQ(frond::attach(host.world.get(), nullptr, &plants), FROND_OK);
    const frond_model model = make_small_model();
    frond_plant_def def = frond_default_plant_def();
    EXPECT_EQ(def.group, 1);
    EXPECT_EQ(def.mask, -1);
    def.root_height = -1;
    frond_vec3 tips[2];
    for (int mask : {-1, ~int(btBroadphaseProxy::StaticFilter)}) {
        const int i = mask == -1 ? 0 : 1;
        def.mask = mask;
        def.position = {-2.0 + i, 0.1, 0};
        frond_plant plant;
        ASSERT_EQ(frond_plant_create(plants, model, &def, &plant), FROND_OK) << frond_last_error();
        for (int k = 0; k < 60; k++) host.world->stepSimulation(btScalar(1.0 / 60), 1, btScalar(1.0 / 60));
        ASSERT_EQ(frond_plant_get_tip(plant, &tips[i]), FROND_OK);
        const btBroadphaseProxy* proxy = frond::bullet_object(plant)->getBroadphaseHandle();
        EXPECT_EQ(proxy->m_collisionFilterGroup, 1);
        EXPECT_EQ(proxy->m_collisionFilterMask, mask);
    }
    EXPECT_GT(tips[0].y, -0.02);
    EXPECT_LT(tips[1].y, -3);
    frond_world_destroy(plants);
    frond_model_destroy(model);
}

TEST_P(HostWorld, ItsRayTestsFindTheCapsulesAndItsBodiesAreUndisturbed) {
    Host alone(GetParam()), host(GetParam());
    frond_world plants;
    ASSERT_EQ(frond::attach(host.world.get(), nullptr, &plants), FROND_OK);
    const frond_model model = make_small_model();
    const frond_plant_def def = frond_default_plant_def();
    frond_plant plant;
    ASSERT_EQ(frond_plant_create(plants, model, &def, &plant), FROND_OK);
    for (int i = 0; i < 60; i++) {
        host.world->stepSimulation(btScalar(1.0 / 60));
        alone.world->stepSimulation(btScalar(1.0 / 60));
    }
    EXPECT_EQ(host.ball.getWorldTransform().getOrigin().y(), alone.ball.getWorldTransform().getOrigin().y());

    const btVector3 from(-2, btScalar(0.15), 0), to(2, btScalar(0.15), 0);
    btCollisionWorld::ClosestRayResultCallback hit(from, to);
    host.world->rayTest(from, to, hit);
    ASSERT_TRUE(hit.hasHit());
    EXPECT_EQ(frond::plant_of(hit.m_collisionObject).id, plant.id);
    EXPECT_EQ(frond::bullet_object(plant), hit.m_collisionObject);
    EXPECT_EQ(frond::plant_of(&host.ball).id, 0u);

    // Removed cleanly: the ray passes, and the host's objects are as before.
    frond_world_destroy(plants);
    btCollisionWorld::ClosestRayResultCallback miss(from, to);
    host.world->rayTest(from, to, miss);
    EXPECT_FALSE(miss.hasHit());
    EXPECT_EQ(host.world->getNumCollisionObjects(), 2);
    for (int i = 0; i < 10; i++) host.world->stepSimulation(btScalar(1.0 / 60));
    frond_model_destroy(model);
}

TEST_P(HostWorld, PlantsComeAndGoAmongBodiesThatTouchThem) {
    Host host(GetParam());
    frond_world plants;
    ASSERT_EQ(frond::attach(host.world.get(), nullptr, &plants), FROND_OK);
    const frond_model model = make_small_model();
    frond_plant_def def = frond_default_plant_def();
    btTransform place = btTransform::getIdentity();
    place.setOrigin(btVector3(0, 1, 0));  // the ball falls through the plants
    host.ball.setWorldTransform(place);
    std::vector<frond_plant> living;
    const int rounds = SANITIZED ? 4 : 16;
    for (int i = 0; i < rounds; i++) {
        def.position.x = 0.025 * i;
        frond_plant plant;
        ASSERT_EQ(frond_plant_create(plants, model, &def, &plant), FROND_OK);
        living.push_back(plant);
        if (i % 2) {
            frond_plant_destroy(living.front());
            living.erase(living.begin());
        }
        host.world->stepSimulation(btScalar(1.0 / 60));
    }
    frond_report report;
    frond_world_get_report(plants, &report);
    EXPECT_EQ(report.plant_count, rounds / 2);
    frond_world_destroy(plants);
    frond_model_destroy(model);
}

TEST_P(HostWorld, APlantSleepsUntilABallHitsIt) {
    Host host(GetParam());
    frond_world plants;
    ASSERT_EQ(frond::attach(host.world.get(), nullptr, &plants), FROND_OK);
    const frond_model model = make_small_model();
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = FROND_MECHANICS_ROD;
    frond_plant plant;
    ASSERT_EQ(frond_plant_create(plants, model, &def, &plant), FROND_OK);
    for (int i = 0; i < 300; i++) host.world->stepSimulation(btScalar(1.0 / 60));
    EXPECT_FALSE(frond_plant_is_awake(plant));
    EXPECT_FALSE(frond::bullet_object(plant)->isActive());

    btTransform place = btTransform::getIdentity();
    place.setOrigin(btVector3(btScalar(0.4), btScalar(0.15), 0));
    host.ball.setWorldTransform(place);
    host.ball.setLinearVelocity(btVector3(-5, 0, 0));
    host.ball.activate(true);
    bool woke = false;
    for (int i = 0; i < 20; i++) {
        host.world->stepSimulation(btScalar(1.0 / 60));
        woke = woke || frond_plant_is_awake(plant);
    }
    EXPECT_TRUE(woke);
    EXPECT_GT(double(host.ball.getLinearVelocity().x()), -4.9);  // the plant pushed back
    frond_world_destroy(plants);
    frond_model_destroy(model);
}

TEST(Attach, IsRefusedTwiceAndAllowedAgainAfterDestroy) {
    Host host(0);
    frond_world first, second;
    ASSERT_EQ(frond::attach(host.world.get(), nullptr, &first), FROND_OK);
    EXPECT_EQ(frond::attach(host.world.get(), nullptr, &second), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(second.id, 0u);
    EXPECT_EQ(frond::attach(nullptr, nullptr, &second), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond::attach(host.world.get(), nullptr, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond::bullet_world(first), host.world.get());
    frond_world_destroy(first);
    EXPECT_EQ(frond::bullet_world(first), nullptr);
    ASSERT_EQ(frond::attach(host.world.get(), nullptr, &second), FROND_OK);
    frond_world_destroy(second);
}

// Such values come from a clock that failed.
TEST(Attach, StepsThatAreNoTimeMoveNoPlant) {
    Host host(0);
    frond_world world = {};
    ASSERT_EQ(frond::attach(host.world.get(), nullptr, &world), FROND_OK);
    host.world->removeRigidBody(&host.ball);
    const frond_model model = make_small_model();
    const frond_plant_def def = frond_default_plant_def();
    frond_plant plant = {};
    ASSERT_EQ(frond_plant_create(world, model, &def, &plant), FROND_OK);
    for (const btScalar length : {btScalar(-1), btScalar(0), btScalar(NAN), btScalar(INFINITY)}) {
        host.world->stepSimulation(length, 0);
        frond_vec3 tip = {};
        frond_surface_view surface = {};
        ASSERT_EQ(frond_plant_get_tip(plant, &tip), FROND_OK);
        ASSERT_EQ(frond_plant_get_surface(plant, &surface), FROND_OK);
        EXPECT_TRUE(std::isfinite(tip.x + tip.y + tip.z)) << length;
        for (int i = 0; i < 3 * surface.vertex_count; i++) ASSERT_TRUE(std::isfinite(surface.positions[i])) << length;
    }
    frond_world_destroy(world);
    frond_model_destroy(model);
}

TEST(Attach, LeavesTheHostsOwnSoftBodiesAlone) {
    double height[2];
    for (int with_plants = 0; with_plants < 2; with_plants++) {
        Host host(3);
        auto* soft_world = static_cast<btSoftRigidDynamicsWorld*>(host.world.get());
        btSoftBody* cloth =
            btSoftBodyHelpers::CreatePatch(soft_world->getWorldInfo(), btVector3(3, 1, 0), btVector3(4, 1, 0),
                                           btVector3(3, 1, 1), btVector3(4, 1, 1), 5, 5, 1 + 2, true);
        soft_world->addSoftBody(cloth);
        frond_world plants = {};
        frond_model model = {};
        if (with_plants) {
            ASSERT_EQ(frond::attach(host.world.get(), nullptr, &plants), FROND_OK);
            model = make_small_model();
            const frond_plant_def def = frond_default_plant_def();
            frond_plant plant;
            ASSERT_EQ(frond_plant_create(plants, model, &def, &plant), FROND_OK);
        }
        for (int i = 0; i < 60; i++) host.world->stepSimulation(btScalar(1.0 / 60));
        height[with_plants] = double(cloth->m_nodes[12].m_x.y());
        frond_world_destroy(plants);
        frond_model_destroy(model);
        soft_world->removeSoftBody(cloth);
        delete cloth;
    }
    EXPECT_EQ(height[0], height[1]);
}

TEST_P(HostWorld, BodiesPushItsPlantsAndBothComeAndGoWhileTheyTouch) {
    Host host(GetParam());
    host.world->setGravity(btVector3(0, 0, 0));
    frond_world plants;
    ASSERT_EQ(frond::attach(host.world.get(), nullptr, &plants), FROND_OK) << frond_last_error();
    const frond_model model = make_small_model(1e8);
    const frond_plant_def def = frond_default_plant_def();
    const auto throw_ball = [&] {
        btTransform place = btTransform::getIdentity();
        place.setOrigin(btVector3(btScalar(-0.12), btScalar(0.5), 0));
        host.ball.setWorldTransform(place);
        host.ball.setInterpolationWorldTransform(place);
        host.ball.setGravity(btVector3(0, 0, 0));
        host.ball.setLinearVelocity(btVector3(1, 0, 0));
        host.ball.activate(true);
    };
    frond_plant plant;
    const auto touches_ball = [&] {
        std::vector<frond_contact> contacts(size_t(frond_plant_get_contact_count(plant)));
        EXPECT_EQ(frond_plant_get_contacts(plant, contacts.data(), int(contacts.size())), FROND_OK);
        return std::any_of(contacts.begin(), contacts.end(),
                           [&](const frond_contact& contact) { return contact.body == &host.ball; });
    };
    for (int round = 0; round < 3; round++) {
        ASSERT_EQ(frond_plant_create(plants, model, &def, &plant), FROND_OK) << frond_last_error();
        throw_ball();
        int touched = 0;
        for (int i = 0; i < 12; i++) {
            host.world->stepSimulation(btScalar(1.0 / 60), 0);
            touched += touches_ball();
        }
        EXPECT_GT(touched, 0) << round;
        EXPECT_LT(double(host.ball.getLinearVelocity().x()), 0.9) << round;
        frond_report report;
        ASSERT_EQ(frond_world_get_report(plants, &report), FROND_OK);
        EXPECT_EQ(report.trouble & FROND_TROUBLE_REWOUND, 0u);
        // One of the two is removed while they touch, and time continues.
        if (round == 1) {
            host.world->removeRigidBody(&host.ball);
            host.world->stepSimulation(btScalar(1.0 / 60), 0);
            EXPECT_FALSE(touches_ball());
            host.world->addRigidBody(&host.ball);
        }
        frond_plant_destroy(plant);
        host.world->stepSimulation(btScalar(1.0 / 60), 0);
    }
    frond_world_destroy(plants);
    frond_model_destroy(model);
}

// A ball in a cup of four arms lies still, and reports no velocity.
TEST_P(HostWorld, ABodyAtRestOnAPlantHasNoVelocity) {
    Host host(GetParam());
    frond_world plants;
    ASSERT_EQ(frond::attach(host.world.get(), nullptr, &plants), FROND_OK) << frond_last_error();
    const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.5, 0}, 0.03, 0.03},
                                {0, {0, 0.5, 0}, {0.15, 0.6, 0}, 0.012, 0.012},
                                {0, {0, 0.5, 0}, {-0.15, 0.6, 0}, 0.012, 0.012},
                                {0, {0, 0.5, 0}, {0, 0.6, 0.15}, 0.012, 0.012},
                                {0, {0, 0.5, 0}, {0, 0.6, -0.15}, 0.012, 0.012}};
    const frond_model model = make_stems(stems, 5, 1e9);
    frond_plant_def plant_def = frond_default_plant_def();
    plant_def.mechanics = FROND_MECHANICS_ROD;
    frond_plant plant;
    ASSERT_EQ(frond_plant_create(plants, model, &plant_def, &plant), FROND_OK) << frond_last_error();
    host.ball.setSleepingThresholds(0, 0);
    btTransform place = btTransform::getIdentity();
    place.setOrigin(btVector3(0, btScalar(0.62), 0));
    host.ball.setWorldTransform(place);
    host.ball.setInterpolationWorldTransform(place);
    // Also in substeps of a longer step, over which Bullet accumulates forces.
    for (int i = 0; i < 150; i++) host.world->stepSimulation(btScalar(1.0 / 30), 2, btScalar(1.0 / 60));
    const btVector3 before = host.ball.getWorldTransform().getOrigin();
    for (int i = 0; i < 10; i++) {
        host.world->stepSimulation(btScalar(1.0 / 30), 2, btScalar(1.0 / 60));
        EXPECT_LT(double(host.ball.getLinearVelocity().length()), 0.001) << i;
    }
    EXPECT_GT(double(before.y()), 0.53);
    EXPECT_LT(double((host.ball.getWorldTransform().getOrigin() - before).length()), 1e-4);
    frond_world_destroy(plants);
    frond_model_destroy(model);
}
