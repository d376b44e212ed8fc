// Every shape of Bullet, raised from below against a stem that extends sideways, lifts it; a character pushes one
// aside.
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <BulletDynamics/Character/btKinematicCharacterController.h>

#include <iterator>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "frond/frond_bullet.hpp"
#include "support/bullet_world.hpp"
#include "support/stems.hpp"

namespace every_shape_tests {

constexpr double STEM_AT = 0.5, REACH = 0.6, RADIUS = 0.01;  // the stem's height, length and radius [m]

// A stem that grows out of a wall along x, in a host's world without gravity.
struct Scene : BulletWorld {
    frond_world plants = {};
    frond_model model = {};
    frond_plant plant = {};

    explicit Scene(frond_mechanics mechanics) {
        btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher);
        world.setGravity(btVector3(0, 0, 0));
        EXPECT_EQ(frond::attach(&world, nullptr, &plants), FROND_OK) << frond_last_error();
        const frond_stem stem = {-1, {0, STEM_AT, 0}, {REACH, STEM_AT, 0}, RADIUS, RADIUS};
        model = make_stems(&stem, 1, 1e8, FROND_REST_WITHOUT_GRAVITY);
        frond_plant_def plant_def = frond_default_plant_def();
        plant_def.mechanics = mechanics;
        plant_def.root_height = -1;
        EXPECT_EQ(frond_plant_create(plants, model, &plant_def, &plant), FROND_OK) << frond_last_error();
        // The stem is held where it leaves the wall.
        frond_cage_view cage;
        EXPECT_EQ(frond_model_get_cage(model, &cage), FROND_OK);
        for (int i = 0; i < cage.node_count; i++)
            if (cage.nodes[3 * i] < 0.1) {
                EXPECT_EQ(frond_plant_pin(plant, i), FROND_OK);
            }
    }
    ~Scene() {
        frond_world_destroy(plants);
        frond_model_destroy(model);
    }
    double lifted() const {
        frond_vec3 tip = {};
        EXPECT_EQ(frond_plant_get_tip(plant, &tip), FROND_OK);
        return tip.y - (STEM_AT + RADIUS);
    }
    double push(const btCollisionObject& by) const {
        std::vector<frond_contact> contacts(size_t(frond_plant_get_contact_count(plant)));
        EXPECT_EQ(frond_plant_get_contacts(plant, contacts.data(), int(contacts.size())), FROND_OK);
        double sum = 0;
        for (const frond_contact& contact : contacts)
            if (contact.body == &by) sum += contact.impulse.y;
        return sum;
    }
    double steps(int count, const btCollisionObject& by) {
        double sum = 0;
        for (int i = 0; i < count; i++) {
            world.stepSimulation(btScalar(1.0 / 60), 0);
            sum += push(by);
        }
        return sum;
    }
};

// A shape with its top at the origin of its frame, and the objects that it refers to.
struct Shape {
    std::vector<std::unique_ptr<btCollisionShape>> parts;  // the last is the shape itself, which refers to the others
    std::unique_ptr<btTriangleMesh> mesh;
    std::vector<float> heights;
    double top = 0;      // above the frame's origin [m]
    double sloping = 0;  // rotation about z, so that infinite shapes stay clear of where the stem is held [rad]
    ~Shape() {
        while (!parts.empty()) parts.pop_back();
    }
};
constexpr double HALF = 0.15;  // half extent of every shape but planes and terrain [m]

btVector3 vec(double x, double y, double z) {
    return btVector3(btScalar(x), btScalar(y), btScalar(z));
}
template <class T, class... Args>
T& add(Shape& shape, Args&&... args) {
    shape.parts.push_back(std::make_unique<T>(std::forward<Args>(args)...));
    return static_cast<T&>(*shape.parts.back());
}
// Makes a mesh of twelve triangles from the eight corners of a box.
void make_box_mesh(Shape& shape) {
    shape.mesh = std::make_unique<btTriangleMesh>();
    const auto corner = [](int i) { return HALF * vec(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1); };
    const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& q : quads) {
        shape.mesh->addTriangle(corner(q[0]), corner(q[1]), corner(q[2]));
        shape.mesh->addTriangle(corner(q[0]), corner(q[2]), corner(q[3]));
    }
}

