// Plants that are moved, reset and queried; worlds with shifted origins; surfaces of the previous frame.
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <LinearMath/btScalar.h>

#include "support/stems.hpp"

namespace place_tests {

constexpr double H = 1.0 / 60;
constexpr bool IS_DOUBLE = sizeof(btScalar) == sizeof(double);

void step(frond_world world, int count) {
    for (int i = 0; i < count; i++) ASSERT_EQ(frond_world_step(world, H), FROND_OK) << frond_last_error();
}

std::vector<double> places_of(frond_plant plant) {
    std::vector<double> x(3 * size_t(frond_plant_get_node_count(plant)));
    EXPECT_EQ(frond_plant_get_state(plant, x.data(), nullptr, int(x.size() / 3)), FROND_OK);
    return x;
}

std::vector<double> velocities_of(frond_plant plant) {
    std::vector<double> v(3 * size_t(frond_plant_get_node_count(plant)));
    EXPECT_EQ(frond_plant_get_state(plant, nullptr, v.data(), int(v.size() / 3)), FROND_OK);
    return v;
}

std::vector<float> surface_of(frond_plant plant) {
    frond_surface_view view = {};
    EXPECT_EQ(frond_plant_get_surface(plant, &view), FROND_OK);
    return {view.positions, view.positions + 3 * size_t(view.vertex_count)};
}

std::vector<float> surface_before(frond_plant plant, size_t count) {
    const float* positions = nullptr;
    EXPECT_EQ(frond_plant_get_previous_positions(plant, &positions), FROND_OK);
    return {positions, positions + count};
}

// Returns the largest difference after the second is moved by `way`.
template <class Number>
double difference(const std::vector<Number>& a, const std::vector<Number>& b, const frond_vec3& way = {0, 0, 0}) {
    EXPECT_EQ(a.size(), b.size());
    const double by[] = {way.x, way.y, way.z};
    double most = 0;
    for (size_t i = 0; i < a.size(); i++) most = std::max(most, std::abs(double(a[i]) - double(b[i]) - by[i % 3]));
    return most;
}

// Returns the rotation by an angle about the vertical axis.
frond_quat about_y(double angle) {
    return {0, std::sin(angle / 2), 0, std::cos(angle / 2)};
}

frond_plant_def def_with(frond_mechanics mechanics) {
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = mechanics;
    return def;
}

struct EveryPlace : testing::TestWithParam<frond_mechanics> {
    frond_plant_def def() const { return def_with(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Place, EveryPlace,
                         testing::Values(FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_TET_NEOHOOKEAN,
                                         FROND_MECHANICS_ROD, FROND_MECHANICS_SPRING_CHAIN),
                         [](const auto& info) { return std::string(frond_mechanics_name(info.param)); });

TEST_P(EveryPlace, APlantAtRestStaysAtRestElsewhere) {
    SmallWorld small(def(), 0, FROND_REST_STANDS_AS_MODELLED);
    step(small.world, 120);
    const std::vector<double> before = places_of(small.plant);
    ASSERT_EQ(frond_plant_set_transform(small.plant, {30, 2, -7}, {0, 0, 0, 2}), FROND_OK) << frond_last_error();
    EXPECT_TRUE(frond_plant_is_awake(small.plant));
    EXPECT_LT(difference(places_of(small.plant), before, {30, 2, -7}), 1e-12);
    step(small.world, 60);
    EXPECT_LT(difference(places_of(small.plant), before, {30, 2, -7}), 2e-5);
    // Rotated about the vertical axis as well, it has the same forces.
    ASSERT_EQ(frond_plant_set_transform(small.plant, {0, 0, 0}, about_y(2)), FROND_OK);
    frond_vec3 tip = {}, still = {};
    ASSERT_EQ(frond_plant_get_tip(small.plant, &tip), FROND_OK);
    step(small.world, 60);
    ASSERT_EQ(frond_plant_get_tip(small.plant, &still), FROND_OK);
    EXPECT_LT(std::hypot(tip.x - still.x, tip.y - still.y, tip.z - still.z), 2e-5);
    frond_report report = {};
    ASSERT_EQ(frond_world_get_report(small.world, &report), FROND_OK);
    EXPECT_EQ(report.trouble, 0u);
}

TEST_P(EveryPlace, AMovingPlantGoesOnThereAsItWouldHere) {
    SmallWorld here(def()), there(def());
    for (SmallWorld* small : {&here, &there}) {
        ASSERT_EQ(frond_plant_add_force(small->plant, frond_plant_get_node_count(small->plant) - 1, {3, 0, 1}),
                  FROND_OK);
        step(small->world, 5);
    }
    const frond_vec3 way = {-4, 1, 8};
    ASSERT_EQ(frond_plant_set_transform(there.plant, way, {0, 0, 0, 1}), FROND_OK);
    EXPECT_LT(difference(velocities_of(there.plant), velocities_of(here.plant)), 1e-12);
    step(here.world, 30);
    step(there.world, 30);
    EXPECT_LT(difference(places_of(there.plant), places_of(here.plant), way), 1e-9);
}

TEST(Place, VelocitiesAndPinsTurnWithThePlant) {
    SmallWorld small;
    const int node = frond_plant_get_node_count(small.plant) - 1;
    ASSERT_EQ(frond_plant_add_force(small.plant, node, {5, 0, 0}), FROND_OK);
    step(small.world, 3);
    ASSERT_EQ(frond_plant_pin(small.plant, node), FROND_OK);
    const std::vector<double> v = velocities_of(small.plant), x = places_of(small.plant);
    ASSERT_EQ(frond_plant_set_transform(small.plant, {0, 0, 0}, about_y(M_PI / 2)), FROND_OK);
    const std::vector<double> turned = velocities_of(small.plant), at = places_of(small.plant);
    for (size_t i = 0; i < v.size(); i += 3) {
        ASSERT_NEAR(turned[i], v[i + 2], 1e-12);
        ASSERT_NEAR(turned[i + 2], -v[i], 1e-12);
        ASSERT_NEAR(at[i], x[i + 2], 1e-12);
    }
    step(small.world, 10);
    const std::vector<double> later = places_of(small.plant);
    for (int k = 0; k < 3; k++) EXPECT_NEAR(later[size_t(3 * node + k)], at[size_t(3 * node + k)], 1e-9);
}

TEST(Place, FragmentsComeAlong) {
    SmallWorld small;
    ASSERT_EQ(frond_plant_break(small.plant, frond_plant_get_capsule_count(small.plant) - 1), FROND_OK);
    step(small.world, 10);
    frond_fragment fragment = {};
    ASSERT_EQ(frond_plant_get_fragment(small.plant, 0, &fragment), FROND_OK);
    frond_rigid_state before = {}, after = {};
    ASSERT_EQ(frond_rigid_get_state(fragment.rigid, &before), FROND_OK);
    const std::vector<float> drawn = surface_of(small.plant);
    ASSERT_EQ(frond_plant_set_transform(small.plant, {10, 0, 0}, {0, 0, 0, 1}), FROND_OK);
    ASSERT_EQ(frond_rigid_get_state(fragment.rigid, &after), FROND_OK);
    EXPECT_NEAR(after.position.x - before.position.x, 10, 1e-5);
    EXPECT_NEAR(after.position.y, before.position.y, 1e-6);
    EXPECT_EQ(after.velocity.y, before.velocity.y);
    EXPECT_LT(difference(surface_of(small.plant), drawn, {10, 0, 0}), 1e-5);
}

TEST_P(EveryPlace, AResetPlantIsANewOneToTheBit) {
    SmallWorld used(def());
    frond_world fresh = {};
    const frond_world_def world_def = frond_default_world_def();
    ASSERT_EQ(frond_world_create(&world_def, &fresh), FROND_OK);
    const int node = frond_plant_get_node_count(used.plant) - 1;
    for (int i = 0; i < 30; i++) {
        ASSERT_EQ(frond_plant_add_force(used.plant, node, {20, 0, 5}), FROND_OK);
        step(used.world, 1);
        step(fresh, 1);
    }
    ASSERT_EQ(frond_plant_pin(used.plant, node), FROND_OK);
    ASSERT_EQ(frond_plant_break(used.plant, 0), FROND_OK);
    step(used.world, 10);
    step(fresh, 10);
    ASSERT_EQ(frond_plant_reset(used.plant), FROND_OK) << frond_last_error();
    EXPECT_EQ(frond_plant_get_fragment_count(used.plant), 0);
    EXPECT_EQ(frond_plant_get_plastic_count(used.plant), 0);
    frond_plant twin = {};
    frond_plant_def twin_def = {};
    ASSERT_EQ(frond_plant_get_def(used.plant, &twin_def), FROND_OK);
    ASSERT_EQ(frond_plant_create(fresh, used.model, &twin_def, &twin), FROND_OK) << frond_last_error();
    for (int i = 0; i < 90; i++) {
        ASSERT_EQ(places_of(used.plant), places_of(twin)) << i;
        ASSERT_EQ(velocities_of(used.plant), velocities_of(twin)) << i;
        ASSERT_EQ(surface_of(used.plant), surface_of(twin)) << i;
        step(used.world, 1);
        step(fresh, 1);
    }
    uint64_t a = 0, b = 1;
    ASSERT_EQ(frond_world_get_state_hash(used.world, &a), FROND_OK);
    ASSERT_EQ(frond_world_get_state_hash(fresh, &b), FROND_OK);
    EXPECT_EQ(a, b);
    frond_world_destroy(fresh);
}

TEST(Place, AResetPlantKeepsItsPlaceItsGrabAndItsSleep) {
    frond_plant_def def = frond_default_plant_def();
    def.starts_asleep = true;
    SmallWorld small(def, 0, FROND_REST_STANDS_AS_MODELLED);
    ASSERT_EQ(frond_plant_set_transform(small.plant, {3, 0, 1}, about_y(1)), FROND_OK);
    EXPECT_TRUE(frond_plant_is_awake(small.plant));
    const std::vector<double> before = places_of(small.plant);
    frond_grab grab = {};
    ASSERT_EQ(frond_grab_create(small.plant, {3, 0.6, 1}, 10, &grab), FROND_OK);
    ASSERT_EQ(frond_grab_move(grab, {4, 0.6, 1}), FROND_OK);
    step(small.world, 20);
    EXPECT_GT(difference(places_of(small.plant), before), 0.01);
    ASSERT_EQ(frond_plant_reset(small.plant), FROND_OK);
    EXPECT_FALSE(frond_plant_is_awake(small.plant));
    EXPECT_LT(difference(places_of(small.plant), before), 1e-12);
    EXPECT_TRUE(frond_grab_is_valid(grab));
    ASSERT_EQ(frond_plant_wake(small.plant), FROND_OK);
    step(small.world, 20);
    EXPECT_GT(difference(places_of(small.plant), before), 0.01);
}

TEST(Place, ADefIsThatOfThePlantAsItIsSet) {
    frond_plant_def def = frond_default_plant_def(), now = {};
    int user = 0;
    def.position = {1, 2, 3};
    def.rotation = {0, 0, 0, 5};
    def.mechanics = FROND_MECHANICS_ROD;
    def.integrator = FROND_INTEGRATOR_SDIRK2;
    def.mass_damping = 0.3;
    def.stiffness_damping = 0.004;
    def.material_damping = 0.7;
    def.root_height = 0.05;
    def.effects = FROND_EFFECT_GRAVITY | FROND_EFFECT_SURFACE;
    def.starts_asleep = true;
    def.group = 4;
    def.mask = 3;
    def.user = &user;
    def.tuning.linear_solver = FROND_LINEAR_SOLVER_DIRECT;
    def.tuning.linear_iterations = 77;
    def.tuning.linear_tolerance = 1e-7;
    def.tuning.mass = FROND_MASS_CONSISTENT;
    def.tuning.newton_iterations = 3;
    def.tuning.newton_tolerance = 1e-5;
    def.tuning.spectral_radius = 0.6;
    def.tuning.max_substeps = 4;
    def.tuning.substep_tolerance = 1e-3;
    SmallWorld small(def);
    ASSERT_EQ(frond_plant_get_def(small.plant, &now), FROND_OK);
    def.rotation.w = 1;
    EXPECT_EQ(std::memcmp(&now.position, &def.position, sizeof def.position), 0);
    EXPECT_EQ(std::memcmp(&now.rotation, &def.rotation, sizeof def.rotation), 0);
    EXPECT_EQ(std::memcmp(&now.tuning, &def.tuning, sizeof def.tuning), 0);
    EXPECT_EQ(now.mechanics, def.mechanics);
    EXPECT_EQ(now.element_order, def.element_order);
    EXPECT_EQ(now.integrator, def.integrator);
    EXPECT_EQ(now.mass_damping, def.mass_damping);
    EXPECT_EQ(now.stiffness_damping, def.stiffness_damping);
    EXPECT_EQ(now.material_damping, def.material_damping);
    EXPECT_EQ(now.root_height, def.root_height);
    EXPECT_EQ(now.effects, def.effects);
    EXPECT_EQ(now.starts_asleep, def.starts_asleep);
    EXPECT_EQ(now.group, def.group);
    EXPECT_EQ(now.mask, def.mask);
    EXPECT_EQ(now.user, def.user);
    // The def includes changes made since creation.
    ASSERT_EQ(frond_plant_set_mechanics(small.plant, FROND_MECHANICS_TET_LINEAR), FROND_OK);
    ASSERT_EQ(frond_plant_set_integrator(small.plant, FROND_INTEGRATOR_BDF2), FROND_OK);
    ASSERT_EQ(frond_plant_set_effects(small.plant, FROND_EFFECT_DEFAULT), FROND_OK);
    ASSERT_EQ(frond_plant_set_transform(small.plant, {7, 8, 9}, {0, 0, 0, 1}), FROND_OK);
    ASSERT_EQ(frond_plant_get_def(small.plant, &now), FROND_OK);
    EXPECT_EQ(now.mechanics, FROND_MECHANICS_TET_LINEAR);
    EXPECT_EQ(now.integrator, FROND_INTEGRATOR_BDF2);
    EXPECT_EQ(now.effects, frond_effects(FROND_EFFECT_DEFAULT));
    EXPECT_EQ(now.position.y, 8);
    EXPECT_EQ(now.group, 4);
    frond_plant other = {};
    EXPECT_EQ(frond_plant_create(small.world, small.model, &now, &other), FROND_OK) << frond_last_error();
}

// Each world has gusts, a ball on the ground, a grab and a viewer.
TEST_P(EveryPlace, AWorldGoesOnAsItWasAfterItsOriginMoved) {
    const frond_vec3 origin = {512, -16, 2048};  // exact in both precisions
    SmallWorld here(def()), there(def());
    const double rounding = IS_DOUBLE ? 1e-7 : 2e-3;
    frond_rigid balls[2] = {};
    frond_grab grabs[2] = {};
    int n = 0;
    for (SmallWorld* small : {&here, &there}) {
        frond_wind_def wind = frond_default_wind_def();
        wind.velocity = {4, 0, 1};
        ASSERT_EQ(frond_world_set_wind(small->world, &wind), FROND_OK);
        ASSERT_EQ(frond_world_set_viewer(small->world, {1, 1, 1}), FROND_OK);
        frond_rigid_def ground = frond_default_rigid_def();
        ground.shape = FROND_SHAPE_PLANE;
        frond_rigid plane = {};
        ASSERT_EQ(frond_rigid_create(small->world, &ground, &plane), FROND_OK);
        frond_rigid_def ball = frond_default_rigid_def();
        ball.size.x = 0.05;
        ball.mass = 0.1;
        ball.state.position = {-1, 0.05, 0};
        ASSERT_EQ(frond_rigid_create(small->world, &ball, &balls[n]), FROND_OK);
        ASSERT_EQ(frond_grab_create(small->plant, {0.2, 0.45, 0}, 5, &grabs[n]), FROND_OK);
        ASSERT_EQ(frond_grab_move(grabs[n], {0.3, 0.5, 0.1}), FROND_OK);
        step(small->world, 10);
        n++;
    }
    ASSERT_EQ(frond_world_shift_origin(there.world, origin), FROND_OK) << frond_last_error();
    const frond_vec3 way = {-origin.x, -origin.y, -origin.z};
    EXPECT_LT(difference(places_of(there.plant), places_of(here.plant), way), 1e-10);
    EXPECT_LT(difference(surface_of(there.plant), surface_of(here.plant), way), 2e-4);  // floats at that distance
    for (int i = 0; i < 60; i++) {
        const frond_vec3 point = {0.1 * i, 2, -3}, moved = {point.x + way.x, point.y + way.y, point.z + way.z};
        frond_vec3 a = {}, b = {};
        ASSERT_EQ(frond_world_get_wind_at(here.world, point, &a), FROND_OK);
        ASSERT_EQ(frond_world_get_wind_at(there.world, moved, &b), FROND_OK);
        ASSERT_NEAR(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z), 0, 1e-6) << i;
        step(here.world, 1);
        step(there.world, 1);
        ASSERT_LT(difference(places_of(there.plant), places_of(here.plant), way), rounding) << i;
    }
    frond_rigid_state lies[2] = {};
    frond_vec3 targets[2] = {};
    for (int k : {0, 1}) {
        ASSERT_EQ(frond_rigid_get_state(balls[k], &lies[k]), FROND_OK);
        ASSERT_EQ(frond_grab_get(grabs[k], nullptr, &targets[k], nullptr), FROND_OK);
    }
    EXPECT_NEAR(lies[1].position.x - lies[0].position.x, way.x, 1e-3);
    EXPECT_NEAR(lies[1].position.y - lies[0].position.y, way.y, 1e-3);
    EXPECT_EQ(targets[1].x, targets[0].x + way.x);
    // A new wind definition keeps the shifted gusts.
    frond_wind_def wind = frond_default_wind_def();
    wind.velocity = {4, 0, 1};
    wind.ground_height = way.y;
    frond_vec3 a = {}, b = {};
    ASSERT_EQ(frond_world_get_wind_at(there.world, {way.x, way.y + 3, way.z}, &a), FROND_OK);
    ASSERT_EQ(frond_world_set_wind(there.world, &wind), FROND_OK);
    ASSERT_EQ(frond_world_get_wind_at(there.world, {way.x, way.y + 3, way.z}, &b), FROND_OK);
    EXPECT_NEAR(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z), 0, 1e-6);
}

TEST(Place, WhatSleepsDoesNotWakeWhenTheOriginMoves) {
    frond_plant_def def = frond_default_plant_def();
    SmallWorld small(def, 0, FROND_REST_STANDS_AS_MODELLED);
    for (int i = 0; i < 600 && frond_plant_is_awake(small.plant); i++) step(small.world, 1);
    ASSERT_FALSE(frond_plant_is_awake(small.plant));
    const std::vector<double> before = places_of(small.plant);
    const std::vector<float> drawn = surface_of(small.plant);
    ASSERT_EQ(frond_world_shift_origin(small.world, {100, 0, 0}), FROND_OK);
    step(small.world, 30);
    EXPECT_FALSE(frond_plant_is_awake(small.plant));
    EXPECT_LT(difference(places_of(small.plant), before, {-100, 0, 0}), 1e-12);
    EXPECT_LT(difference(surface_of(small.plant), drawn, {-100, 0, 0}), 2e-5);
    // A ray finds the plant at its new position.
    frond_ray_hit hit = {};
    ASSERT_EQ(frond_world_cast_ray(small.world, {-101, 0.2, 0}, {1, 0, 0}, 5, &hit), FROND_OK);
    EXPECT_EQ(hit.plant.id, small.plant.id);
}

TEST(Place, MotionVectorsReachFromTheFrameBefore) {
    SmallWorld small;
    const std::vector<float> first = surface_of(small.plant);
    EXPECT_EQ(surface_before(small.plant, first.size()), first);  // first query
    ASSERT_EQ(frond_plant_add_force(small.plant, frond_plant_get_node_count(small.plant) - 1, {5, 0, 0}), FROND_OK);
    std::vector<float> last = first;
    for (int frame = 0; frame < 5; frame++) {
        step(small.world, 2);
        const std::vector<float> now = surface_of(small.plant);
        EXPECT_NE(now, last);
        // Repeated queries within a frame return the same.
        EXPECT_EQ(surface_before(small.plant, now.size()), last);
        EXPECT_EQ(surface_of(small.plant), now);
        EXPECT_EQ(surface_before(small.plant, now.size()), last);
        last = now;
    }
    // The same holds between steps.
    ASSERT_EQ(frond_world_set_interpolation(small.world, 0.5), FROND_OK);
    const std::vector<float> between = surface_of(small.plant);
    EXPECT_EQ(surface_before(small.plant, last.size()), last);
    EXPECT_NE(between, last);
    ASSERT_EQ(frond_world_set_interpolation(small.world, 1), FROND_OK);
    EXPECT_EQ(surface_of(small.plant), last);
    EXPECT_EQ(surface_before(small.plant, last.size()), between);
    // A plant that is moved elsewhere leaves no streak.
    ASSERT_EQ(frond_plant_set_transform(small.plant, {9, 0, 0}, {0, 0, 0, 1}), FROND_OK);
    const std::vector<float> elsewhere = surface_of(small.plant);
    EXPECT_EQ(surface_before(small.plant, elsewhere.size()), elsewhere);
    step(small.world, 1);
    surface_of(small.plant);
    EXPECT_EQ(surface_before(small.plant, elsewhere.size()), elsewhere);
    ASSERT_EQ(frond_plant_reset(small.plant), FROND_OK);
    const std::vector<float> anew = surface_of(small.plant);
    EXPECT_EQ(surface_before(small.plant, anew.size()), anew);
    // The previous frame is shifted with the origin.
    step(small.world, 1);
    const std::vector<float> shown = surface_of(small.plant);
    const std::vector<float> previous = surface_before(small.plant, shown.size());
    ASSERT_EQ(frond_world_shift_origin(small.world, {8, 0, 0}), FROND_OK);
    EXPECT_LT(difference(surface_before(small.plant, shown.size()), previous, {-8, 0, 0}), 1e-6);
    EXPECT_LT(difference(surface_of(small.plant), shown, {-8, 0, 0}), 1e-6);
}

TEST(Place, PlantsOfAWorldAreListedInTheirOrder) {
    SmallWorld small;
    const frond_plant_def def = frond_default_plant_def();
    frond_plant second = {}, third = {}, list[3] = {};
    ASSERT_EQ(frond_plant_create(small.world, small.model, &def, &second), FROND_OK);
    ASSERT_EQ(frond_plant_create(small.world, small.model, &def, &third), FROND_OK);
    ASSERT_EQ(frond_world_get_plant_count(small.world), 3);
    ASSERT_EQ(frond_world_get_plants(small.world, list, 3), FROND_OK);
    EXPECT_EQ(list[0].id, small.plant.id);
    EXPECT_EQ(list[1].id, second.id);
    EXPECT_EQ(list[2].id, third.id);
    frond_plant_destroy(second);
    ASSERT_EQ(frond_world_get_plant_count(small.world), 2);
    ASSERT_EQ(frond_world_get_plants(small.world, list, 2), FROND_OK);
    EXPECT_EQ(list[1].id, third.id);
}

TEST(Place, WrongCallsAreRefusedAndChangeNothing) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    SmallWorld small;
    uint64_t before = 0, after = 1;
    frond_world_get_state_hash(small.world, &before);
    frond_plant_def def = {};
    frond_plant list[2] = {};
    const float* positions = nullptr;
    for (frond_plant bad : {frond_plant{}, frond_plant{12345}}) {
        EXPECT_EQ(frond_plant_set_transform(bad, {0, 0, 0}, {0, 0, 0, 1}), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_plant_reset(bad), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_plant_get_def(bad, &def), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(frond_plant_get_previous_positions(bad, &positions), FROND_RESULT_BAD_HANDLE);
        EXPECT_EQ(positions, nullptr);
    }
    EXPECT_EQ(frond_plant_set_transform(small.plant, {nan, 0, 0}, {0, 0, 0, 1}), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_set_transform(small.plant, {0, 1e30, 0}, {0, 0, 0, 1}), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_set_transform(small.plant, {0, 0, 0}, {0, 0, 0, 0}), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_NE(std::strstr(frond_last_error(), "rotation has no direction"), nullptr);
    EXPECT_EQ(frond_plant_set_transform(small.plant, {0, 0, 0}, {0, nan, 0, 1}), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_get_def(small.plant, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_get_previous_positions(small.plant, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_world_get_plant_count({}), 0);
    EXPECT_EQ(frond_world_get_plants({}, list, 1), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_world_get_plants(small.world, list, 2), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_NE(std::strstr(frond_last_error(), "plant_count is 2; this world has 1"), nullptr);
    EXPECT_EQ(frond_world_get_plants(small.world, nullptr, 1), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_world_shift_origin({}, {1, 0, 0}), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_world_shift_origin(small.world, {0, nan, 0}), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_world_shift_origin(small.world, {0, 1e30, 0}), FROND_RESULT_BAD_ARGUMENT);
    frond_world_get_state_hash(small.world, &after);
    EXPECT_EQ(before, after);
    EXPECT_TRUE(frond_plant_is_awake(small.plant));
}

}  // namespace place_tests
