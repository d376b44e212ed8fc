// An organ that is strained beyond its strength breaks, and the fragment becomes a rigid body.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "frond/frond.h"

namespace breaking_tests {

constexpr double H = 1.0 / 120, LENGTH = 0.6, RADIUS = 0.006, YOUNG = 2e8;

// A stem that breaks when the stress in its outermost fibre reaches `strength`.
struct Stem {
    frond_world world = {};
    frond_plant plant = {};
    frond_model model = {};
    frond_grab grab = {};

    explicit Stem(frond_mechanics mechanics, double strength, double gravity = 0, bool breaks = true) {
        frond_world_def world_def = frond_default_world_def();
        world_def.gravity = {0, gravity, 0};
        EXPECT_EQ(frond_world_create(&world_def, &world), FROND_OK);
        frond_model_def def = frond_default_model_def();
        frond_organ_material organ = {"stem", {}};
        EXPECT_EQ(frond_material_preset("stem", &organ.material), FROND_OK);
        organ.material.young = YOUNG;
        organ.material.strength = strength;
        organ.material.yield_strain = 0;
        def.organs = &organ;
        def.organ_count = 1;
        def.scale = 1;
        def.up = {0, 1, 0};
        def.capsule_height = 0.06;
        def.cage_size = 0.06;
        const frond_stem stem = {-1, {0, 0, 0}, {0, LENGTH, 0}, RADIUS, RADIUS};
        EXPECT_EQ(frond_model_from_stems(&stem, 1, &def, &model), FROND_OK) << frond_last_error();
        frond_plant_def plant_def = frond_default_plant_def();
        plant_def.mechanics = mechanics;
        if (breaks) plant_def.effects |= FROND_EFFECT_BREAKING;
        EXPECT_EQ(frond_plant_create(world, model, &plant_def, &plant), FROND_OK) << frond_last_error();
    }
    Stem(const Stem&) = delete;
    Stem& operator=(const Stem&) = delete;
    ~Stem() {
        frond_world_destroy(world);
        frond_model_destroy(model);
    }
    void step(int count = 1) {
        for (int i = 0; i < count; i++) EXPECT_EQ(frond_world_step(world, H), FROND_OK);
    }
    frond_report report() const {
        frond_report report = {};
        EXPECT_EQ(frond_world_get_report(world, &report), FROND_OK);
        return report;
    }
    // Pulls by a soft spring from far away, ever harder, until something breaks; returns that force [N].
    double pull_until_it_breaks(const frond_vec3& direction, double most) {
        constexpr double AWAY = 1000;
        constexpr int STEPS = 600;
        EXPECT_EQ(frond_grab_create(plant, {0, LENGTH, 0}, most / AWAY, &grab), FROND_OK);
        for (int i = 1; i <= STEPS; i++) {
            const double share = AWAY * i / STEPS;
            EXPECT_EQ(frond_grab_move(grab, {share * direction.x, LENGTH + share * direction.y, 0}), FROND_OK);
            frond_vec3 force = {};
            EXPECT_EQ(frond_grab_get(grab, nullptr, nullptr, &force), FROND_OK);
            step();
            if (report().broken_count > 0) return std::hypot(force.x, force.y);
        }
        return 0;
    }
    frond_fragment broken(int part = 0) const {
        frond_fragment out = {};
        EXPECT_EQ(frond_plant_get_fragment(plant, part, &out), FROND_OK) << frond_last_error();
        return out;
    }
    double energy() const {
        frond_energy e = {};
        EXPECT_EQ(frond_plant_get_energy(plant, &e), FROND_OK);
        return e.kinetic + e.elastic + e.gravity;
    }
    std::vector<float> surface() const {
        frond_surface_view view = {};
        EXPECT_EQ(frond_plant_get_surface(plant, &view), FROND_OK);
        return std::vector<float>(view.positions, view.positions + 3 * size_t(view.vertex_count));
    }
    std::vector<double> state() const {
        std::vector<double> x(3 * size_t(frond_plant_get_node_count(plant)));
        EXPECT_EQ(frond_plant_get_state(plant, x.data(), nullptr, int(x.size() / 3)), FROND_OK);
        return x;
    }
    uint64_t hash() const {
        uint64_t hash = 0;
        EXPECT_EQ(frond_world_get_state_hash(world, &hash), FROND_OK);
        return hash;
    }
    int capsule_count() const { return frond_plant_get_capsule_count(plant); }
};

struct EveryBreak : testing::TestWithParam<frond_mechanics> {
    bool is_rod() const { return GetParam() == FROND_MECHANICS_ROD; }
};
INSTANTIATE_TEST_SUITE_P(Breaking, EveryBreak,
                         testing::Values(FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_TET_NEOHOOKEAN,
                                         FROND_MECHANICS_ROD),
                         [](const auto& info) { return std::string(frond_mechanics_name(info.param)); });

// What came off is strained by nothing any more. With the shape at the break, a stem that broke at its foot stayed
// bent, and a picked fruit crumpled.
TEST_P(EveryBreak, WhatComesOffSpringsBack) {
    Stem stem(GetParam(), 1.2e7);
    const auto length = [&] {
        std::vector<frond_capsule> capsules(size_t(stem.capsule_count()));
        EXPECT_EQ(frond_plant_get_capsules(stem.plant, capsules.data(), int(capsules.size())), FROND_OK);
        const frond_vec3 a = capsules.front().begin, b = capsules.back().end;
        return std::hypot(b.x - a.x, std::hypot(b.y - a.y, b.z - a.z));
    };
    ASSERT_GT(stem.pull_until_it_breaks({1, 0, 0}, 40), 0);
    EXPECT_NEAR(length(), LENGTH, 1e-3 * LENGTH);
}

// Bending moment at the foot over the section modulus: F L / (pi r^3 / 4). The foot's capsule reports the strain at its
// middle.
TEST_P(EveryBreak, AStemBreaksAtItsFootWhereTheFormulaSays) {
    constexpr double STRENGTH = 3e5;
    const double force = STRENGTH * M_PI * std::pow(RADIUS, 3) / 4 / (LENGTH - 0.03);
    Stem stem(GetParam(), STRENGTH);
    const double measured = stem.pull_until_it_breaks({1, 0, 0}, 3 * force);
    EXPECT_NEAR(measured / force, 1, is_rod() ? 0.08 : 0.3);
    EXPECT_EQ(frond_plant_get_fragment_count(stem.plant), 1);
    EXPECT_LT(stem.broken().capsule, 3);
}

TEST(Breaking, ARodThatIsPulledBreaksWhereTheFormulaSays) {
    constexpr double STRENGTH = 3e5;
    Stem stem(FROND_MECHANICS_ROD, STRENGTH);
    frond_model_info info = {};
    ASSERT_EQ(frond_model_get_info(stem.model, &info), FROND_OK);
    // Upward gravity increases; the foot carries all of it except on its own lower half.
    const double known = STRENGTH * M_PI * RADIUS * RADIUS / (info.mass * (1 - 0.03 / LENGTH));
    double pull = 0;
    for (; pull < 2 * known && frond_plant_get_fragment_count(stem.plant) == 0; pull += 0.005 * known) {
        ASSERT_EQ(frond_world_set_gravity(stem.world, {0, pull, 0}), FROND_OK);
        stem.step();
    }
    EXPECT_NEAR(pull / known, 1, 0.05);
    EXPECT_EQ(stem.broken().capsule, 0);
}

TEST_P(EveryBreak, NothingBreaksWithoutTheEffectOrWithoutAStrength) {
    for (bool has_effect : {false, true}) {
        Stem stem(GetParam(), has_effect ? 0 : 1e5, 0, has_effect);
        EXPECT_EQ(stem.pull_until_it_breaks({1, 0, 0}, 1), 0);
        EXPECT_EQ(frond_plant_get_fragment_count(stem.plant), 0);
    }
}

TEST_P(EveryBreak, WhatComesOffTakesItsMomentumAlongAndNoEnergyIsMade) {
    Stem stem(GetParam(), 0, 0);
    const size_t nodes = size_t(frond_plant_get_node_count(stem.plant));
    std::vector<double> v(3 * nodes);
    const std::vector<double> x = stem.state();
    for (size_t i = 0; i < nodes; i++) v[3 * i] = 0.8 * x[3 * i + 1];
    ASSERT_EQ(frond_plant_set_state(stem.plant, nullptr, v.data(), int(nodes)), FROND_OK);
    frond_vec3 whole = {}, rest = {};
    ASSERT_EQ(frond_plant_get_momentum(stem.plant, &whole), FROND_OK);
    const double before = stem.energy();
    ASSERT_EQ(frond_plant_break(stem.plant, 4), FROND_OK) << frond_last_error();
    ASSERT_EQ(frond_plant_get_momentum(stem.plant, &rest), FROND_OK);
    frond_rigid_state part = {};
    const frond_fragment broken = stem.broken();
    ASSERT_EQ(frond_rigid_get_state(broken.rigid, &part), FROND_OK);
    EXPECT_NEAR(rest.x + broken.mass * part.velocity.x, whole.x, 1e-6 * whole.x);
    const double speed = part.velocity.x, kinetic = 0.5 * broken.mass * speed * speed;
    EXPECT_LE(stem.energy() + kinetic, before * (1 + 1e-6));
    // A thin rod keeps its angular velocity about its middle.
    EXPECT_NEAR(part.angular_velocity.z, -0.8, 0.03);
    frond_model_info info = {};
    ASSERT_EQ(frond_model_get_info(stem.model, &info), FROND_OK);
    EXPECT_NEAR(broken.mass / info.mass, 0.6, 0.08);
    // The stump continues to move and calms down.
    const double left = stem.energy();
    for (int i = 0; i < 240; i++) {
        stem.step();
        EXPECT_LT(stem.energy(), 1.02 * left + 1e-9) << i;
        EXPECT_EQ(stem.report().trouble, 0u);
    }
    EXPECT_LT(stem.energy(), 0.1 * left);
}

// Nodes that are gone are carried with the stump. Once their velocity grew ninefold a substep, and air worked on it.
TEST(Breaking, WhatCameOffDoesNoWorkInTheAir) {
    Stem stem(FROND_MECHANICS_ROD, 0);
    frond_wind_def wind = frond_default_wind_def();
    wind.velocity = {3, 0, 0};
    ASSERT_EQ(frond_world_set_wind(stem.world, &wind), FROND_OK);
    frond_plant_def def = {};
    ASSERT_EQ(frond_plant_get_def(stem.plant, &def), FROND_OK);
    def.position.x = 5;
    def.tuning.max_substeps = 8;
    frond_plant swaying = {};
    ASSERT_EQ(frond_plant_create(stem.world, stem.model, &def, &swaying), FROND_OK) << frond_last_error();
    const size_t nodes = size_t(frond_plant_get_node_count(swaying));
    const std::vector<double> x = stem.state();
    std::vector<double> v(3 * nodes);
    for (size_t i = 0; i < nodes; i++) v[3 * i] = 3 * x[3 * i + 1];
    ASSERT_EQ(frond_plant_set_state(swaying, nullptr, v.data(), int(nodes)), FROND_OK);
    ASSERT_EQ(frond_plant_break(swaying, 7), FROND_OK) << frond_last_error();
    frond_energy_ledger before = {}, now = {};
    ASSERT_EQ(frond_world_get_energy_ledger(stem.world, &before), FROND_OK);
    for (int i = 0; i < 120; i++) {
        stem.step();
        ASSERT_EQ(frond_world_get_energy_ledger(stem.world, &now), FROND_OK);
        EXPECT_LT(std::abs(now.air - before.air), 0.01) << i;
        EXPECT_GT(now.dissipated - before.dissipated,
                  before.error - now.error - 0.05 * (before.now.kinetic + before.now.elastic))
            << i;
        before = now;
    }
}

TEST_P(EveryBreak, WhatComesOffFallsAndIsDrawnWhereItIs) {
    Stem stem(GetParam(), 0, -9.81);
    ASSERT_EQ(frond_plant_break(stem.plant, 5), FROND_OK);
    const std::vector<float> before = stem.surface();
    stem.step(24);
    const double t = 24 * H, fallen = 9.81 * t * (t + H) / 2;
    const std::vector<float> after = stem.surface();
    int moved = 0, stayed = 0;
    for (size_t i = 0; i < before.size(); i += 3) {
        const double way = double(before[i + 1]) - double(after[i + 1]);
        if (std::abs(way - fallen) < 1e-3) moved++;
        if (std::abs(way) < 1e-3) stayed++;
    }
    EXPECT_EQ(3 * size_t(moved + stayed), before.size());
    EXPECT_GT(moved, 0);
    EXPECT_GT(stayed, 0);
    // Triangles between stump and fragment have no area.
    frond_surface_view view = {};
    ASSERT_EQ(frond_plant_get_surface(stem.plant, &view), FROND_OK);
    int flat = 0;
    for (int t3 = 0; t3 < view.triangle_count; t3++) {
        const int32_t* c = view.indices + 3 * t3;
        if (c[0] == c[1]) flat++;
        for (int k = 1; k < 3; k++)
            EXPECT_LT(std::abs(view.positions[3 * c[0] + 1] - view.positions[3 * c[k] + 1]), 0.15);
    }
    EXPECT_GT(flat, 0);
    // Capsules and nodes are reported at the fragment's position too.
    std::vector<frond_capsule> capsules(size_t(stem.capsule_count()));
    ASSERT_EQ(frond_plant_get_capsules(stem.plant, capsules.data(), stem.capsule_count()), FROND_OK);
    EXPECT_NEAR(capsules.back().end.y, LENGTH - fallen, 2e-3);
    EXPECT_NEAR(capsules[0].begin.y, 0, 1e-3);
}

TEST_P(EveryBreak, APlantIsRestoredWithItsParts) {
    Stem stem(GetParam(), 0), twin(GetParam(), 0);
    ASSERT_EQ(frond_plant_break(stem.plant, 6), FROND_OK);
    frond_rigid_state thrown = {};
    ASSERT_EQ(frond_rigid_get_state(stem.broken().rigid, &thrown), FROND_OK);
    thrown.velocity.x = 2;
    thrown.angular_velocity.z = 1;
    ASSERT_EQ(frond_rigid_set_state(stem.broken().rigid, &thrown), FROND_OK);
    stem.step(10);
    ASSERT_EQ(frond_plant_break(stem.plant, 3), FROND_OK);
    stem.step(10);
    // Restored as described in the header.
    ASSERT_EQ(frond_plant_reset(twin.plant), FROND_OK);
    for (int part : {0, 1}) ASSERT_EQ(frond_plant_break(twin.plant, stem.broken(part).capsule), FROND_OK);
    const size_t nodes = size_t(frond_plant_get_node_count(stem.plant));
    std::vector<double> x(3 * nodes), v(3 * nodes);
    ASSERT_EQ(frond_plant_get_state(stem.plant, x.data(), v.data(), int(nodes)), FROND_OK);
    ASSERT_EQ(frond_plant_set_state(twin.plant, x.data(), v.data(), int(nodes)), FROND_OK);
    for (int part : {0, 1}) {
        frond_rigid_state state = {};
        ASSERT_EQ(frond_rigid_get_state(stem.broken(part).rigid, &state), FROND_OK);
        ASSERT_EQ(frond_rigid_set_state(twin.broken(part).rigid, &state), FROND_OK);
    }
    stem.step(5);
    twin.step(5);
    const std::vector<float> a = stem.surface(), b = twin.surface();
    for (size_t i = 0; i < a.size(); i++) ASSERT_NEAR(a[i], b[i], 2e-3) << i;
    EXPECT_EQ(frond_plant_reset(stem.plant), FROND_OK);
    EXPECT_EQ(frond_plant_get_fragment_count(stem.plant), 0);
    stem.step(5);
    EXPECT_NEAR(stem.state()[1], Stem(GetParam(), 0).state()[1], 1e-3);
}

TEST_P(EveryBreak, TheSameCallsGiveTheSameHashAndPartsCount) {
    Stem one(GetParam(), 0, -9.81), two(GetParam(), 0, -9.81);
    for (Stem* stem : {&one, &two}) {
        stem->step(3);
        EXPECT_EQ(frond_plant_break(stem->plant, 5), FROND_OK);
        stem->step(5);
    }
    EXPECT_EQ(one.hash(), two.hash());
    frond_rigid_state state = {};
    EXPECT_EQ(frond_rigid_get_state(two.broken().rigid, &state), FROND_OK);
    state.position.x += 0.1;
    EXPECT_EQ(frond_rigid_set_state(two.broken().rigid, &state), FROND_OK);
    EXPECT_NE(one.hash(), two.hash());
}

TEST_P(EveryBreak, PartsStayOffWhenMechanicsChange) {
    Stem stem(GetParam(), 0, -9.81);
    ASSERT_EQ(frond_plant_break(stem.plant, 5), FROND_OK);
    stem.step(12);
    for (int m = 0; m < FROND_MECHANICS_COUNT; m++) {
        const std::vector<float> before = stem.surface();
        ASSERT_EQ(frond_plant_set_mechanics(stem.plant, frond_mechanics(m)), FROND_OK);
        const std::vector<float> after = stem.surface();
        for (size_t i = 0; i < before.size(); i++) ASSERT_NEAR(before[i], after[i], 2e-3) << m;
        stem.step(2);
        EXPECT_EQ(stem.report().trouble & FROND_TROUBLE_REWOUND, 0u) << m;
        EXPECT_EQ(frond_plant_get_fragment_count(stem.plant), 1);
    }
}

TEST_P(EveryBreak, TheHandTakesWhatItHoldsAlong) {
    Stem stem(GetParam(), 0, -9.81);
    ASSERT_EQ(frond_grab_create(stem.plant, {0, LENGTH, 0}, 50, &stem.grab), FROND_OK);
    ASSERT_EQ(frond_plant_break(stem.plant, 5), FROND_OK);
    ASSERT_EQ(frond_grab_move(stem.grab, {0.3, 1.0, 0}), FROND_OK);
    stem.step(360);
    frond_vec3 at = {};
    ASSERT_EQ(frond_grab_get(stem.grab, &at, nullptr, nullptr), FROND_OK);
    EXPECT_NEAR(at.x, 0.3, 0.05);
    EXPECT_NEAR(at.y, 1.0, 0.05);
}

// The whole plant breaks off at its foot.
TEST_P(EveryBreak, AWholePlantMayComeOff) {
    Stem stem(GetParam(), 0, -9.81);
    ASSERT_EQ(frond_plant_break(stem.plant, 0), FROND_OK) << frond_last_error();
    for (int i = 0; i < FROND_INTEGRATOR_COUNT; i++) {
        ASSERT_EQ(frond_plant_set_integrator(stem.plant, frond_integrator(i)), FROND_OK) << frond_last_error();
        stem.step(6);
        EXPECT_EQ(stem.report().trouble, 0u) << i;
    }
    frond_model_info info = {};
    ASSERT_EQ(frond_model_get_info(stem.model, &info), FROND_OK);
    EXPECT_NEAR(stem.broken().mass / info.mass, 1, 0.1);
}

TEST(Breaking, WrongCallsAreToldSo) {
    Stem stem(FROND_MECHANICS_ROD, 0);
    frond_fragment out = {};
    EXPECT_EQ(frond_plant_get_fragment(stem.plant, 0, &out), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_get_fragment(stem.plant, 0, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_break(stem.plant, -1), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_break(stem.plant, stem.capsule_count()), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_break({}, 0), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_plant_reset({}), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_plant_get_fragment_count({}), 0);
    ASSERT_EQ(frond_plant_break(stem.plant, 5), FROND_OK);
    EXPECT_EQ(frond_plant_break(stem.plant, 6), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_NE(std::string(frond_last_error()).find("frond_plant_reset"), std::string::npos);
    const frond_rigid rigid = stem.broken().rigid;
    frond_rigid_destroy(rigid);
    EXPECT_TRUE(frond_rigid_is_valid(rigid));
    frond_plant_destroy(stem.plant);
    EXPECT_FALSE(frond_rigid_is_valid(rigid));
    stem.step(2);
}

}  // namespace breaking_tests
