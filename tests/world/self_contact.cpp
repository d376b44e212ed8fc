// Self-contact of plants in their modelled shape: nothing touches, nothing moves.
#include <vector>

#include "support/stems.hpp"

namespace self_contact_tests {

struct SelfContact : testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Plants, SelfContact, testing::Range(0, int(FROND_MECHANICS_COUNT)), [](const auto& info) {
    return std::string(frond_mechanics_name(frond_mechanics(info.param)));
});

void step(frond_world world, frond_plant plant, int node_count, double most) {
    std::vector<double> before(size_t(3 * node_count)), after(size_t(3 * node_count));
    ASSERT_EQ(frond_plant_get_state(plant, before.data(), nullptr, node_count), FROND_OK);
    for (int i = 0; i < 30; i++) ASSERT_EQ(frond_world_step(world, 1.0 / 60), FROND_OK);
    ASSERT_EQ(frond_plant_get_state(plant, after.data(), nullptr, node_count), FROND_OK);
    for (size_t k = 0; k < before.size(); k++) ASSERT_NEAR(after[k], before[k], most);
    frond_report report;
    ASSERT_EQ(frond_world_get_report(world, &report), FROND_OK);
    EXPECT_EQ(report.trouble, 0u);
}

TEST_P(SelfContact, MovesNothingAtRest) {
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = frond_mechanics(GetParam());
    def.effects = FROND_EFFECT_ALL & ~uint32_t(FROND_EFFECT_GRAVITY);
    SmallWorld small(def);
    step(small.world, small.plant, frond_plant_get_node_count(small.plant), 1e-6);
}

TEST_P(SelfContact, LetsTheCornStand) {
    const frond_world_def world_def = frond_default_world_def();
    frond_model_def model_def = frond_default_model_def();
    model_def.cage_size = 0.24;
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = frond_mechanics(GetParam());
    def.effects = FROND_EFFECT_ALL;
    frond_world world;
    frond_model model;
    frond_plant plant;
    ASSERT_EQ(frond_world_create(&world_def, &world), FROND_OK);
    ASSERT_EQ(frond_model_load(FROND_SOURCE_DIR "/models/corn/corn.obj", &model_def, &model), FROND_OK)
        << frond_last_error();
    ASSERT_EQ(frond_plant_create(world, model, &def, &plant), FROND_OK) << frond_last_error();
    // Springs have no shape without gravity, so they droop.
    step(world, plant, frond_plant_get_node_count(plant), GetParam() == FROND_MECHANICS_SPRING_CHAIN ? 0.2 : 0.002);
    frond_world_destroy(world);
    frond_model_destroy(model);
}

}  // namespace self_contact_tests
