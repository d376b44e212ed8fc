// Fast bodies and stems: whatever moves farther in a step than the other is thick still meets it.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "frond/frond_bullet.hpp"
#include "support/bullet_world.hpp"
#include "support/sanitized.hpp"
#include "support/stems.hpp"

namespace sweep_tests {

constexpr double RADIUS = 0.005, HEIGHT = 0.5;  // of the stem, and at which bodies meet it [m]

// A stem of 1 m, and a body that comes from the left.
struct Scene : BulletWorld {
    std::unique_ptr<btCollisionShape> shape;
    std::unique_ptr<btRigidBody> body;
    frond_world plants = {};
    frond_plant plant = {};

    explicit Scene(frond_mechanics mechanics) {
        EXPECT_EQ(frond::attach(&world, nullptr, &plants), FROND_OK) << frond_last_error();
        const frond_stem stem = {-1, {0, 0, 0}, {0, 1, 0}, RADIUS, RADIUS};
        const frond_model model = make_stems(&stem, 1, 1e9);
        frond_plant_def plant_def = frond_default_plant_def();
        plant_def.mechanics = mechanics;
        EXPECT_EQ(frond_plant_create(plants, model, &plant_def, &plant), FROND_OK) << frond_last_error();
        frond_model_destroy(model);
    }
    ~Scene() {
        frond_world_destroy(plants);
        if (body) world.removeRigidBody(body.get());
    }
    void add(btCollisionShape* of, double mass, double x) {
        shape.reset(of);
        btVector3 inertia(0, 0, 0);
        if (mass > 0) shape->calculateLocalInertia(btScalar(mass), inertia);
        body = std::make_unique<btRigidBody>(btScalar(mass), nullptr, shape.get(), inertia);
        if (mass == 0) body->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
        body->setActivationState(DISABLE_DEACTIVATION);
        put(x);
        world.addRigidBody(body.get());
    }
    void put(double x) {
        body->setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(x), btScalar(HEIGHT), 0)));
    }
    // Where the stem's axis is at the body's height; infinite if it is below.
    double stem_at(double y) const {
        std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plant)));
        EXPECT_EQ(frond_plant_get_capsules(plant, capsules.data(), int(capsules.size())), FROND_OK);
        double x = INFINITY;
        for (const frond_capsule& c : capsules) {
            const double share = (y - c.begin.y) / (c.end.y - c.begin.y);
            if (share >= 0 && share <= 1) x = std::min(x, c.begin.x + share * (c.end.x - c.begin.x));
        }
        return x;
    }
};

struct EveryMover : testing::TestWithParam<frond_mechanics> {};
INSTANTIATE_TEST_SUITE_P(Sweep, EveryMover, testing::Values(FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_ROD),
                         [](const auto& info) { return frond_mechanics_name(info.param); });

// A wire of 2 mm, a plate as thin and a wall of 4 cm: the stem stays ahead of them, and where they come slowly it
// touches them. One that comes by more than three times the stem's thickness in a step may be ahead of it for a step.
TEST_P(EveryMover, TakesAStemAlongAtAnySpeed) {
    const double fastest = GetParam() == FROND_MECHANICS_ROD ? 2 : 0.5;  // [m/s]
    for (const double rate : {60.0, 240.0})
        for (const double speed : {0.1, 0.5, 2.0})
            for (const double half : {0.0, 0.001, 0.02}) {
                if (speed > fastest * rate / 60 || (SANITIZED && speed < 0.5)) continue;
                Scene scene(GetParam());
                const double thick = half > 0 ? half : 0.001;
                btCollisionShape* shape = new btCapsuleShapeZ(btScalar(thick), 1);
                if (half > 0) {
                    delete shape;
                    shape = new btBoxShape(btVector3(btScalar(half), btScalar(0.1), btScalar(0.5)));
                }
                double x = -0.05;
                scene.add(shape, 0, x);
                while (x < 0.15) {
                    x += speed / rate;
                    scene.put(x);
                    scene.world.stepSimulation(btScalar(1 / rate), 0);
                    if (speed / rate < 6 * RADIUS || x >= 0.15) {
                        EXPECT_GT(scene.stem_at(HEIGHT), x) << speed << " m/s, 1/" << rate << " s, half " << half;
                    }
                    if (x > 0 && half == 0 && speed < 1) {
                        EXPECT_NEAR(scene.stem_at(HEIGHT), x + thick + RADIUS, 0.003) << speed << " 1/" << rate;
                    }
                }
            }
}

// A ball that a game makes right before a stem, so that its first step takes it through.
TEST_P(EveryMover, IsMetThoughItIsNew) {
    for (const double speed : {8.0, 20.0, 60.0}) {
        Scene scene(GetParam());
        scene.add(new btSphereShape(btScalar(0.02)), 0.005, -0.05);
        scene.body->setLinearVelocity(btVector3(btScalar(speed), 0, 0));
        for (int i = 0; i < 6; i++) {
            scene.world.stepSimulation(btScalar(1.0 / 60), 0);
            const btVector3 place = scene.body->getWorldTransform().getOrigin();
            if (std::abs(double(place.z())) < RADIUS) {
                EXPECT_LT(double(place.x()), scene.stem_at(double(place.y()))) << speed << " " << i;
            }
        }
    }
}

}  // namespace sweep_tests
