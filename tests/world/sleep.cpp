// Sleep: a plant at rest falls asleep in place, costs nothing, and is woken by everything that could move it and by
// nothing else.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "frond/frond.h"
#include "support/sanitized.hpp"
#include "support/stand.hpp"

namespace sleep_tests {

using frond::test::must;

constexpr double H = 1.0 / 60;

// Forked stems of half a metre, some beside each other.
struct ForkedStems : frond::test::Stand {
    explicit ForkedStems(double sleep_distance = frond_default_world_def().sleep_distance)
        : Stand(def_of(sleep_distance)) {
        const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.3, 0}, 0.012, 0.01},
                                    {0, {0, 0.3, 0}, {0.15, 0.5, 0}, 0.01, 0.008},
                                    {0, {0, 0.3, 0}, {-0.15, 0.5, 0}, 0.01, 0.008}};
        frond_organ_material organ = {"stem", {}};
        must(frond_material_preset("stem", &organ.material));
        organ.material.young = 2e8;
        organ.material.damping_ratio = 0.2;
        frond_model_def model_def = frond_default_model_def();
        model_def.organs = &organ;
        model_def.organ_count = 1;
        must(frond_model_from_stems(stems, 3, &model_def, &model));
    }
    static frond_world_def def_of(double sleep_distance) {
        frond_world_def def = frond_default_world_def();
        def.sleep_distance = sleep_distance;
        return def;
    }
    frond_plant add(double x, frond_mechanics mechanics = FROND_MECHANICS_ROD, double z = 0) {
        frond_plant_def def = plant_def();
        def.mechanics = mechanics;
        return Stand::add(def, {x, 0, z});
    }
    void pull(frond_plant plant, int count) {
        for (int i = 0; i < count; i++) {
            must(frond_plant_add_force(plant, frond_plant_get_node_count(plant) - 1, {2, 0, 1}));
            steps(1);
        }
    }
    // Steps until all plants sleep, for at most `time` [s]; returns whether they do.
    bool rests_within(double time) {
        for (int i = 0; i < int(time / H); i++) {
            steps(1);
            if (report().awake_count == 0) return true;
        }
        return false;
    }
};

class Sleep : public testing::TestWithParam<frond_mechanics> {};
INSTANTIATE_TEST_SUITE_P(Mechanics, Sleep,
                         testing::Values(FROND_MECHANICS_TET_LINEAR, FROND_MECHANICS_TET_COROTATIONAL,
                                         FROND_MECHANICS_TET_NEOHOOKEAN, FROND_MECHANICS_ROD,
                                         FROND_MECHANICS_SPRING_CHAIN));

TEST_P(Sleep, ChangesNothingByMoreThanATenthOfAMillimetre) {
    if (SANITIZED && GetParam() != FROND_MECHANICS_ROD) GTEST_SKIP() << "a figure";
    ForkedStems sleeps, stays_awake(0);
    for (ForkedStems* stand : {&sleeps, &stays_awake}) {
        stand->add(0, GetParam());
        stand->pull(stand->plants[0], 30);
    }
    EXPECT_EQ(sleeps.places(sleeps.plants[0]), stays_awake.places(stays_awake.plants[0]));
    ASSERT_TRUE(sleeps.rests_within(20));
    EXPECT_FALSE(frond_plant_is_awake(sleeps.plants[0]));
    stays_awake.steps(60 * 30);
    EXPECT_EQ(stays_awake.report().awake_count, 1);
    const std::vector<double> asleep = sleeps.places(sleeps.plants[0]),
                              awake = stays_awake.places(stays_awake.plants[0]);
    for (size_t i = 0; i < asleep.size(); i++) ASSERT_NEAR(asleep[i], awake[i], 1e-4) << i;

    // From then on not a bit changes.
    sleeps.steps(60);
    EXPECT_EQ(sleeps.places(sleeps.plants[0]), asleep);
    EXPECT_EQ(sleeps.report().solver_iterations, 0);
    frond_profile profile;
    ASSERT_EQ(frond_world_get_profile(sleeps.world, &profile), FROND_OK);
    EXPECT_EQ(profile.ms_solve, 0);
}

