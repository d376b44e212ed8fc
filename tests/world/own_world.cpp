// Plants in a world of Frond's own, through the C API.
#include <cmath>

#include "support/sanitized.hpp"
#include "support/stems.hpp"

static std::vector<double> positions_of(frond_plant plant) {
    std::vector<double> positions(size_t(3 * frond_plant_get_node_count(plant)));
    EXPECT_EQ(frond_plant_get_state(plant, positions.data(), nullptr, int(positions.size() / 3)), FROND_OK);
    return positions;
}

static double height_of_tip(frond_plant plant) {
    frond_vec3 tip = {};
    EXPECT_EQ(frond_plant_get_tip(plant, &tip), FROND_OK) << frond_last_error();
    return tip.y;
}

static void step(frond_world world, int steps) {
    for (int i = 0; i < steps; i++) ASSERT_EQ(frond_world_step(world, 1.0 / 60), FROND_OK) << frond_last_error();
}

TEST(OwnWorld, AnUnpinnedPlantFallsFreely) {
    frond_plant_def def = frond_default_plant_def();
    def.root_height = -1;
    def.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    def.effects = FROND_EFFECT_GRAVITY | FROND_EFFECT_SURFACE;
    def.position = {10, 5, -3};
    SmallWorld small(def);
    const std::vector<double> before = positions_of(small.plant);
    step(small.world, 30);
    const std::vector<double> after = positions_of(small.plant);
    // Implicit Euler's recurrence: v_n = n h g, x_n = h^2 g n (n + 1) / 2.
    const double fall = -9.81 / 3600 * 30 * 31 / 2;
    for (size_t i = 0; i < before.size(); i += 3) {
        EXPECT_NEAR(after[i], before[i], 1e-9);
        EXPECT_NEAR(after[i + 1] - before[i + 1], fall, 1e-6);  // Bullet's step has single precision
        EXPECT_NEAR(after[i + 2], before[i + 2], 1e-9);
    }
}

TEST(OwnWorld, GravityOffMeansNoMotion) {
    frond_plant_def def = frond_default_plant_def();
    def.effects = FROND_EFFECT_ALL & ~uint32_t(FROND_EFFECT_GRAVITY);
    SmallWorld small(def);
    const std::vector<double> before = positions_of(small.plant);
    step(small.world, 20);
    const std::vector<double> after = positions_of(small.plant);
    for (size_t i = 0; i < before.size(); i++) EXPECT_NEAR(after[i], before[i], 1e-12);
}

TEST(OwnWorld, APlantStandsAsItWasModelledUnderGravity) {
    for (int mechanics = 0; mechanics < FROND_MECHANICS_SPRING_CHAIN; mechanics++) {  // the last one has no rest shape
        frond_plant_def def = frond_default_plant_def();
        def.mechanics = frond_mechanics(mechanics);
        SmallWorld stands(def, 1e7, FROND_REST_STANDS_AS_MODELLED), droops(def, 1e7, FROND_REST_WITHOUT_GRAVITY);
        const std::vector<double> modelled = positions_of(stands.plant);
        double largest[2] = {0, 0};
        for (SmallWorld* small : {&stands, &droops}) {
            step(small->world, SANITIZED ? 40 : 120);
            const std::vector<double> now = positions_of(small->plant);
            double& move = largest[small == &droops];
            for (size_t i = 0; i < now.size(); i++) move = std::max(move, std::abs(now[i] - modelled[i]));
        }
        EXPECT_LT(largest[0], 0.001 * 0.6) << frond_mechanics_name(def.mechanics);
        EXPECT_GT(largest[1], 0.01 * 0.6) << frond_mechanics_name(def.mechanics);
    }
}

TEST(OwnWorld, AMaskOnTheWorldSwitchesAnEffectOffForAllPlants) {
    SmallWorld small;
    ASSERT_EQ(frond_world_set_effects(small.world, FROND_EFFECT_SURFACE), FROND_OK);
    const std::vector<double> before = positions_of(small.plant);
    step(small.world, 5);
    const std::vector<double> after = positions_of(small.plant);
    for (size_t i = 0; i < before.size(); i++) EXPECT_NEAR(after[i], before[i], 1e-12);
}

