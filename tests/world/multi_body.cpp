// Links of a multi-body that is thrown through plants: they lose what the plants gain.
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <btBulletDynamicsCommon.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <vector>

#include "frond/frond_bullet.hpp"

namespace multi_body_tests {

constexpr int LINKS = 9;
constexpr double MASS = 3, SPEED = 6, RATE = 240;  // [kg], [m/s], [1/s]

// Calls something at its place among the actions of a Bullet world.
struct Call final : btActionInterface {
    std::function<void()> what;
    void updateAction(btCollisionWorld*, btScalar) override { what(); }
    void debugDraw(btIDebugDraw*) override {}
};

// Nine links of 20 cm in a row, by hinges across and upright in turn.
struct Chain {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btMultiBodyConstraintSolver solver;
    btMultiBodyDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    btBoxShape box{btVector3(btScalar(0.1), btScalar(0.03), btScalar(0.03))};
    btVector3 inertia{0, 0, 0};
    std::unique_ptr<btMultiBody> body;
    std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders;
    frond_world plants = {};
    Call before, after;  // Frond's part of a step
    double energy_before = 0, energy_after = 0;

    Chain() {
        world.setGravity(btVector3(0, 0, 0));
        before.what = [this] { energy_before = energy(); };
        after.what = [this] { energy_after = energy(); };
        world.addAction(&before);
        EXPECT_EQ(frond::attach(&world, nullptr, &plants), FROND_OK) << frond_last_error();
        world.addAction(&after);
        box.calculateLocalInertia(btScalar(MASS), inertia);
        body = std::make_unique<btMultiBody>(LINKS - 1, btScalar(MASS), inertia, false, false);
        const btVector3 half(btScalar(0.1), 0, 0);
        for (int i = 0; i < LINKS - 1; i++)
            body->setupRevolute(i, btScalar(MASS), inertia, i - 1, btQuaternion::getIdentity(),
                                i % 2 ? btVector3(0, 1, 0) : btVector3(0, 0, 1), half, half, true);
        body->finalizeMultiDof();
        body->setLinearDamping(0);
        body->setAngularDamping(0);
        body->setCanSleep(false);
        body->setBasePos(btVector3(btScalar(-0.6), btScalar(0.9), btScalar(-0.8)));
        body->setWorldToBaseRot(btQuaternion(btVector3(0, 1, 0), btScalar(1.2)));
        body->setBaseVel(btVector3(btScalar(SPEED), 0, btScalar(0.3 * SPEED)));
        world.addMultiBody(body.get());
        for (int i = -1; i < LINKS - 1; i++) {
            colliders.push_back(std::make_unique<btMultiBodyLinkCollider>(body.get(), i));
            colliders.back()->setCollisionShape(&box);
            world.addCollisionObject(colliders.back().get(), 2, 1);
            (i < 0 ? body->setBaseCollider(colliders.back().get())
                   : void(body->getLink(i).m_collider = colliders.back().get()));
        }
        btAlignedObjectArray<btQuaternion> turns;
        btAlignedObjectArray<btVector3> places;
        body->forwardKinematics(turns, places);
        body->updateCollisionObjectWorldTransforms(turns, places);
    }
    ~Chain() {
        frond_world_destroy(plants);
        for (const auto& collider : colliders) world.removeCollisionObject(collider.get());
        world.removeMultiBody(body.get());
    }
    // Kinetic energy by the velocities of all links, in their own frames [J].
    double energy() const {
        std::vector<btVector3> turning(LINKS), moving(LINKS);
        body->compTreeLinkVelocities(turning.data(), moving.data());
        double sum = 0;
        for (size_t i = 0; i < LINKS; i++)
            sum += 0.5 * MASS * double(moving[i].length2()) + 0.5 * double(turning[i].dot(turning[i] * inertia));
        return sum;
    }
};

struct MultiBody : testing::TestWithParam<frond_mechanics> {};
INSTANTIATE_TEST_SUITE_P(Mechanics, MultiBody, testing::Values(FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_ROD),
                         [](const auto& info) { return frond_mechanics_name(info.param); });

std::vector<frond_plant> add_plants(const Chain& chain, frond_mechanics mechanics) {
    const frond_model_def def = frond_default_model_def();
    frond_model model = {};
    EXPECT_EQ(frond_model_load(FROND_SOURCE_DIR "/models/corn/corn.obj", &def, &model), FROND_OK) << frond_last_error();
    std::vector<frond_plant> plants;
    for (int i = 0; i < 3; i++) {
        frond_plant_def plant_def = frond_default_plant_def();
        plant_def.mechanics = mechanics;
        plant_def.position = {0.5 * i, 0, 0};
        plants.emplace_back();
        EXPECT_EQ(frond_plant_create(chain.plants, model, &plant_def, &plants.back()), FROND_OK) << frond_last_error();
    }
    frond_model_destroy(model);
    return plants;
}

double energy_of(const std::vector<frond_plant>& plants) {
    double sum = 0;
    for (const frond_plant plant : plants) {
        frond_energy energy = {};
        EXPECT_EQ(frond_plant_get_energy(plant, &energy), FROND_OK);
        sum += energy.kinetic + energy.elastic;
    }
    return sum;
}

// Opposite impulses of contacts passed Bullet's limit of joint speeds one by one, and left at 173 m/s. Bullet's own
// free flight of links that spin gains energy too, in a second more than they began with: so what plants and links have
// together counts before and after Frond's part of a step, and only the half second in the plants.
TEST_P(MultiBody, GainsNoEnergyFromPlants) {
    constexpr double NO_MATTER = 0.05;  // [J]
    Chain chain;
    const std::vector<frond_plant> plants = add_plants(chain, GetParam());
    const double start = chain.energy();
    EXPECT_NEAR(start, 0.5 * LINKS * MASS * SPEED * SPEED * (1 + 0.09), 0.01 * start);
    int contacts = 0;
    double of_plants = energy_of(plants), lost = 0;
    for (int i = 0; i < int(0.5 * RATE); i++) {
        chain.world.stepSimulation(btScalar(1 / RATE), 0);
        frond_report report = {};
        ASSERT_EQ(frond_world_get_report(chain.plants, &report), FROND_OK);
        contacts += report.contact_count;
        const double gained = chain.energy_after - chain.energy_before, now = energy_of(plants);
        ASSERT_LT(gained + now - of_plants, NO_MATTER) << i;
        lost -= gained;
        ASSERT_GT(lost, -0.01 * start) << i;
        of_plants = now;
    }
    EXPECT_GT(contacts, 50);
    EXPECT_GT(lost, 0.5 * start);
}

}  // namespace multi_body_tests
