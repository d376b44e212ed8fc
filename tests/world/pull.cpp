// A plant at rest that a grab pulls: grab, weight and the force at the root balance.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "frond/frond.h"
#include "frond/frond_robot.h"

struct Pull {
    frond_mechanics mechanics;
    const char* name;
    frond_vec3 at, way;  // place of the grab, and how far it pulls [m]
    double stiffness;    // [N/m]
};
void PrintTo(const Pull& pull, std::ostream* out) {
    *out << pull.name;
}

struct Pulled : testing::TestWithParam<Pull> {};
// The last ones draw fibres of a caged plant taut.
INSTANTIATE_TEST_SUITE_P(
    Plants, Pulled,
    testing::Values(Pull{FROND_MECHANICS_ROD, "rod", {0, 1, 0}, {0.1, 0, 0}, 100},
                    Pull{FROND_MECHANICS_ROD, "rod_up", {0, 1, 0}, {0, 0.3, 0}, 500},
                    Pull{FROND_MECHANICS_ROD, "rod_far", {0, 1, 0}, {0.5, 0, 0}, 500},
                    Pull{FROND_MECHANICS_ROD, "rod_leaf", {0.5, 1.2, 0}, {0.1, 0, 0}, 50},
                    Pull{FROND_MECHANICS_TET_COROTATIONAL, "cage", {0, 1, 0}, {0.1, 0, 0}, 100},
                    Pull{FROND_MECHANICS_TET_COROTATIONAL, "cage_up", {0, 1, 0}, {0, 0.3, 0}, 500},
                    Pull{FROND_MECHANICS_TET_COROTATIONAL, "cage_far", {0, 1, 0}, {0.5, 0, 0}, 500}),
    [](const auto& info) { return std::string(info.param.name); });

TEST_P(Pulled, RootWeightAndGrabBalance) {
    const Pull& pull = GetParam();
    frond_world_def world_def = frond_default_world_def();
    world_def.sleep_distance = 0;
    frond_world world;
    ASSERT_EQ(frond_world_create(&world_def, &world), FROND_OK) << frond_last_error();
    const frond_model_def model_def = frond_default_model_def();
    frond_model corn;
    ASSERT_EQ(frond_model_load(FROND_SOURCE_DIR "/models/corn/corn.obj", &model_def, &corn), FROND_OK);
    frond_model_info info;
    ASSERT_EQ(frond_model_get_info(corn, &info), FROND_OK);
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = pull.mechanics;
    def.mass_damping = 3;  // comes to rest soon
    frond_plant plant;
    ASSERT_EQ(frond_plant_create(world, corn, &def, &plant), FROND_OK) << frond_last_error();
    frond_grab grab;
    ASSERT_EQ(frond_grab_create(plant, pull.at, pull.stiffness, &grab), FROND_OK) << frond_last_error();
    frond_vec3 begin, point, target, force, root;
    ASSERT_EQ(frond_grab_get(grab, &begin, nullptr, &force), FROND_OK);
    EXPECT_NEAR(std::hypot(force.x, force.y, force.z), 0, 1e-9);
    for (int i = 0; i < 480; i++) {
        const double share = std::fmin(1, i / 120.0);
        ASSERT_EQ(frond_grab_move(
                      grab, {begin.x + share * pull.way.x, begin.y + share * pull.way.y, begin.z + share * pull.way.z}),
                  FROND_OK);
        ASSERT_EQ(frond_world_step(world, 1.0 / 60), FROND_OK);
    }
    ASSERT_EQ(frond_grab_get(grab, &point, &target, &force), FROND_OK);
    EXPECT_NEAR(force.x, pull.stiffness * (target.x - point.x), 1e-9);
    ASSERT_EQ(frond_plant_get_root_force(plant, {0, 0, 0}, &root, nullptr), FROND_OK);
    const double weight = 9.81 * info.mass, size = std::hypot(force.x, force.y, force.z);
    EXPECT_GT(size, 1);
    EXPECT_NEAR(std::hypot(force.x + root.x, force.y + root.y - weight, force.z + root.z), 0, 0.01 * size)
        << "grab " << force.x << " " << force.y << " " << force.z << ", root " << root.x << " " << root.y - weight
        << " " << root.z;
    frond_world_destroy(world);
    frond_model_destroy(corn);
}