// Two plants in contact, in wind, pulled and struck, so that most effects have something to do: each is switched off
// and on again while they move, on the world and on a plant.
TEST(OwnWorld, EveryEffectIsSwitchedWhileItRuns) {
    // The other effects are reported with those that they belong to, or have nothing to do here.
    constexpr frond_effects TOLD = FROND_EFFECT_GRAVITY | FROND_EFFECT_DAMPING | FROND_EFFECT_USER_FORCE |
                                   FROND_EFFECT_SURFACE | FROND_EFFECT_NORMALS | FROND_EFFECT_RIGID_CONTACT |
                                   FROND_EFFECT_FRICTION | FROND_EFFECT_TWO_WAY | FROND_EFFECT_PLASTICITY |
                                   FROND_EFFECT_PLANT_CONTACT | FROND_EFFECT_WIND | FROND_EFFECT_AIR_DRAG;
    for (int bit = 0; bit < FROND_EFFECT_COUNT; bit++) {
        const frond_effects effect = 1u << bit;
        frond_plant_def def = frond_default_plant_def();
        def.effects = FROND_EFFECT_ALL;
        SmallWorld small(def, 0, FROND_REST_STANDS_AS_MODELLED);
        def.position = {0.03, 0, 0};
        frond_plant other = {};
        ASSERT_EQ(frond_plant_create(small.world, small.model, &def, &other), FROND_OK);
        frond_wind_def wind = frond_default_wind_def();
        wind.velocity = {4, 0, 0};
        ASSERT_EQ(frond_world_set_wind(small.world, &wind), FROND_OK);
        frond_rigid_def box = frond_default_rigid_def();
        box.mass = 0;
        box.state.position = {0, 0.4, 0.11};
        frond_rigid rigid = {};
        ASSERT_EQ(frond_rigid_create(small.world, &box, &rigid), FROND_OK);
        const auto run = [&] {
            frond_effects seen = 0;
            for (int i = 0; i < 4; i++) {
                EXPECT_EQ(frond_plant_add_force(small.plant, frond_plant_get_node_count(small.plant) - 1, {0, 0, 2}),
                          FROND_OK);
                step(small.world, 1);
                for (frond_plant plant : {small.plant, other}) {
                    frond_surface_view view = {};
                    EXPECT_EQ(frond_plant_get_surface(plant, &view), FROND_OK);
                }
                frond_report report = {};
                EXPECT_EQ(frond_world_get_report(small.world, &report), FROND_OK);
                EXPECT_EQ(report.trouble & FROND_TROUBLE_REWOUND, 0u) << frond_effect_name(effect);
                seen |= report.effects_run;
            }
            return seen;
        };
        EXPECT_EQ(run() & effect & TOLD, effect & TOLD) << frond_effect_name(effect) << ", at first";
        ASSERT_EQ(frond_world_set_effects(small.world, FROND_EFFECT_ALL & ~effect), FROND_OK);
        EXPECT_EQ(run() & effect, 0u) << frond_effect_name(effect) << ", off on the world";
        ASSERT_EQ(frond_world_set_effects(small.world, FROND_EFFECT_ALL), FROND_OK);
        EXPECT_EQ(run() & effect & TOLD, effect & TOLD) << frond_effect_name(effect) << ", on again";
        for (frond_plant plant : {small.plant, other})
            ASSERT_EQ(frond_plant_set_effects(plant, FROND_EFFECT_ALL & ~effect), FROND_OK);
        const frond_effects world_tells = FROND_EFFECT_FRICTION | FROND_EFFECT_TWO_WAY;  // reported if anything touches
        EXPECT_EQ(run() & effect & ~world_tells, 0u) << frond_effect_name(effect) << ", off on the plants";
    }
}

