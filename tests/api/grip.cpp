// Robots press plants with the force of their motors, neither more nor less, and do not sink into them.
#include <Eigen/Geometry>
#include <cmath>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "support/robot_world.hpp"
#include "support/stems.hpp"
#include "support/urdf.hpp"

namespace grip_tests {

using Vec = Eigen::Vector3d;

Vec vec(const frond_vec3& v) {
    return {v.x, v.y, v.z};
}

// Two fingers that slide towards each other from 8 cm apart, each of that mass and force.
std::string gripper(double mass, double force) {
    const auto number = [](double value) { return std::to_string(value); };
    const auto body = [&](double kg) {
        return "<inertial><mass value=\"" + number(kg) +
               "\"/><inertia ixx=\"1e-4\" ixy=\"0\" ixz=\"0\" iyy=\"1e-4\" iyz=\"0\" izz=\"1e-4\"/></inertial>";
    };
    const auto finger = [&](const char* name) {
        return urdf_link(name,
                         body(mass) + "<collision><geometry><box size=\"0.02 0.06 0.1\"/></geometry></collision>");
    };
    const auto slide = [&](const char* name, const char* child, double side) {
        return "<joint name=\"" + std::string(name) + "\" type=\"prismatic\"><parent link=\"palm\"/><child link=\"" +
               child + "\"/><origin xyz=\"" + number(0.04 * side) + " 0 0\"/><axis xyz=\"" + number(-side) +
               " 0 0\"/><limit lower=\"0\" upper=\"0.039\" effort=\"" + number(force) + "\" velocity=\"0.2\"/></joint>";
    };
    return urdf_robot(urdf_link("palm", body(1)) + finger("left_finger") + finger("right_finger") +
                      slide("left", "left_finger", -1) + slide("right", "right_finger", 1));
}

// A fruit of 0.3 kg, 4 cm thick, that nothing holds.
frond_model make_fruit() {
    const frond_stem stem = {-1, {0, 0, 0}, {0, 0.25, 0}, 0.02, 0.02};
    frond_material material;
    EXPECT_EQ(frond_material_preset("fruit", &material), FROND_OK);
    material.density = 0.3 / (M_PI * 0.02 * 0.02 * 0.25);
    return make_stems_of(&stem, 1, &material, FROND_REST_WITHOUT_GRAVITY);
}

// Two fingers that close on a fruit between them.
struct Hand {
    UrdfFolder folder;
    RobotWorld robot;
    frond_model model = make_fruit();
    frond_plant fruit = {};
    Hand(frond_mechanics mechanics, double mass, double force)
        : robot(folder.write("gripper.urdf", gripper(mass, force)), false, {0, 0.5, 0}) {
        frond_plant_def def = frond_default_plant_def();
        def.mechanics = mechanics;
        def.root_height = -1;
        def.position = {0, 0.375, 0};
        EXPECT_EQ(frond_plant_create(robot.world, model, &def, &fruit), FROND_OK) << frond_last_error();
        for (const char* finger : {"left_finger", "right_finger"})
            EXPECT_EQ(frond_robot_drive_at(robot.robot, robot.link(finger), 0.2, 0), FROND_OK);
    }
    ~Hand() { frond_model_destroy(model); }
};

struct Grip {
    frond_mechanics mechanics;
    double step, mass, force;  // [s]; of a finger [kg], [N]
};
std::ostream& operator<<(std::ostream& out, const Grip& grip) {
    return out << frond_mechanics_name(grip.mechanics) << ", " << grip.step << " s, " << grip.mass << " kg, "
               << grip.force << " N";
}
struct Gripper : testing::TestWithParam<Grip> {};
INSTANTIATE_TEST_SUITE_P(Robot, Gripper,
                         testing::Values(Grip{FROND_MECHANICS_ROD, 1.0 / 60, 0.05, 20},
                                         Grip{FROND_MECHANICS_TET_COROTATIONAL, 1.0 / 60, 0.05, 20},
                                         Grip{FROND_MECHANICS_ROD, 1.0 / 240, 0.05, 20},
                                         Grip{FROND_MECHANICS_ROD, 1.0 / 30, 0.05, 20},
                                         Grip{FROND_MECHANICS_ROD, 1.0 / 60, 0.5, 10},
                                         Grip{FROND_MECHANICS_ROD, 1.0 / 60, 0.02, 8}));

// Fingers of a tenth of its weight or less close on a fruit as it falls, with forces of up to a hundred of their own
// weights. They sink into it by less than a millimetre and press it with the force of their motors.
TEST_P(Gripper, HoldsAFruit) {
    const Grip& grip = GetParam();
    const Hand held_by(grip.mechanics, grip.mass, grip.force);
    const RobotWorld& hand = held_by.robot;
    const frond_plant fruit = held_by.fruit;
    std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(fruit)));
    const auto lower_end = [&] {
        EXPECT_EQ(frond_plant_get_capsules(fruit, capsules.data(), int(capsules.size())), FROND_OK);
        return capsules[0].begin;
    };
    frond_vec3 caught = {};
    const int second = int(1 / grip.step + 0.5);
    for (int i = 0; i < 5 * second; i++) {
        ASSERT_EQ(frond_world_step(hand.world, grip.step), FROND_OK);
        if (i < 2 * second) {
            caught = lower_end();
            continue;
        }
        const frond_link_state left = hand.state("left_finger"), right = hand.state("right_finger");
        ASSERT_NEAR(left.force.x, -grip.force, 0.02 * grip.force) << i;
        ASSERT_NEAR(right.force.x, grip.force, 0.02 * grip.force) << i;
        const double between = right.position.x - left.position.x - 0.02;
        ASSERT_GT(between, 0.04 - 2 * 0.001) << i;
        ASSERT_LT(between, 0.0402) << i;
    }
    EXPECT_GT(caught.y, 0.3);
    const frond_vec3 held = lower_end();
    EXPECT_LT((vec(held) - vec(caught)).norm(), 0.001);
}

