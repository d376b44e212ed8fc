// Plants of files that change their mechanics somewhere else than they were made; and forces on any node of their cage.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "frond/frond.h"

namespace handover_tests {

constexpr double H = 1.0 / 60;

double distance(const frond_vec3& a, const frond_vec3& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

// A plant of one of our models, alone in a world.
struct OfFile : testing::TestWithParam<const char*> {
    frond_world world = {};
    frond_model model = {};
    frond_model_info info = {};
    frond_plant plant = {};

    void make(frond_mechanics mechanics, double root_height, frond_vec3 gravity) {
        frond_world_def world_def = frond_default_world_def();
        world_def.gravity = gravity;
        ASSERT_EQ(frond_world_create(&world_def, &world), FROND_OK) << frond_last_error();
        const std::string path = std::string(FROND_SOURCE_DIR "/models/") + GetParam() + "/" + GetParam() + ".obj";
        const frond_model_def model_def = frond_default_model_def();
        ASSERT_EQ(frond_model_load(path.c_str(), &model_def, &model), FROND_OK) << frond_last_error();
        ASSERT_EQ(frond_model_get_info(model, &info), FROND_OK);
        frond_plant_def def = frond_default_plant_def();
        def.mechanics = mechanics;
        def.root_height = root_height;
        ASSERT_EQ(frond_plant_create(world, model, &def, &plant), FROND_OK) << frond_last_error();
    }
    std::vector<frond_vec3> places() {
        std::vector<frond_vec3> x(size_t(frond_plant_get_node_count(plant)));
        EXPECT_EQ(frond_plant_get_state(plant, &x[0].x, nullptr, int(x.size())), FROND_OK);
        return x;
    }
    ~OfFile() override {
        frond_world_destroy(world);
        frond_model_destroy(model);
    }
};
INSTANTIATE_TEST_SUITE_P(Plants, OfFile, testing::Values("corn", "cucumber", "wheat", "sunflower"),
                         [](const auto& info) { return std::string(info.param); });

// Roots that no cage node determines had stayed behind, with 10^8 J in the springs between.
TEST_P(OfFile, BecomesAChainWhereItWasMoved) {
    make(FROND_MECHANICS_TET_COROTATIONAL, -1, {0, 0, 0});
    std::vector<frond_vec3> moved = places();
    for (frond_vec3& p : moved) p = {p.z + 3, p.y - 2, 1 - p.x};  // a quarter turn
    for (const frond_mechanics chain : {FROND_MECHANICS_ROD, FROND_MECHANICS_SPRING_CHAIN}) {
        ASSERT_EQ(frond_plant_set_mechanics(plant, FROND_MECHANICS_TET_COROTATIONAL), FROND_OK);
        ASSERT_EQ(frond_plant_set_state(plant, &moved[0].x, nullptr, int(moved.size())), FROND_OK);
        ASSERT_EQ(frond_plant_set_mechanics(plant, chain), FROND_OK);
        const std::vector<frond_vec3> now = places();
        double farthest = 0;
        for (size_t i = 0; i < now.size(); i++) farthest = std::max(farthest, distance(now[i], moved[i]));
        EXPECT_LT(farthest, 0.01);
    }
}

// A corner of a cage has a 6400th of its organ's stiffness: without what holds it to the organ, eight newtons threw it
// 205 m away. Rods go 1.6 m, of their size of 2.7.
TEST_P(OfFile, IsNotTornApartByAForceOnAnyNode) {
    constexpr double FORCE = 8, FARTHEST = 1.3;  // [N], [sizes]
    constexpr int EVERY = 11, STEPS = 8;
    make(FROND_MECHANICS_TET_COROTATIONAL, 0, {0, -9.81, 0});
    const std::vector<frond_vec3> home = places();
    const double size = distance(info.lower, info.upper);
    for (int node = 0; node < int(home.size()); node += EVERY) {
        ASSERT_EQ(frond_plant_reset(plant), FROND_OK);
        double farthest = 0;
        for (int i = 0; i < STEPS; i++) {
            const frond_vec3 force = {node % 3 == 0 ? -FORCE : 0, 0, node % 3 == 0 ? 0 : FORCE};
            ASSERT_EQ(frond_plant_add_force(plant, node, force), FROND_OK);
            ASSERT_EQ(frond_world_step(world, H), FROND_OK);
            const std::vector<frond_vec3> now = places();
            for (size_t k = 0; k < now.size(); k++) farthest = std::max(farthest, distance(now[k], home[k]));
        }
        EXPECT_LT(farthest, FARTHEST * size) << "node " << node;
    }
}

}  // namespace handover_tests