// A plant whose foot is in the ground from the start is not pushed out of it when it wakes.
TEST(Sleep, FromTheStartLeavesAPlantWhereItStands) {
    ForkedStems stand;
    frond_rigid_def ground = frond_default_rigid_def();
    ground.shape = FROND_SHAPE_PLANE;
    ground.state.position.y = 0.05;
    frond_rigid rigid = {};
    must(frond_rigid_create(stand.world, &ground, &rigid));
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = FROND_MECHANICS_ROD;
    def.starts_asleep = true;
    frond_plant plant = {};
    must(frond_plant_create(stand.world, stand.model, &def, &plant));
    stand.steps(10);
    EXPECT_FALSE(frond_plant_is_awake(plant));
    const std::vector<double> start = stand.places(plant);
    must(frond_plant_wake(plant));
    stand.steps(20);
    EXPECT_TRUE(frond_plant_is_awake(plant));
    const std::vector<double> now = stand.places(plant);
    for (size_t i = 0; i < now.size(); i++) ASSERT_NEAR(now[i], start[i], 1e-5) << i;
}

TEST_P(Sleep, ComesNotWhileAPlantSways) {
    ForkedStems stand;
    const frond_plant plant = stand.add(0, GetParam());
    stand.pull(plant, 30);
    std::vector<double> before = stand.places(plant);
    for (int i = 0; i < 1200 && stand.report().awake_count > 0; i++) {
        before = stand.places(plant);
        stand.steps(1);
    }
    // Its motion in the last step awake is negligible.
    const std::vector<double> after = stand.places(plant);
    for (size_t i = 0; i < after.size(); i++) ASSERT_NEAR(before[i], after[i], 5e-5);
}

// Each cause wakes a sleeping plant, and that one only.
// A surface that a plant keeps is no work of the steps in which it sleeps.
TEST(Sleep, CostsNoSurfaces) {
    ForkedStems field;
    const frond_plant plant = field.add(0);
    const auto ms_of_surface = [&] {
        field.steps(1);
        frond_surface_view view = {};
        must(frond_plant_get_surface(plant, &view));
        frond_profile profile = {};
        must(frond_world_get_profile(field.world, &profile));
        const bool is_told = (field.report().effects_run & FROND_EFFECT_SURFACE) != 0;
        EXPECT_EQ(is_told, profile.ms_surface > 0);
        return profile.ms_surface;
    };
    field.pull(plant, 5);
    EXPECT_GT(ms_of_surface(), 0);
    ASSERT_TRUE(field.rests_within(30));
    ms_of_surface();
    EXPECT_EQ(ms_of_surface(), 0);
}

TEST(Wake, ComesFromAllThatMovesAPlant) {
    ForkedStems stand;
    const frond_plant plant = stand.add(0), other = stand.add(2);
    const std::vector<double> modelled = stand.places(plant);
    frond_grab grab = {};
    frond_bond bond = {};
    frond_rigid ball = {}, holder = {};
    frond_rigid_def ball_def = frond_default_rigid_def();
    ball_def.size = {0.05, 0, 0};
    ball_def.mass = 0.2;
    frond_rigid_def holder_def = ball_def;
    holder_def.mass = 0;
    holder_def.state.position = {0.15, 0.6, 0};
    const std::vector<std::pair<const char*, std::function<void()>>> causes = {
        {"a force",
         [&] {
             must(frond_plant_add_force(plant, frond_plant_get_node_count(plant) - 1, {0.1, 0, 0}));
         }},
        {"a grab",
         [&] {
             must(frond_grab_create(plant, {0.15, 0.5, 0}, 10, &grab));
         }},
        {"a grab that moves",
         [&] {
             must(frond_grab_move(grab, {0.2, 0.5, 0}));
         }},
        {"a grab that ends", [&] { frond_grab_destroy(grab); }},
        {"a pin", [&] { must(frond_plant_pin(plant, frond_plant_get_node_count(plant) - 1)); }},
        {"no pin", [&] { must(frond_plant_unpin(plant, frond_plant_get_node_count(plant) - 1)); }},
        {"a state", [&] { must(frond_plant_set_state(plant, modelled.data(), nullptr, int(modelled.size() / 3))); }},
        {"effects", [&] { must(frond_plant_set_effects(plant, FROND_EFFECT_DEFAULT)); }},
        {"mechanics", [&] { must(frond_plant_set_mechanics(plant, FROND_MECHANICS_TET_COROTATIONAL)); }},
        {"a word", [&] { must(frond_plant_wake(plant)); }},
        {"a bond",
         [&] {
             must(frond_rigid_create(stand.world, &holder_def, &holder));
             must(frond_bond_create(plant, {0.15, 0.5, 0}, holder, &bond));
         }},
        {"a bond that moves",
         [&] {
             frond_rigid_state state = holder_def.state;
             state.position.y += 0.02;
             must(frond_rigid_set_state(holder, &state));
         }},
        {"no bond", [&] { frond_bond_destroy(bond); }},
        {"a ball",
         [&] {
             ball_def.state.position = {-0.1, 0.25, 0};
             ball_def.state.velocity = {3, 0, 0};
             must(frond_rigid_create(stand.world, &ball_def, &ball));
         }},
    };
    ASSERT_TRUE(stand.rests_within(10));
    for (const auto& [name, cause] : causes) {
        cause();
        int longest = 0;
        for (int i = 0; i < 6; i++) {
            stand.steps(1);
            longest = std::max(longest, stand.report().awake_count);
            EXPECT_FALSE(frond_plant_is_awake(other)) << name;
        }
        EXPECT_EQ(longest, 1) << name;
        if (ball.id) frond_rigid_destroy(ball);
        EXPECT_TRUE(stand.rests_within(30)) << name;
    }
}