// Bullet's next step then has what was foreseen of a body that is gone.
TEST(Robot, MayGoWhileItHoldsAFruit) {
    const Hand hand(FROND_MECHANICS_ROD, 0.05, 20);
    hand.robot.step(30);
    EXPECT_NEAR(hand.robot.state("left_finger").force.x, -20, 1);
    frond_robot_destroy(hand.robot.robot);
    hand.robot.step(30);
    frond_vec3 tip = {};
    ASSERT_EQ(frond_plant_get_tip(hand.fruit, &tip), FROND_OK);
    EXPECT_LT(tip.y, 0);  // it has fallen for half a second
}

// A carriage of a third of its weight carries a fruit that is bonded to it up by 10 cm, at every step.
TEST(Robot, CarriesWhatIsBondedToIt) {
    for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
        const UrdfFolder folder;
        const std::string inertial =
            "<inertial><mass value=\"0.1\"/><inertia ixx=\"1e-4\" ixy=\"0\" ixz=\"0\" iyy=\"1e-4\" iyz=\"0\" "
            "izz=\"1e-4\"/></inertial>";
        const RobotWorld lift(folder.write(
            "lift.urdf",
            urdf_robot(
                urdf_link("rail", inertial) +
                urdf_link("carriage",
                          inertial + "<collision><geometry><sphere radius=\"0.01\"/></geometry></collision>") +
                "<joint name=\"lift\" type=\"prismatic\"><parent link=\"rail\"/><child link=\"carriage\"/>"
                "<origin xyz=\"0.05 0 0.5\"/><axis xyz=\"0 0 1\"/><limit lower=\"0\" upper=\"0.2\" effort=\"50\" "
                "velocity=\"0.2\"/></joint>")));
        const frond_model model = make_fruit();
        frond_plant_def def = frond_default_plant_def();
        def.mechanics = FROND_MECHANICS_ROD;
        def.root_height = -1;
        def.position = {0, 0.375, 0};
        frond_plant fruit = {};
        ASSERT_EQ(frond_plant_create(lift.world, model, &def, &fruit), FROND_OK) << frond_last_error();
        for (const double height : {0.4, 0.6}) {
            frond_bond bond = {};
            ASSERT_EQ(frond_robot_bond(fruit, {0.02, height, 0}, lift.robot, lift.link("carriage"), &bond), FROND_OK)
                << frond_last_error();
        }
        ASSERT_EQ(frond_robot_drive_to(lift.robot, lift.link("carriage"), 0.1, 0.2, 0), FROND_OK);
        std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(fruit)));
        const auto below = [&] {
            EXPECT_EQ(frond_plant_get_capsules(fruit, capsules.data(), int(capsules.size())), FROND_OK);
            return lift.state("carriage").position.y - capsules[0].begin.y;
        };
        const double before = below();
        for (int i = 0; i < int(2 / step); i++) ASSERT_EQ(frond_world_step(lift.world, step), FROND_OK);
        const frond_link_state carriage = lift.state("carriage");
        EXPECT_NEAR(carriage.joint_position, 0.1, 0.001) << step;
        EXPECT_NEAR(carriage.motor_force, 0.4 * 9.81, 0.01) << step;
        EXPECT_NEAR(below(), before, 0.0005) << step;
        frond_model_destroy(model);
    }
}

