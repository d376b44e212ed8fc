// The plants of models/ as rods in a fresh breeze, all settings at their defaults: segments keep their lengths in every
// step, and after it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "frond/frond.h"

namespace breeze_tests {

class EveryPlant : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Models, EveryPlant, testing::Values("corn", "cucumber", "wheat", "sunflower"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(EveryPlant, KeepsItsLengthsInAFreshBreeze) {
    constexpr double SPEED = 8, STEP = 1.0 / 60;  // [m/s], [s]
    constexpr int BLOWN = 8 * 60, CALM = 3 * 60;  // steps
    const std::string name = GetParam(), path = FROND_SOURCE_DIR "/models/" + name + "/" + name + ".obj";
    const frond_world_def world_def = frond_default_world_def();
    const frond_model_def model_def = frond_default_model_def();
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = FROND_MECHANICS_ROD;
    def.effects |= FROND_EFFECT_WIND;
    frond_wind_def wind = frond_default_wind_def();
    wind.velocity = {SPEED, 0, 0};
    frond_world world;
    frond_model model;
    frond_plant plant;
    ASSERT_EQ(frond_world_create(&world_def, &world), FROND_OK) << frond_last_error();
    ASSERT_EQ(frond_world_set_wind(world, &wind), FROND_OK) << frond_last_error();
    ASSERT_EQ(frond_model_load(path.c_str(), &model_def, &model), FROND_OK) << frond_last_error();
    ASSERT_EQ(frond_plant_create(world, model, &def, &plant), FROND_OK) << frond_last_error();
    std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plant)));
    const auto lengths = [&] {
        EXPECT_EQ(frond_plant_get_capsules(plant, capsules.data(), int(capsules.size())), FROND_OK);
        std::vector<double> all;
        for (const frond_capsule& c : capsules)
            all.push_back(std::hypot(c.end.x - c.begin.x, c.end.y - c.begin.y, c.end.z - c.begin.z));
        return all;
    };
    const std::vector<double> modelled = lengths();
    const auto longest = [&] {
        const std::vector<double> now = lengths();
        double most = 0;
        for (size_t i = 0; i < now.size(); i++) most = std::max(most, now[i] / modelled[i]);
        return most;
    };
    for (int step = 0; step < BLOWN; step++) {
        ASSERT_EQ(frond_world_step(world, STEP), FROND_OK);
        ASSERT_LT(longest(), 1.02) << "step " << step;
    }
    wind.velocity = {0, 0, 0};
    ASSERT_EQ(frond_world_set_wind(world, &wind), FROND_OK);
    for (int step = 0; step < CALM; step++) {
        ASSERT_EQ(frond_world_step(world, STEP), FROND_OK);
        ASSERT_LT(longest(), 1.02) << "step " << BLOWN + step;
    }
    EXPECT_LT(longest(), 1.01);
    frond_world_destroy(world);
    frond_model_destroy(model);
}

}  // namespace breeze_tests
