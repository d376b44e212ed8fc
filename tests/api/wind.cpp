// The air of a world through the C API: refused input, and its effect on a plant.
#include <cmath>
#include <cstring>

#include "support/stems.hpp"

namespace wind_tests {

void step(frond_world world, int steps) {
    for (int i = 0; i < steps; i++) ASSERT_EQ(frond_world_step(world, 1.0 / 60), FROND_OK) << frond_last_error();
}
uint64_t hash_of(const SmallWorld& small) {
    uint64_t hash = 0;
    EXPECT_EQ(frond_world_get_state_hash(small.world, &hash), FROND_OK);
    return hash;
}
frond_wind_def breeze() {
    frond_wind_def def = frond_default_wind_def();
    def.velocity = {8, 0, 0};
    return def;
}

TEST(Misuse, OfWindIsRefused) {
    SmallWorld small;
    const struct {
        const char* name;
        void (*spoil)(frond_wind_def& def);
    } cases[] = {
        {"velocity", [](frond_wind_def& def) { def.velocity.y = NAN; }},
        {"velocity", [](frond_wind_def& def) { def.velocity.x = 1e4; }},
        {"turbulence", [](frond_wind_def& def) { def.turbulence = -0.1; }},
        {"turbulence", [](frond_wind_def& def) { def.turbulence = 3; }},
        {"length_scale", [](frond_wind_def& def) { def.length_scale = 0; }},
        {"profile", [](frond_wind_def& def) { def.profile = FROND_WIND_PROFILE_COUNT; }},
        {"reference_height", [](frond_wind_def& def) { def.reference_height = 0; }},
        {"roughness", [](frond_wind_def& def) { def.roughness = def.reference_height; }},
        {"exponent", [](frond_wind_def& def) { def.exponent = INFINITY; }},
        {"ground_height", [](frond_wind_def& def) { def.ground_height = NAN; }},
        {"density", [](frond_wind_def& def) { def.density = 1000; }},
    };
    frond_vec3 before, after;
    const frond_wind_def good = breeze();
    ASSERT_EQ(frond_world_set_wind(small.world, &good), FROND_OK);
    ASSERT_EQ(frond_world_get_wind_at(small.world, {0, 10, 0}, &before), FROND_OK);
    for (const auto& c : cases) {
        frond_wind_def def = breeze();
        c.spoil(def);
        EXPECT_EQ(frond_world_set_wind(small.world, &def), FROND_RESULT_BAD_ARGUMENT) << c.name;
        EXPECT_NE(std::strstr(frond_last_error(), c.name), nullptr) << frond_last_error();
    }
    ASSERT_EQ(frond_world_get_wind_at(small.world, {0, 10, 0}, &after), FROND_OK);
    EXPECT_EQ(before.x, after.x);
    const frond_wind_def zero = {};
    EXPECT_EQ(frond_world_set_wind(small.world, &zero), FROND_RESULT_BAD_DEF);
    EXPECT_NE(std::strstr(frond_last_error(), "frond_default_wind_def"), nullptr);
    EXPECT_EQ(frond_world_get_wind_at(small.world, {NAN, 0, 0}, &after), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_world_get_wind_at(small.world, {0, 0, 0}, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_get_air_force(small.plant, nullptr), FROND_RESULT_BAD_ARGUMENT);
    const frond_world stale = {0x1234567890abcdefu};
    EXPECT_EQ(frond_world_set_wind(stale, &good), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_world_set_wind(stale, nullptr), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_world_set_wind_field(stale, nullptr, nullptr), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_world_get_wind_at(stale, {0, 0, 0}, &after), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_plant_get_air_force({5}, &after), FROND_RESULT_BAD_HANDLE);
}

TEST(Wind, BendsAPlantAndEnds) {
    SmallWorld small, calm;
    const frond_wind_def def = breeze();
    ASSERT_EQ(frond_world_set_wind(small.world, &def), FROND_OK) << frond_last_error();
    step(small.world, 30);
    step(calm.world, 30);
    frond_vec3 force, tip, calm_tip, air;
    ASSERT_EQ(frond_plant_get_air_force(small.plant, &force), FROND_OK);
    EXPECT_GT(force.x, 0.01);
    ASSERT_EQ(frond_plant_get_tip(small.plant, &tip), FROND_OK);
    ASSERT_EQ(frond_plant_get_tip(calm.plant, &calm_tip), FROND_OK);
    EXPECT_NE(tip.x, calm_tip.x);

    ASSERT_EQ(frond_world_set_wind(small.world, nullptr), FROND_OK);
    step(small.world, 1);
    ASSERT_EQ(frond_plant_get_air_force(small.plant, &force), FROND_OK);
    EXPECT_EQ(force.x, 0);
    ASSERT_EQ(frond_world_get_wind_at(small.world, {0, 1, 0}, &air), FROND_OK);
    EXPECT_EQ(air.x, 0);
}

TEST(Wind, SameSeedGivesTheSameBitsAndAnotherOneOthers) {
    const auto run = [](uint64_t seed, frond_effects effects) {
        SmallWorld small;
        frond_wind_def def = breeze();
        def.seed = seed;
        EXPECT_EQ(frond_world_set_wind(small.world, &def), FROND_OK);
        EXPECT_EQ(frond_world_set_effects(small.world, effects), FROND_OK);
        step(small.world, 40);
        return hash_of(small);
    };
    EXPECT_EQ(run(1, FROND_EFFECT_ALL), run(1, FROND_EFFECT_ALL));
    EXPECT_NE(run(1, FROND_EFFECT_ALL), run(2, FROND_EFFECT_ALL));
    const frond_effects none = FROND_EFFECT_ALL & ~(frond_effects)(FROND_EFFECT_WIND | FROND_EFFECT_AIR_DRAG);
    EXPECT_EQ(run(1, none), run(2, none));
    SmallWorld without;
    step(without.world, 40);
    EXPECT_EQ(run(1, none), hash_of(without));
}

TEST(Wind, IsWhatItIsAskedForAndGrowsWithHeight) {
    SmallWorld small;
    frond_wind_def def = breeze();
    def.turbulence = 0;
    ASSERT_EQ(frond_world_set_wind(small.world, &def), FROND_OK);
    frond_vec3 high, low;
    ASSERT_EQ(frond_world_get_wind_at(small.world, {3, 10, 1}, &high), FROND_OK);
    ASSERT_EQ(frond_world_get_wind_at(small.world, {3, 1, 1}, &low), FROND_OK);
    EXPECT_NEAR(high.x, 8, 1e-9);
    EXPECT_NEAR(low.x, 8 * std::log(1 / 0.03) / std::log(10 / 0.03), 1e-9);
    // Height is measured against gravity.
    ASSERT_EQ(frond_world_set_gravity(small.world, {0, 0, -9.81}), FROND_OK);
    ASSERT_EQ(frond_world_get_wind_at(small.world, {3, 1, 10}, &high), FROND_OK);
    EXPECT_NEAR(high.x, 8, 1e-6);
}

struct Asked {
    int calls = 0, points = 0;
    double time = 0;
};
void blow_up(const frond_vec3*, int count, double time, frond_vec3* velocities, void* user) {
    Asked& asked = *static_cast<Asked*>(user);
    asked.calls++;
    asked.points = count;
    asked.time = time;
    for (int i = 0; i < count; i++) velocities[i] = {0, 0, 10};
}
void blow_nonsense(const frond_vec3*, int, double, frond_vec3* velocities, void*) {
    velocities[0].x = NAN;
}

TEST(Wind, FieldOfTheGamesIsAskedOnceAPlantAndSubstep) {
    SmallWorld small;
    Asked asked;
    ASSERT_EQ(frond_world_set_wind_field(small.world, blow_up, &asked), FROND_OK);
    step(small.world, 12);
    EXPECT_EQ(asked.calls, 12);
    EXPECT_GT(asked.points, 5);
    EXPECT_NEAR(asked.time, 0.2, 1e-6);
    frond_vec3 force, air;
    ASSERT_EQ(frond_plant_get_air_force(small.plant, &force), FROND_OK);
    EXPECT_GT(force.z, 0.01);
    ASSERT_EQ(frond_world_get_wind_at(small.world, {0, 1, 0}, &air), FROND_OK);
    EXPECT_EQ(air.z, 10);
    // Another wind keeps the field; without a field, its function is no longer called.
    const frond_wind_def def = breeze();
    ASSERT_EQ(frond_world_set_wind(small.world, &def), FROND_OK);
    ASSERT_EQ(frond_world_get_wind_at(small.world, {0, 1, 0}, &air), FROND_OK);
    EXPECT_EQ(air.z, 10);
    ASSERT_EQ(frond_world_set_wind_field(small.world, nullptr, nullptr), FROND_OK);
    asked.calls = 0;
    step(small.world, 1);
    EXPECT_EQ(asked.calls, 0);
}

TEST(Wind, NonsenseOfAFieldIsReportedAndHarmsNothing) {
    SmallWorld small;
    ASSERT_EQ(frond_world_set_wind_field(small.world, blow_nonsense, nullptr), FROND_OK);
    step(small.world, 3);
    frond_report report;
    ASSERT_EQ(frond_world_get_report(small.world, &report), FROND_OK);
    EXPECT_EQ(report.trouble, uint32_t(FROND_TROUBLE_BAD_WIND));
    frond_vec3 air, tip;
    EXPECT_EQ(frond_world_get_wind_at(small.world, {0, 1, 0}, &air), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_NE(std::strstr(frond_last_error(), "wind field"), nullptr);
    EXPECT_EQ(air.x, 0);
    ASSERT_EQ(frond_plant_get_tip(small.plant, &tip), FROND_OK);
    EXPECT_TRUE(std::isfinite(tip.x + tip.y + tip.z));
}

}  // namespace wind_tests