// A plant that stands bonded to any link of an arm that stands, however far away and by one bond or two, stays, and so
// does the arm.
TEST(Robot, StandsBondedToAPlantThatStands) {
    const frond_model model = make_small_model(0, FROND_REST_STANDS_AS_MODELLED);
    int bonded = 0;
    for (const frond_mechanics mechanics : {FROND_MECHANICS_ROD, FROND_MECHANICS_TET_COROTATIONAL})
        for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 240})
            for (int link = 1; link < 7; link++) {
                const RobotWorld arm(FROND_SOURCE_DIR "/models/arm/arm.urdf", false, {-1, 0, 0});
                if (link >= frond_robot_get_link_count(arm.robot)) break;
                frond_plant_def def = frond_default_plant_def();
                def.mechanics = mechanics;
                frond_plant plant = {};
                ASSERT_EQ(frond_plant_create(arm.world, model, &def, &plant), FROND_OK) << frond_last_error();
                for (const frond_vec3& place : {frond_vec3{0, 0.6, 0}, frond_vec3{0.2, 0.45, 0}}) {
                    if (place.x > 0 && link % 2) continue;
                    frond_bond bond = {};
                    const frond_result result = frond_robot_bond(plant, place, arm.robot, link, &bond);
                    ASSERT_EQ(result, FROND_OK) << frond_last_error();
                    bonded++;
                }
                frond_vec3 before = {}, after = {};
                ASSERT_EQ(frond_plant_get_tip(plant, &before), FROND_OK);
                for (int i = 0; i < int(1 / step); i++) ASSERT_EQ(frond_world_step(arm.world, step), FROND_OK);
                ASSERT_EQ(frond_plant_get_tip(plant, &after), FROND_OK);
                EXPECT_LT(length({after.x - before.x, after.y - before.y, after.z - before.z}), 0.001)
                    << link << ", " << step;
                for (int i = 1; i < frond_robot_get_link_count(arm.robot); i++) {
                    frond_link_state state = {};
                    ASSERT_EQ(frond_robot_get_link_state(arm.robot, i, &state), FROND_OK);
                    EXPECT_LT(std::abs(state.joint_velocity), 0.01) << link << ", " << step << ", " << i;
                }
            }
    EXPECT_GT(bonded, 30);
    frond_model_destroy(model);
}

// Returns by how much the axis of a segment is before that of a bar which comes along `way` [m]; infinite where the two
// do not pass each other.
double before(const frond_capsule& segment, const Vec& from, const Vec& to, const Vec& way) {
    const Vec begin = vec(segment.begin), along = vec(segment.end) - begin, bar = to - from;
    const Vec across = bar.cross(along);
    const double square = across.squaredNorm();
    if (square < 1e-12) return INFINITY;
    const double on_bar = (begin - from).cross(along).dot(across) / square,
                 on_segment = (begin - from).cross(bar).dot(across) / square;
    if (on_bar < 0 || on_bar > 1 || on_segment < 0 || on_segment > 1) return INFINITY;
    return (begin + on_segment * along - from - on_bar * bar).dot(way);
}

struct Arm : testing::TestWithParam<std::tuple<frond_mechanics, double>> {};
INSTANTIATE_TEST_SUITE_P(Robot, Arm,
                         testing::Combine(testing::Values(FROND_MECHANICS_ROD, FROND_MECHANICS_TET_COROTATIONAL),
                                          testing::Values(0.6, 2.0)));

// An arm turns into a row of corn: stems stay on the side from which it came, until its motor can push them no farther
// or it is where it is to go.
TEST_P(Arm, TakesStemsAlong) {
    const auto [mechanics, speed] = GetParam();
    const RobotWorld arm(FROND_SOURCE_DIR "/models/arm/arm.urdf");
    const frond_model_def model_def = frond_default_model_def();
    frond_model corn = {};
    ASSERT_EQ(frond_model_load(FROND_SOURCE_DIR "/models/corn/corn.obj", &model_def, &corn), FROND_OK)
        << frond_last_error();
    std::vector<frond_plant> plants(2);
    for (size_t i = 0; i < plants.size(); i++) {
        frond_plant_def def = frond_default_plant_def();
        def.mechanics = mechanics;
        def.position = {0.8 + 0.4 * double(i), 0, 0};
        ASSERT_EQ(frond_plant_create(arm.world, corn, &def, &plants[i]), FROND_OK) << frond_last_error();
    }
    std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plants[0])));
    std::vector<int32_t> organs(capsules.size());
    ASSERT_EQ(frond_model_get_capsule_organs(corn, organs.data(), int(organs.size())), FROND_OK);
    ASSERT_EQ(frond_robot_set_joint(arm.robot, arm.link("turn"), -0.6), FROND_OK);
    ASSERT_EQ(frond_robot_set_joint(arm.robot, arm.link("lift"), 1.4), FROND_OK);
    arm.step(2);
    ASSERT_EQ(frond_robot_drive_to(arm.robot, arm.link("turn"), 0.3, speed, 0), FROND_OK);
    int passes = 0;
    for (int i = 0; i < 240; i++) {
        arm.step(1);
        const Vec from = vec(arm.state("upper_arm").position), to = vec(arm.state("palm").position);
        const Vec way = Vec(0, 1, 0).cross(to - from).normalized();
        for (const frond_plant plant : plants) {
            ASSERT_EQ(frond_plant_get_capsules(plant, capsules.data(), int(capsules.size())), FROND_OK);
            for (size_t k = 0; k < capsules.size(); k++)
                if (organs[k] == 0) {
                    const double gap = before(capsules[k], from, to, way);
                    ASSERT_GT(gap, 0.02) << i;
                    passes += std::isfinite(gap);
                }
        }
    }
    EXPECT_GT(passes, 100);
    EXPECT_GT(length(arm.state("forearm").force), 20);
    frond_model_destroy(corn);
}

}  // namespace grip_tests
