// Robots from URDF files: their links move according to their joints, their motors carry them, and the force of plants
// on them agrees with that on the ground under the plants.
#include "frond/frond_robot.hpp"

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <cstring>

#include "support/robot_world.hpp"
#include "support/stems.hpp"
#include "support/urdf.hpp"

extern "C" int frond_robot_from_c(const char* file, double* reached);

namespace robot_tests {

const char* const ARM = FROND_SOURCE_DIR "/models/arm/arm.urdf";

TEST(Robot, HasTheLinksOfItsFile) {
    const RobotWorld arm(ARM);
    ASSERT_EQ(frond_robot_get_link_count(arm.robot), 7);
    frond_robot_link link;
    ASSERT_EQ(frond_robot_get_link(arm.robot, arm.link("forearm"), &link), FROND_OK);
    EXPECT_STREQ(link.name, "forearm");
    EXPECT_STREQ(link.joint_name, "elbow");
    EXPECT_EQ(link.joint, FROND_JOINT_REVOLUTE);
    EXPECT_EQ(link.lower, -2.5);
    EXPECT_EQ(link.max_force, 150);
    EXPECT_EQ(link.mass, 2.5);
    EXPECT_EQ(link.parent, arm.link("lift"));
    EXPECT_NE(link.body, nullptr);
    EXPECT_EQ(frond_robot_find_link(arm.robot, "tail"), -1);
    EXPECT_STREQ(frond_joint_name(FROND_JOINT_PRISMATIC), "prismatic");
    EXPECT_STREQ(frond_joint_name(frond_joint(12)), "?");
    EXPECT_EQ(frond::multi_body(arm.robot)->getNumLinks(), 6);
    EXPECT_NE(frond::joint_motor(arm.robot, 1), nullptr);
    EXPECT_EQ(frond::joint_motor(arm.robot, 0), nullptr);
    double reached = 0;
    EXPECT_EQ(frond_robot_from_c(ARM, &reached), 0);
    EXPECT_NEAR(reached, 1, 0.01);
}

// The file's z is the world's y, and its y the world's -z.
TEST(Robot, HasItsLinksWhereItsJointsPutThem) {
    const RobotWorld arm(ARM, false, {1, 0, 2});
    ASSERT_EQ(frond_robot_set_joint(arm.robot, arm.link("turn"), 0.5), FROND_OK);
    ASSERT_EQ(frond_robot_set_joint(arm.robot, arm.link("lift"), 0.7), FROND_OK);
    ASSERT_EQ(frond_robot_set_joint(arm.robot, arm.link("elbow"), 0.4), FROND_OK);
    const double out = 0.7 * std::sin(0.7) + 0.74 * std::sin(1.1),
                 up = 0.72 + 0.7 * std::cos(0.7) + 0.74 * std::cos(1.1);
    const frond_vec3 palm = arm.state("palm").position;
    EXPECT_NEAR(palm.x, 1 + out * std::cos(0.5), 1e-5);
    EXPECT_NEAR(palm.y, up, 1e-5);
    EXPECT_NEAR(palm.z, 2 - out * std::sin(0.5), 1e-5);
    EXPECT_NEAR(arm.state("elbow").joint_position, 0.4, 1e-6);
}

TEST(Robot, GoesOnAsItWasAfterTheOriginMoved) {
    const RobotWorld here(ARM), there(ARM);
    for (const RobotWorld* arm : {&here, &there}) {
        ASSERT_EQ(frond_robot_drive_to(arm->robot, arm->link("lift"), 1.2, 0.5, 0), FROND_OK);
        arm->step(30);
    }
    const frond_vec3 before = there.state("palm").position;
    ASSERT_EQ(frond_world_shift_origin(there.world, {64, -8, 16}), FROND_OK) << frond_last_error();
    EXPECT_NEAR(there.state("palm").position.x, before.x - 64, 1e-5);
    EXPECT_NEAR(there.state("palm").position.y, before.y + 8, 1e-5);
    for (const RobotWorld* arm : {&here, &there}) arm->step(60);
    EXPECT_NEAR(there.state("palm").position.x, here.state("palm").position.x - 64, 1e-4);
    EXPECT_NEAR(there.state("palm").position.y, here.state("palm").position.y + 8, 1e-4);
    EXPECT_NEAR(there.state("lift").joint_position, here.state("lift").joint_position, 1e-5);
}

TEST(Robot, HasMotorsThatCarryItsWeight) {
    const RobotWorld arm(ARM);
    const double side = 3.14159265358979 / 2;
    ASSERT_EQ(frond_robot_set_joint(arm.robot, arm.link("lift"), side), FROND_OK);
    arm.step(60);
    EXPECT_NEAR(arm.state("lift").joint_position, side, 0.01);
    // Each mass at its lever arm; the fingers' 0.2 kg are 0.12 m beyond the wrist.
    const double moment = 9.81 * (4 * 0.35 + 2.5 * 1.05 + 0.5 * 1.47 + 0.2 * (1.44 + 0.12));
    EXPECT_NEAR(std::abs(arm.state("lift").motor_force), moment, 0.02 * moment);
    EXPECT_NEAR(std::abs(arm.state("turn").motor_force), 0, 0.5);
    // Without its motor the arm falls.
    ASSERT_EQ(frond_robot_release(arm.robot, arm.link("lift")), FROND_OK);
    arm.step(20);
    EXPECT_GT(arm.state("lift").joint_position, side + 0.1);
}

TEST(Robot, IsDrivenToPlacesAndAtSpeeds) {
    const RobotWorld arm(ARM, true);
    ASSERT_EQ(frond_robot_drive_to(arm.robot, arm.link("lift"), 1.2, 0.5, 0), FROND_OK);
    ASSERT_EQ(frond_robot_drive_at(arm.robot, arm.link("turn"), -0.8, 0), FROND_OK);
    ASSERT_EQ(frond_robot_drive_to(arm.robot, arm.link("left"), 0.03, 0, 0), FROND_OK);
    arm.step(60);
    EXPECT_NEAR(arm.state("lift").joint_position, 0.5, 0.05);  // within its speed limit
    EXPECT_NEAR(arm.state("turn").joint_velocity, -0.8, 0.02);
    arm.step(180);
    EXPECT_NEAR(arm.state("lift").joint_position, 1.2, 0.01);
    EXPECT_NEAR(arm.state("turn").joint_position, -0.8 * 4, 0.05);
    EXPECT_NEAR(arm.state("left").joint_position, 0.03, 0.001);
    // A joint limit stops a link that is driven against it.
    ASSERT_EQ(frond_robot_drive_at(arm.robot, arm.link("right"), 0.1, 0), FROND_OK);
    arm.step(120);
    EXPECT_NEAR(arm.state("right").joint_position, 0.04, 0.005);
}

std::string inertial() {
    return "<inertial><mass value=\"2\"/><inertia ixx=\"0.01\" iyy=\"0.01\" izz=\"0.01\" ixy=\"0\" "
           "ixz=\"0\" iyz=\"0\"/></inertial>";
}
std::string floating_box() {
    return urdf_robot(urdf_link("world", "") + urdf_link("box", inertial()) +
                      urdf_joint("world", "box", "0 0 3", "floating"));
}

TEST(Robot, WithAFloatingJointFallsFreely) {
    const UrdfFolder folder;
    const RobotWorld box(folder.write("box.urdf", floating_box()));
    ASSERT_EQ(frond_robot_get_link_count(box.robot), 1);
    EXPECT_NEAR(box.state("box").position.y, 3, 1e-6);
    box.step(30);
    EXPECT_NEAR(box.state("box").position.y, 3 - 0.5 * 9.81 * 0.25, 0.05);
}

TEST(Robot, MovesLinksThatTouchNothing) {
    const UrdfFolder folder;
    const std::string slide = "<axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\" effort=\"200\" velocity=\"2\"/>";
    const RobotWorld rail(
        folder.write("rail.urdf", urdf_robot(urdf_link("rail", "") + urdf_link("slide", inertial()) +
                                             urdf_joint("rail", "slide", "0 0 0", "prismatic", slide))));
    ASSERT_EQ(frond_robot_drive_to(rail.robot, rail.link("slide"), 0.5, 0, 0), FROND_OK);
    rail.step(120);
    EXPECT_NEAR(rail.state("slide").position.y, 0.5, 0.001);
    EXPECT_NEAR(rail.state("slide").motor_force, 2 * 9.81, 0.2);
    frond_robot_link link;
    ASSERT_EQ(frond_robot_get_link(rail.robot, rail.link("slide"), &link), FROND_OK);
    EXPECT_EQ(link.body, nullptr);
}

// The forearm bends a stem and then stays where it is.
struct Pressed : testing::TestWithParam<frond_mechanics> {};
INSTANTIATE_TEST_SUITE_P(Robot, Pressed, testing::Values(FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_ROD),
                         [](const auto& info) { return std::string(frond_mechanics_name(info.param)); });

TEST_P(Pressed, LinksFeelWhatHoldsThePlant) {
    const RobotWorld arm(ARM, false, {-0.6, -0.15, 0});
    const frond_model model = make_small_model(0, FROND_REST_STANDS_AS_MODELLED);
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = GetParam();
    frond_plant plant = {};
    ASSERT_EQ(frond_plant_create(arm.world, model, &def, &plant), FROND_OK) << frond_last_error();
    // The arm is level, 0.45 m high, beside the stem.
    ASSERT_EQ(frond_robot_set_joint(arm.robot, arm.link("turn"), -0.5), FROND_OK);
    ASSERT_EQ(frond_robot_set_joint(arm.robot, arm.link("lift"), 1.7), FROND_OK);
    arm.step(10);
    frond_vec3 weight, held, link;
    ASSERT_EQ(frond_plant_get_root_force(plant, {0, 0, 0}, &weight, nullptr), FROND_OK) << frond_last_error();
    frond_model_info info;
    ASSERT_EQ(frond_model_get_info(model, &info), FROND_OK);
    EXPECT_NEAR(weight.y, 9.81 * info.mass, 0.02 * 9.81 * info.mass);
    EXPECT_NEAR(weight.x, 0, 0.02 * weight.y);

    // The arm turns into the stem.
    ASSERT_EQ(frond_robot_drive_to(arm.robot, arm.link("turn"), 0.15, 0.3, 0), FROND_OK);
    arm.step(300);
    const frond_link_state upper = arm.state("upper_arm"), fore = arm.state("forearm");
    link = {upper.force.x + fore.force.x, upper.force.y + fore.force.y, upper.force.z + fore.force.z};
    EXPECT_GT(upper.contact_count + fore.contact_count, 0);
    EXPECT_GT(length(link), 0.5);
    ASSERT_EQ(frond_plant_get_root_force(plant, {0, 0, 0}, &held, nullptr), FROND_OK);
    // Balance of forces: the ground and the links carry the plant's weight.
    const frond_vec3 rest = {held.x - weight.x - link.x, held.y - weight.y - link.y, held.z - weight.z - link.z};
    EXPECT_LT(length(rest), 0.05 * length(link));
    frond_model_destroy(model);
}

TEST(Robot, MisuseIsToldAndChangesNothing) {
    const RobotWorld arm(ARM);
    frond_robot_def def = frond_default_robot_def();
    frond_robot robot = {5};
    EXPECT_EQ(frond_robot_load(arm.world, "none.urdf", &def, &robot), FROND_RESULT_FILE_NOT_FOUND);
    EXPECT_EQ(robot.id, 0u);
    EXPECT_EQ(frond_robot_load(arm.world, FROND_SOURCE_DIR "/models/corn/corn.obj", &def, &robot),
              FROND_RESULT_FILE_FORMAT);
    EXPECT_EQ(frond_robot_load({}, ARM, &def, &robot), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_robot_load(arm.world, ARM, nullptr, &robot), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_robot_load(arm.world, ARM, &def, nullptr), FROND_RESULT_BAD_ARGUMENT);
    def.rotation = {0, 0, 0, 0};
    EXPECT_EQ(frond_robot_load(arm.world, ARM, &def, &robot), FROND_RESULT_BAD_ARGUMENT);
    def = {};
    EXPECT_EQ(frond_robot_load(arm.world, ARM, &def, &robot), FROND_RESULT_BAD_DEF);
    const int elbow = arm.link("elbow");
    EXPECT_EQ(frond_robot_set_joint(arm.robot, 0, 0), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_robot_set_joint(arm.robot, elbow, 9), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_robot_drive_to(arm.robot, elbow, std::nan(""), 0, 0), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_robot_drive_to(arm.robot, elbow, 0, -1, 0), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_robot_drive_at(arm.robot, 99, 0, 0), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_robot_drive_at(arm.robot, elbow, 0, INFINITY), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_robot_release({}, elbow), FROND_RESULT_BAD_HANDLE);
    frond_robot_link link;
    frond_link_state state;
    EXPECT_EQ(frond_robot_get_link(arm.robot, -1, &link), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_robot_get_link_state(arm.robot, 7, &state), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_robot_get_link_state(arm.robot, 0, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_get_root_force({}, {0, 0, 0}, nullptr, nullptr), FROND_RESULT_BAD_HANDLE);
    frond_bond bond;
    EXPECT_EQ(frond_robot_bond({}, {0, 0, 0}, arm.robot, elbow, &bond), FROND_RESULT_BAD_HANDLE);
    frond_robot_destroy(arm.robot);
    EXPECT_FALSE(frond_robot_is_valid(arm.robot));
    EXPECT_EQ(frond_robot_get_link_count(arm.robot), 0);
    EXPECT_EQ(frond_robot_release(arm.robot, elbow), FROND_RESULT_BAD_HANDLE);
    frond_robot_destroy(arm.robot);
    arm.step(2);
}

TEST(Robot, AsksForAWorldThatTakesMultiBodies) {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld bullet(&dispatcher, &broadphase, &solver, &configuration);
    frond_world world = {};
    ASSERT_EQ(frond::attach(&bullet, nullptr, &world), FROND_OK);
    const frond_robot_def def = frond_default_robot_def();
    frond_robot robot;
    EXPECT_EQ(frond_robot_load(world, ARM, &def, &robot), FROND_RESULT_UNSUPPORTED);
    EXPECT_NE(std::strstr(frond_last_error(), "btMultiBodyDynamicsWorld"), nullptr);
    frond_world_destroy(world);
}

}  // namespace robot_tests