// A kinematic body, which is filtered like static ones, wakes a plant that never moved; so does the next one.
TEST(Wake, ComesFromWhatTheHostCarriesIntoAPlant) {
    ForkedStems stand;
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = FROND_MECHANICS_ROD;
    def.starts_asleep = true;
    frond_plant plant = {};
    must(frond_plant_create(stand.world, stand.model, &def, &plant));
    stand.steps(5);
    for (int i = 0; i < 2; i++) {
        frond_rigid_def carried = frond_default_rigid_def();
        carried.mass = 0;
        carried.size = {0.1, 0, 0};
        carried.state.position = {-0.6, 0.3, 0};
        frond_rigid rigid = {};
        must(frond_rigid_create(stand.world, &carried, &rigid));
        EXPECT_FALSE(frond_plant_is_awake(plant));
        int most = 0;
        for (int k = 0; k < 50; k++) {
            carried.state.position.x += 0.02;
            must(frond_rigid_set_state(rigid, &carried.state));
            stand.steps(1);
            most = std::max(most, stand.report().contact_count);
        }
        EXPECT_TRUE(frond_plant_is_awake(plant)) << i;
        EXPECT_GT(most, 0) << i;
        frond_rigid_destroy(rigid);
        EXPECT_TRUE(stand.rests_within(60)) << i;
        stand.steps(70);
    }
}

TEST(Wake, ComesToAllFromWhatIsOfTheWorld) {
    ForkedStems stand;
    stand.add(0);
    stand.add(2);
    frond_wind_def wind = frond_default_wind_def();
    wind.velocity = {4, 0, 0};
    wind.turbulence = 0;
    const std::vector<std::pair<const char*, std::function<void()>>> causes = {
        {"gravity",
         [&] {
             must(frond_world_set_gravity(stand.world, {0.5, -9.81, 0}));
         }},
        {"effects",
         [&] { must(frond_world_set_effects(stand.world, FROND_EFFECT_ALL & ~uint32_t(FROND_EFFECT_GRAVITY))); }},
        {"wind", [&] { must(frond_world_set_wind(stand.world, &wind)); }},
        {"more wind",
         [&] {
             wind.velocity.x = 6;
             must(frond_world_set_wind(stand.world, &wind));
         }},
        {"no wind", [&] { must(frond_world_set_wind(stand.world, nullptr)); }},
    };
    ASSERT_TRUE(stand.rests_within(10));
    for (const auto& [name, cause] : causes) {
        const std::vector<double> before = stand.places(stand.plants[0]);
        cause();
        int most = 0;
        for (int i = 0; i < 10; i++) {
            stand.steps(1);
            most = std::max(most, stand.report().awake_count);
        }
        EXPECT_EQ(most, 2) << name;
        EXPECT_TRUE(stand.rests_within(30)) << name;
        EXPECT_NE(stand.places(stand.plants[0]), before) << name;
    }
}

// A row of plants leaning on each other sleeps as one; a plant that is pulled wakes those that it reaches.
TEST(Wake, GoesOnFromPlantToPlant) {
    std::vector<frond_mechanics> all = {FROND_MECHANICS_ROD};
    if (!SANITIZED) all.push_back(FROND_MECHANICS_TET_COROTATIONAL);
    for (const frond_mechanics mechanics : all) {
        ForkedStems stand;
        for (int i = 0; i < 4; i++) stand.add(0.29 * i, mechanics);
        stand.add(3, mechanics);
        ASSERT_TRUE(stand.rests_within(mechanics == FROND_MECHANICS_ROD ? 10 : 40));
        frond_grab grab = {};
        must(frond_grab_create(stand.plants[0], {0.15, 0.5, 0}, 200, &grab));
        must(frond_grab_move(grab, {0.35, 0.5, 0}));
        int most = 0;
        for (int i = 0; i < 60; i++) {
            stand.steps(1);
            most = std::max(most, stand.report().awake_count);
            EXPECT_FALSE(frond_plant_is_awake(stand.plants[4]));
        }
        EXPECT_GE(most, 2);
        EXPECT_TRUE(stand.rests_within(40));  // while it is held
    }
}

