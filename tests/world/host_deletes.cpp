// A host that deletes what Frond has put into its world: all of it, as on a reset, or one object.
#include <cstring>
#include <vector>

#include "frond/frond_bullet.hpp"
#include "frond/frond_robot.hpp"
#include "support/host.hpp"
#include "support/stems.hpp"

namespace {

// Deletes all objects but the host's own two, in the order in which PyBullet does.
void delete_all(Host& host) {
    btDiscreteDynamicsWorld& world = *host.world;
    auto* multi = dynamic_cast<btMultiBodyDynamicsWorld*>(&world);
    std::vector<btMultiBodyConstraint*> constraints;
    for (int i = multi ? multi->getNumMultiBodyConstraints() - 1 : -1; i >= 0; i--) {
        constraints.push_back(multi->getMultiBodyConstraint(i));
        multi->removeMultiBodyConstraint(constraints.back());
    }
    for (int i = world.getNumCollisionObjects() - 1; i >= 0; i--) {
        btCollisionObject* object = world.getCollisionObjectArray()[i];
        if (object == &host.ground || object == &host.ball) continue;
        world.removeCollisionObject(object);
        delete object;
    }
    for (int i = multi ? multi->getNumMultibodies() - 1 : -1; i >= 0; i--) {
        btMultiBody* body = multi->getMultiBody(i);
        multi->removeMultiBody(body);
        delete body;
    }
    for (btMultiBodyConstraint* constraint : constraints) delete constraint;
}

void step(Host& host, int count) {
    for (int i = 0; i < count; i++) host.world->stepSimulation(btScalar(1.0 / 60), 1, btScalar(1.0 / 60));
}

// One of each kind of thing that Frond makes.
struct Garden {
    frond_world world = {};
    frond_model model = {};
    std::vector<frond_plant> plants;
    frond_rigid rigid = {};
    frond_fragment fragment = {};
    frond_robot robot = {};
    frond_bond bond = {};
    frond_grab grab = {};

    explicit Garden(Host& host) {
        EXPECT_EQ(frond::attach(host.world.get(), nullptr, &world), FROND_OK) << frond_last_error();
        model = make_small_model();
        add_plant(0, 0), add_plant(0, 0.04), add_plant(2, 0);
        frond_rigid_def rigid_def = frond_default_rigid_def();
        rigid_def.state.position = {-2, 1, 0};
        EXPECT_EQ(frond_rigid_create(world, &rigid_def, &rigid), FROND_OK);
        EXPECT_EQ(frond_bond_create(plants[0], {0, 1, 0}, rigid, &bond), FROND_OK);
        EXPECT_EQ(frond_grab_create(plants[1], {0, 1, 0}, 1, &grab), FROND_OK);
        EXPECT_EQ(frond_plant_break(plants[2], frond_plant_get_capsule_count(plants[2]) - 1), FROND_OK)
            << frond_last_error();
        EXPECT_EQ(frond_plant_get_fragment(plants[2], 0, &fragment), FROND_OK);
        if (!dynamic_cast<btMultiBodyDynamicsWorld*>(host.world.get())) return;
        frond_robot_def robot_def = frond_default_robot_def();
        robot_def.position = {0, 0, 3};
        EXPECT_EQ(frond_robot_load(world, FROND_SOURCE_DIR "/models/arm/arm.urdf", &robot_def, &robot), FROND_OK)
            << frond_last_error();
    }
    ~Garden() { frond_model_destroy(model); }
    frond_plant add_plant(double x, double z) {
        frond_plant_def def = frond_default_plant_def();
        def.position = {x, 0, z};
        frond_plant plant;
        EXPECT_EQ(frond_plant_create(world, model, &def, &plant), FROND_OK) << frond_last_error();
        plants.push_back(plant);
        return plant;
    }
    bool any_is_valid() const {
        bool valid = frond_rigid_is_valid(rigid) || frond_rigid_is_valid(fragment.rigid) ||
                     frond_robot_is_valid(robot) || frond_bond_is_valid(bond) || frond_grab_is_valid(grab);
        for (const frond_plant plant : plants) valid |= frond_plant_is_valid(plant);
        return valid;
    }
};

}  // namespace

class HostDeletes : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Kinds, HostDeletes, ::testing::Range(0, 6), host_name);

TEST_P(HostDeletes, AllAndPlantsAnew) {
    Host host(GetParam());
    Garden garden(host);
    step(host, 20);
    delete_all(host);
    EXPECT_FALSE(garden.any_is_valid());
    frond_vec3 tip;
    EXPECT_EQ(frond_plant_get_tip(garden.plants[0], &tip), FROND_RESULT_BAD_HANDLE);
    EXPECT_TRUE(std::strstr(frond_last_error(), "the host deleted it")) << frond_last_error();
    EXPECT_EQ(frond_world_get_plant_count(garden.world), 0);
    EXPECT_EQ(host.world->getNumCollisionObjects(), 2);
    step(host, 5);
    const frond_plant plant = garden.add_plant(0, 0);
    step(host, 5);
    EXPECT_TRUE(frond_plant_is_valid(plant));
    EXPECT_EQ(host.world->getNumCollisionObjects(), 3);
    frond_world_destroy(garden.world);
    EXPECT_EQ(host.world->getNumCollisionObjects(), 2);
    step(host, 2);
}