struct Kind {
    const char* name;
    void (*make)(Shape&);
};
const Kind KINDS[] = {
    {"plane",
     [](Shape& s) {
         s.sloping = 0.5;
         add<btStaticPlaneShape>(s, vec(0, 1, 0), btScalar(0));
     }},
    {"sphere", [](Shape& s) { add<btSphereShape>(s, btScalar(s.top = HALF)); }},
    {"box", [](Shape& s) { add<btBoxShape>(s, vec(HALF, s.top = HALF, HALF)); }},
    {"capsule",
     [](Shape& s) {
         s.top = 1.5 * HALF;
         add<btCapsuleShape>(s, btScalar(HALF / 2), btScalar(2 * HALF));
     }},
    {"cylinder", [](Shape& s) { add<btCylinderShape>(s, vec(HALF, s.top = HALF, HALF)); }},
    {"cone", [](Shape& s) { add<btConeShape>(s, btScalar(HALF), btScalar(2 * (s.top = HALF))); }},
    {"hull",
     [](Shape& s) {
         s.top = HALF;
         auto& hull = add<btConvexHullShape>(s);
         hull.setMargin(btScalar(0.005));
         for (int i = 0; i < 8; i++) hull.addPoint(HALF * vec(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 0.7 : -0.7));
     }},
    {"compound",
     [](Shape& s) {
         s.top = HALF;
         auto& ball = add<btSphereShape>(s, btScalar(HALF / 2));
         auto& compound = add<btCompoundShape>(s);
         for (const double side : {-1.0, 1.0})
             compound.addChildShape(btTransform(btQuaternion::getIdentity(), vec(side * HALF, HALF / 2, 0)), &ball);
     }},
    {"mesh",
     [](Shape& s) {
         s.top = HALF;
         make_box_mesh(s);
         add<btBvhTriangleMeshShape>(s, s.mesh.get(), true);
     }},
    {"gimpact",
     [](Shape& s) {
         s.top = HALF;
         make_box_mesh(s);
         add<btGImpactMeshShape>(s, s.mesh.get()).updateBound();
     }},
    {"heightfield", [](Shape& s) {
         s.sloping = 0.5;
         s.heights.assign(9 * 9, 0);
         // Bullet's older constructor takes PHY_FLOAT for its own precision.
         const float* heights = s.heights.data();
         auto& field = add<btHeightfieldTerrainShape>(s, 9, 9, heights, btScalar(-1), btScalar(1), 1, false);
         field.setLocalScaling(vec(0.2, 1, 0.2));
     }}};

constexpr frond_mechanics MECHANICS[] = {FROND_MECHANICS_ROD, FROND_MECHANICS_TET_COROTATIONAL};
struct EveryBulletShape : testing::TestWithParam<std::tuple<frond_mechanics, size_t>> {};
INSTANTIATE_TEST_SUITE_P(Contact, EveryBulletShape,
                         testing::Combine(testing::ValuesIn(MECHANICS), testing::Range(size_t(0), std::size(KINDS))),
                         [](const auto& info) {
                             return std::string(frond_mechanics_name(std::get<0>(info.param))) + "_" +
                                    KINDS[std::get<1>(info.param)].name;
                         });

TEST_P(EveryBulletShape, LiftsAStem) {
    constexpr double BELOW = 0.03, UP = 0.15;  // initial distance below the stem, and displacement upwards [m]
    constexpr int STEPS = 90;
    Shape shape;
    KINDS[std::get<1>(GetParam())].make(shape);
    Scene scene(std::get<0>(GetParam()));
    btRigidBody body(0, nullptr, shape.parts.back().get());
    btTransform frame = btTransform::getIdentity();
    frame.setOrigin(vec(0.5, STEM_AT - RADIUS - BELOW - shape.top, 0.001));
    frame.setRotation(btQuaternion(vec(0, 0, 1), btScalar(shape.sloping)));
    body.setWorldTransform(frame);
    body.setInterpolationWorldTransform(frame);
    body.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    body.setActivationState(DISABLE_DEACTIVATION);
    scene.world.addRigidBody(&body);
    double push = 0;
    for (int i = 0; i < STEPS; i++) {
        frame.setOrigin(frame.getOrigin() + vec(0, UP / STEPS, 0));
        body.setWorldTransform(frame);
        push += scene.steps(1, body);
    }
    push += scene.steps(30, body);
    EXPECT_GT(push, 0);
    // The stem is lifted where it is touched, beyond the middle of its length, and its tip more than that.
    EXPECT_GT(scene.lifted(), 0.8 * (UP - BELOW));
    EXPECT_LT(scene.lifted(), 3 * (UP - BELOW));
    scene.world.removeRigidBody(&body);
}

// Bullet's character controller moves a ghost, which has no velocity and lets all bodies pass but stops at them.
struct EveryCharacter : testing::TestWithParam<frond_mechanics> {};
INSTANTIATE_TEST_SUITE_P(Contact, EveryCharacter, testing::ValuesIn(MECHANICS),
                         [](const auto& info) { return std::string(frond_mechanics_name(info.param)); });
TEST_P(EveryCharacter, PushesAStemAside) {
    Scene scene(GetParam());
    btGhostPairCallback pairs;
    scene.broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(&pairs);
    btCapsuleShape shape(btScalar(0.1), btScalar(0.8));
    btPairCachingGhostObject ghost;
    btTransform frame = btTransform::getIdentity();
    frame.setOrigin(vec(0.45, STEM_AT, -0.2));
    ghost.setWorldTransform(frame);
    ghost.setCollisionShape(&shape);
    ghost.setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
    scene.world.addCollisionObject(&ghost, btBroadphaseProxy::CharacterFilter,
                                   btBroadphaseProxy::AllFilter & ~btBroadphaseProxy::CharacterFilter);
    // It walks as controllers that push plants aside do: moved by the game, and not blocked by plants itself.
    double aside = 0;
    for (int i = 0; i < 60; i++) {
        frame.setOrigin(frame.getOrigin() + vec(0, 0, 0.005));
        ghost.setWorldTransform(frame);
        scene.steps(1, ghost);
        frond_capsule capsules[64];
        const int count = frond_plant_get_capsule_count(scene.plant);
        ASSERT_LE(count, 64);
        ASSERT_EQ(frond_plant_get_capsules(scene.plant, capsules, count), FROND_OK);
        for (int c = 0; c < count; c++) aside = std::max(aside, capsules[c].end.z);
    }
    EXPECT_GT(aside, 0.1);
    scene.world.removeCollisionObject(&ghost);
}

}  // namespace every_shape_tests