// A board on the tips of two plants keeps them awake until it rests too; after it is removed, they spring back.
TEST(Wake, ComesWhenWhatLayOnAPlantIsTakenAway) {
    ForkedStems stand;
    for (const double z : {-0.1, 0.1}) stand.add(0, FROND_MECHANICS_ROD, z);
    const std::vector<double> alone = stand.places(stand.plants[0]);
    frond_rigid_def def = frond_default_rigid_def();
    def.shape = FROND_SHAPE_BOX;
    def.size = {0.25, 0.01, 0.2};
    def.mass = 4;
    def.friction = 2;
    def.state.position = {0, 0.53, 0};
    frond_rigid board = {};
    must(frond_rigid_create(stand.world, &def, &board));
    ASSERT_TRUE(stand.rests_within(60));
    frond_rigid_state state = {};
    must(frond_rigid_get_state(board, &state));
    ASSERT_GT(state.position.y, 0.4) << "it should lie on the tips";
    const std::vector<double> loaded = stand.places(stand.plants[0]);
    stand.steps(30);
    EXPECT_EQ(stand.places(stand.plants[0]), loaded);
    frond_rigid_destroy(board);
    stand.steps(1);
    EXPECT_EQ(stand.report().awake_count, 2);
    ASSERT_TRUE(stand.rests_within(30));
    const std::vector<double> after = stand.places(stand.plants[0]);
    double sprung = 0;
    for (size_t i = 0; i < after.size(); i++) {
        EXPECT_NEAR(after[i], alone[i], 1e-4);
        sprung = std::max(sprung, std::abs(after[i] - loaded[i]));
    }
    EXPECT_GT(sprung, 2e-4);
}

TEST(Wake, DoesNotComeFromWhatIsRefused) {
    ForkedStems stand;
    const frond_plant plant = stand.add(0);
    const std::vector<double> places = stand.places(plant);
    const int count = int(places.size() / 3);
    const frond_vec3 none = {NAN, 0, 0};
    frond_grab grab = {};
    frond_bond bond = {};
    ASSERT_TRUE(stand.rests_within(10));
    const std::vector<std::pair<const char*, std::function<frond_result()>>> calls = {
        {"effects", [&] { return frond_plant_set_effects(plant, ~0u); }},
        {"mechanics", [&] { return frond_plant_set_mechanics(plant, FROND_MECHANICS_COUNT); }},
        {"integrator", [&] { return frond_plant_set_integrator(plant, FROND_INTEGRATOR_COUNT); }},
        {"state", [&] { return frond_plant_set_state(plant, places.data(), nullptr, count - 1); }},
        {"lasting", [&] { return frond_plant_set_plastic(plant, nullptr, 1); }},
        {"pin", [&] { return frond_plant_pin(plant, -1); }},
        {"unpin", [&] { return frond_plant_unpin(plant, count); }},
        {"move_pin",
         [&] {
             return frond_plant_move_pin(plant, count - 1, {0, 0, 0});
         }},
        {"add_force", [&] { return frond_plant_add_force(plant, count - 1, none); }},
        {"break", [&] { return frond_plant_break(plant, 1000); }},
        {"grab", [&] { return frond_grab_create(plant, none, 10, &grab); }},
        {"bond", [&] { return frond_bond_create(plant, none, {}, &bond); }},
    };
    for (const auto& [name, refused] : calls) {
        EXPECT_NE(refused(), FROND_OK) << name;
        EXPECT_FALSE(frond_plant_is_awake(plant)) << name;
    }
    // Pins are reported during sleep too.
    const auto holds = [&](int i) {
        const frond_vec3 here = {places[size_t(3 * i)], places[size_t(3 * i + 1)], places[size_t(3 * i + 2)]};
        return frond_plant_move_pin(plant, i, here) == FROND_OK;
    };
    int node = 0;
    while (node < count && !holds(node)) node++;
    EXPECT_LT(node, count);
    EXPECT_TRUE(frond_plant_is_awake(plant));
}

TEST(Wake, TakesNoStaleHandleAndNoAbsurdDistance) {
    EXPECT_FALSE(frond_plant_is_awake({}));
    EXPECT_EQ(frond_plant_wake({}), FROND_RESULT_BAD_HANDLE);
    for (const double bad : {-1.0, 1.0, double(NAN), double(INFINITY)}) {
        frond_world_def def = frond_default_world_def();
        def.sleep_distance = bad;
        frond_world world = {};
        EXPECT_EQ(frond_world_create(&def, &world), FROND_RESULT_BAD_ARGUMENT);
        EXPECT_EQ(world.id, 0u);
    }
}

}  // namespace sleep_tests