TEST(OwnWorld, AGrabbedPlantFollowsAndSwingsBackWhenLetGo) {
    frond_plant_def def = frond_default_plant_def();
    def.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;        // its numerical damping brings the plant to rest in time
    def.effects &= ~(frond_effects)FROND_EFFECT_PLASTICITY;  // so soft a stem would keep a third of that bend
    SmallWorld small(def, 1e7);
    step(small.world, 120);
    frond_vec3 tip, released;
    ASSERT_EQ(frond_plant_get_tip(small.plant, &tip), FROND_OK);
    frond_grab grab;
    ASSERT_EQ(frond_grab_create(small.plant, tip, 200, &grab), FROND_OK) << frond_last_error();
    ASSERT_EQ(frond_grab_move(grab, {tip.x + 0.3, tip.y, tip.z}), FROND_OK);
    step(small.world, 60);
    frond_vec3 held, target, force;
    ASSERT_EQ(frond_grab_get(grab, &held, &target, &force), FROND_OK);
    EXPECT_GT(held.x, tip.x + 0.02);
    EXPECT_NEAR(force.x, 200 * (target.x - held.x), 1e-9);
    frond_grab_destroy(grab);
    step(small.world, 600);
    ASSERT_EQ(frond_plant_get_tip(small.plant, &released), FROND_OK);
    EXPECT_NEAR(released.x, tip.x, 0.005);
}

TEST(OwnWorld, APinnedNodeStaysAndCanBeMoved) {
    SmallWorld small;
    const std::vector<double> before = positions_of(small.plant);
    int top = 0;
    for (int i = 0; i < int(before.size() / 3); i++)
        if (before[size_t(3 * i + 1)] > before[size_t(3 * top + 1)]) top = i;
    const size_t at = size_t(3 * top);
    ASSERT_EQ(frond_plant_pin(small.plant, top), FROND_OK);
    step(small.world, 10);
    std::vector<double> now = positions_of(small.plant);
    for (size_t axis = 0; axis < 3; axis++) EXPECT_NEAR(now[at + axis], before[at + axis], 1e-12);
    ASSERT_EQ(frond_plant_move_pin(small.plant, top, {before[at] + 0.05, before[at + 1], before[at + 2]}), FROND_OK);
    step(small.world, 1);
    now = positions_of(small.plant);
    EXPECT_NEAR(now[at], before[at] + 0.05, 1e-12);
}

TEST(OwnWorld, AForceActsForOneStepOnly) {
    frond_plant_def def = frond_default_plant_def();
    def.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;  // the step's whole momentum is present at its end
    def.root_height = -1;
    def.effects = FROND_EFFECT_USER_FORCE;
    SmallWorld small(def);
    frond_model_info info;
    ASSERT_EQ(frond_model_get_info(small.model, &info), FROND_OK);
    const int count = frond_plant_get_node_count(small.plant);
    for (int i = 0; i < count; i++) ASSERT_EQ(frond_plant_add_force(small.plant, i, {1.0 / count, 0, 0}), FROND_OK);
    step(small.world, 1);
    frond_energy energy;
    frond_plant_get_energy(small.plant, &energy);
    EXPECT_GT(energy.kinetic, 0);
    // One newton for 1/60 s gives the whole plant that momentum, which it keeps afterwards.
    const std::vector<double> first = positions_of(small.plant);
    step(small.world, 60);
    const std::vector<double> later = positions_of(small.plant);
    double way = 0;
    for (size_t i = 0; i < first.size(); i += 3) way += (later[i] - first[i]) * 3 / double(first.size());
    EXPECT_NEAR(way, 1.0 / 60 / info.mass, 0.4 / 60 / info.mass);
}