TEST_P(HostDeletes, AllAndItsWorld) {
    Host host(GetParam());
    Garden garden(host);
    step(host, 20);
    delete_all(host);
    host.world->removeRigidBody(&host.ball);
    host.world->removeRigidBody(&host.ground);
    host.world.reset();
    EXPECT_FALSE(garden.any_is_valid());
    EXPECT_EQ(frond::forget(garden.world), FROND_OK) << frond_last_error();
    EXPECT_FALSE(frond_world_is_valid(garden.world));
    EXPECT_EQ(frond::forget(garden.world), FROND_RESULT_BAD_HANDLE);
}

TEST_P(HostDeletes, ItsWorldAlone) {
    Host host(GetParam());
    Garden garden(host);
    step(host, 20);
    EXPECT_EQ(frond::forget(garden.world), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_TRUE(std::strstr(frond_last_error(), "frond_world_destroy")) << frond_last_error();
    EXPECT_TRUE(garden.any_is_valid());
    host.world->removeRigidBody(&host.ball);
    host.world->removeRigidBody(&host.ground);
    if (auto* multi = dynamic_cast<btMultiBodyDynamicsWorld*>(host.world.get()))
        while (multi->getNumMultibodies() > 0) multi->removeMultiBody(multi->getMultiBody(0));
    host.world.reset();
    EXPECT_EQ(frond::forget(garden.world), FROND_OK) << frond_last_error();
    EXPECT_FALSE(garden.any_is_valid());
}

// Of two plants that sleep leaning on each other the other one wakes.
TEST_P(HostDeletes, OneOfTwoPlants) {
    Host host(GetParam());
    frond_world world;
    ASSERT_EQ(frond::attach(host.world.get(), nullptr, &world), FROND_OK);
    const frond_model model = make_small_model(0, FROND_REST_STANDS_AS_MODELLED);
    frond_plant plants[2];
    for (int i = 0; i < 2; i++) {
        frond_plant_def def = frond_default_plant_def();
        def.mechanics = FROND_MECHANICS_ROD;
        def.position = {0.3 * i, 0, 0};
        if (i == 1) def.rotation = {0, 1, 0, 0};
        ASSERT_EQ(frond_plant_create(world, model, &def, &plants[i]), FROND_OK);
    }
    for (int i = 0; i < 1200 && frond_plant_is_awake(plants[1]); i++) step(host, 1);
    ASSERT_FALSE(frond_plant_is_awake(plants[1]));
    ASSERT_GT(frond_plant_get_contact_count(plants[1]), 0);
    btCollisionObject* object = frond::bullet_object(plants[0]);
    host.world->removeCollisionObject(object);
    delete object;
    EXPECT_FALSE(frond_plant_is_valid(plants[0]));
    EXPECT_EQ(frond_plant_get_contact_count(plants[1]), 0);
    step(host, 1);
    EXPECT_TRUE(frond_plant_is_awake(plants[1]));
    step(host, 10);
    EXPECT_EQ(frond_world_get_plant_count(world), 1);
    frond_world_destroy(world);
    frond_model_destroy(model);
}

// A fragment is drawn on where it was; a robot without its base is gone.
TEST_P(HostDeletes, PartsOfThings) {
    Host host(GetParam());
    Garden garden(host);
    step(host, 5);
    const auto take = [&](const void* body) {
        auto* object = static_cast<btCollisionObject*>(const_cast<void*>(body));
        host.world->removeCollisionObject(object);
        delete object;
    };
    take(frond_rigid_get_body(garden.fragment.rigid));
    EXPECT_FALSE(frond_rigid_is_valid(garden.fragment.rigid));
    frond_fragment fragment;
    ASSERT_EQ(frond_plant_get_fragment(garden.plants[2], 0, &fragment), FROND_OK);
    frond_rigid_state before, after;
    ASSERT_EQ(frond_rigid_get_state(fragment.rigid, &before), FROND_OK);
    if (garden.robot.id) {
        frond_robot_link link = {};
        for (int i = 0; !link.body && i < frond_robot_get_link_count(garden.robot); i++)
            frond_robot_get_link(garden.robot, i, &link);
        ASSERT_TRUE(link.body);
        take(link.body);
        EXPECT_FALSE(frond_robot_is_valid(garden.robot));
    }
    step(host, 5);
    ASSERT_EQ(frond_rigid_get_state(fragment.rigid, &after), FROND_OK);
    EXPECT_EQ(before.position.y, after.position.y);
    EXPECT_EQ(frond_plant_reset(garden.plants[2]), FROND_OK);
    EXPECT_EQ(frond_plant_get_fragment_count(garden.plants[2]), 0);
    frond_world_destroy(garden.world);
    EXPECT_EQ(host.world->getNumCollisionObjects(), 2);
    step(host, 2);
}
