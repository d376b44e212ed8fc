// Bullet looks only at those of a plant's children that a body of hulls can touch: contacts are the same as without
// that.
#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "frond/frond_bullet.hpp"
#include "support/host.hpp"

namespace {

// A dispatcher of the host's own kind, of which Frond cannot know whether it looks at several pairs at once.
struct OtherDispatcher : btCollisionDispatcher {
    using btCollisionDispatcher::btCollisionDispatcher;
};

struct Touch {
    int capsule;
    frond_vec3 point, normal;
    double gap, impulse;
};

// A bar of eight corners, two of which lie askew to each other as a compound, as an arm's links are.
struct Bars {
    btConvexHullShape hulls[2];
    btCompoundShape shape;
    Bars() {
        for (int i = 0; i < 2; i++) {
            for (int corner = 0; corner < 8; corner++)
                hulls[i].addPoint(btVector3(btScalar(corner & 1 ? 0.5 : -0.5), btScalar(corner & 2 ? 0.03 : -0.03),
                                            btScalar(corner & 4 ? 0.03 : -0.03)));
            hulls[i].setMargin(btScalar(0.001));
            const btQuaternion turn(btVector3(0, 1, 1).normalized(), btScalar(i == 0 ? 0.7 : -0.5));
            shape.addChildShape(btTransform(turn, btVector3(0, btScalar(0.1 * i), 0)), &hulls[i]);
        }
    }
};

template <class Dispatcher>
std::vector<std::vector<Touch>> sweep_through_corn(frond_model corn) {
    btDefaultCollisionConfiguration configuration;
    Dispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
    world.setGravity(btVector3(0, btScalar(-9.81), 0));
    frond_world plants;
    EXPECT_EQ(frond::attach(&world, nullptr, &plants), FROND_OK) << frond_last_error();
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = FROND_MECHANICS_ROD;
    frond_plant plant;
    EXPECT_EQ(frond_plant_create(plants, corn, &def, &plant), FROND_OK) << frond_last_error();
    Bars bars;
    btRigidBody body(0, nullptr, &bars.shape);
    body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    body.setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(&body);
    std::vector<std::vector<Touch>> found;
    for (int i = 0; i < 120; i++) {
        const btQuaternion turn(btVector3(0, 1, 0), btScalar(0.01 * i));
        body.setWorldTransform(btTransform(turn, btVector3(btScalar(-0.6 + 0.008 * i), btScalar(0.9), 0)));
        world.stepSimulation(btScalar(1.0 / 120), 1, btScalar(1.0 / 120));
        std::vector<frond_contact> contacts(size_t(frond_plant_get_contact_count(plant)));
        EXPECT_EQ(frond_plant_get_contacts(plant, contacts.data(), int(contacts.size())), FROND_OK);
        std::vector<Touch> touches;
        for (const frond_contact& c : contacts)
            touches.push_back({c.capsule, c.point, c.normal, c.gap, std::hypot(c.impulse.x, c.impulse.y, c.impulse.z)});
        std::sort(touches.begin(), touches.end(), [](const Touch& a, const Touch& b) {
            return std::tie(a.capsule, a.gap, a.point.x) < std::tie(b.capsule, b.gap, b.point.x);
        });
        found.push_back(touches);
        // A ray between steps meets the whole plant.
        std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plant)));
        EXPECT_EQ(frond_plant_get_capsules(plant, capsules.data(), int(capsules.size())), FROND_OK);
        const frond_capsule& lowest = capsules[0];
        const btVector3 aim(btScalar(0.5 * (lowest.begin.x + lowest.end.x)),
                            btScalar(0.5 * (lowest.begin.y + lowest.end.y)),
                            btScalar(0.5 * (lowest.begin.z + lowest.end.z)));
        btCollisionWorld::ClosestRayResultCallback ray(aim - btVector3(2, 0, 0), aim + btVector3(2, 0, 0));
        ray.m_collisionFilterMask = -1;
        world.rayTest(ray.m_rayFromWorld, ray.m_rayToWorld, ray);
        EXPECT_TRUE(ray.hasHit()) << i;
    }
    world.removeRigidBody(&body);
    frond_world_destroy(plants);
    return found;
}

}  // namespace

TEST(NearChildren, GiveTheContactsOfAll) {
    const frond_model_def def = frond_default_model_def();
    frond_model corn;
    ASSERT_EQ(frond_model_load(FROND_SOURCE_DIR "/models/corn/corn.obj", &def, &corn), FROND_OK) << frond_last_error();
    const auto all = sweep_through_corn<OtherDispatcher>(corn), near = sweep_through_corn<btCollisionDispatcher>(corn);
    size_t count = 0;
    double pushed = 0;
    for (size_t i = 0; i < all.size(); i++) {
        ASSERT_EQ(near[i].size(), all[i].size()) << i;
        for (size_t k = 0; k < all[i].size(); k++) {
            EXPECT_EQ(near[i][k].capsule, all[i][k].capsule) << i;
            // Contacts come in another order, so that sums are rounded otherwise.
            EXPECT_NEAR(near[i][k].gap, all[i][k].gap, 1e-4) << i;
            EXPECT_NEAR(near[i][k].point.x, all[i][k].point.x, 1e-4) << i;
            EXPECT_NEAR(near[i][k].impulse, all[i][k].impulse, 0.002) << i;
            pushed += all[i][k].impulse;
        }
        count += all[i].size();
    }
    EXPECT_GT(count, 300u);
    EXPECT_GT(pushed, 0.5);
    frond_model_destroy(corn);
}