TEST(OwnWorld, TheSameCallsGiveTheSameBits) {
    uint64_t hashes[2];
    for (uint64_t& hash : hashes) {
        SmallWorld small;
        frond_grab grab;
        ASSERT_EQ(frond_grab_create(small.plant, {0, 0.6, 0}, 50, &grab), FROND_OK);
        ASSERT_EQ(frond_grab_move(grab, {0.2, 0.5, 0.1}), FROND_OK);
        step(small.world, 50);
        ASSERT_EQ(frond_world_get_state_hash(small.world, &hash), FROND_OK);
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(OwnWorld, APlantMovesAlikeWhereverItStandsAndHoweverItIsTurned) {
    frond_plant_def def = frond_default_plant_def();
    def.effects = FROND_EFFECT_GRAVITY | FROND_EFFECT_DAMPING | FROND_EFFECT_SURFACE;
    SmallWorld home(def);
    def.position = {10000, -20, 3000};
    def.rotation = {0, 1, 0, 0};  // half a turn about y
    SmallWorld away(def);
    step(home.world, 40);
    step(away.world, 40);
    const std::vector<double> a = positions_of(home.plant), b = positions_of(away.plant);
    for (size_t i = 0; i < a.size(); i += 3) {
        EXPECT_NEAR(10000 - a[i], b[i], 1e-8);
        EXPECT_NEAR(a[i + 1] - 20, b[i + 1], 1e-8);
        EXPECT_NEAR(3000 - a[i + 2], b[i + 2], 1e-8);
    }
}

TEST(OwnWorld, ARayFindsTheCapsulesAfterTheyMoved) {
    SmallWorld small;
    step(small.world, 3);
    frond_ray_hit hit;
    ASSERT_EQ(frond_world_cast_ray(small.world, {-2, 0.15, 0}, {1, 0, 0}, 10, &hit), FROND_OK);
    EXPECT_EQ(hit.plant.id, small.plant.id);
    EXPECT_NEAR(hit.distance, 2, 0.05);
    EXPECT_GE(hit.capsule, 0);
    EXPECT_LT(hit.capsule, frond_plant_get_capsule_count(small.plant));
    ASSERT_EQ(frond_world_cast_ray(small.world, {-2, 3, 0}, {1, 0, 0}, 10, &hit), FROND_OK);
    EXPECT_EQ(hit.plant.id, 0u);
}

TEST(OwnWorld, TheSurfaceIsTheModelAtRestAndFiniteInMotion) {
    SmallWorld small;
    frond_surface_view view;
    ASSERT_EQ(frond_plant_get_surface(small.plant, &view), FROND_OK);
    frond_model_info info;
    ASSERT_EQ(frond_model_get_info(small.model, &info), FROND_OK);
    EXPECT_EQ(view.vertex_count, info.vertex_count);
    float lower = 1e9f, upper = -1e9f;
    for (int v = 0; v < view.vertex_count; v++) {
        lower = std::min(lower, view.positions[3 * v + 1]);
        upper = std::max(upper, view.positions[3 * v + 1]);
    }
    EXPECT_NEAR(lower, info.lower.y, 1e-5);
    EXPECT_NEAR(upper, info.upper.y, 1e-5);
    step(small.world, 20);
    ASSERT_EQ(frond_plant_get_surface(small.plant, &view), FROND_OK);
    for (int v = 0; v < view.vertex_count; v++) {
        const float* n = view.normals + 3 * v;
        EXPECT_TRUE(std::isfinite(view.positions[3 * v]));
        EXPECT_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-4);
    }
    EXPECT_GT(height_of_tip(small.plant), 0.3);
}

TEST(OwnWorld, AnAbsurdForceIsRewoundAndNeverShowsANaN) {
    SmallWorld small;
    step(small.world, 2);
    uint32_t trouble = 0;
    for (int i = 0; i < 20; i++) {
        ASSERT_EQ(frond_plant_add_force(small.plant, i % frond_plant_get_node_count(small.plant), {1e9, 1e9, -1e9}),
                  FROND_OK);
        ASSERT_EQ(frond_world_step(small.world, 1.0 / 60), FROND_OK);
        for (double value : positions_of(small.plant)) ASSERT_TRUE(std::isfinite(value));
        frond_report report;
        ASSERT_EQ(frond_world_get_report(small.world, &report), FROND_OK);
        trouble |= report.trouble;
    }
    EXPECT_TRUE(trouble & FROND_TROUBLE_REWOUND);
}

TEST(OwnWorld, PlantsComeAndGoWhileItRuns) {
    SmallWorld small;
    frond_plant_def def = frond_default_plant_def();
    std::vector<frond_plant> plants;
    for (int round = 0; round < (SANITIZED ? 9 : 30); round++) {
        frond_plant plant;
        def.position.x = 0.1 * (round % 5);  // some overlap
        ASSERT_EQ(frond_plant_create(small.world, small.model, &def, &plant), FROND_OK);
        plants.push_back(plant);
        if (round % 3 == 2) {
            frond_plant_destroy(plants[size_t(round / 2)]);
        }
        step(small.world, 1);
    }
    frond_model_destroy(small.model);  // plants keep what they need
    step(small.world, 3);
    frond_report report;
    ASSERT_EQ(frond_world_get_report(small.world, &report), FROND_OK);
    EXPECT_GT(report.plant_count, SANITIZED ? 5 : 15);
    frond_profile profile;
    ASSERT_EQ(frond_world_get_profile(small.world, &profile), FROND_OK);
    EXPECT_GT(profile.ms_step, 0);
}
