// Loads, state and section forces of the chain, against what beam theory says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/stand.hpp"
#include "support/stems.hpp"

namespace frond::test {
namespace chain_api_tests {

constexpr double PI = 3.14159265358979323846, RADIUS = 0.01, LENGTH = 1, YOUNG = 1e8, G = 9.81;

// A level stem of constant section along x, clamped at its begin by pins.
struct Cantilever : Stand {
    frond_plant plant = {};
    int node_count = 0, capsule_count = 0, tip = 0;
    double mass = 0, bending = 0;

    // Sleep would put it back to its modelled shape, which the upright one leaves by a twentieth of a millimetre.
    static frond_world_def sleepless() {
        frond_world_def def = frond_default_world_def();
        def.sleep_distance = 0;
        return def;
    }
    explicit Cantilever(frond_mechanics mechanics = FROND_MECHANICS_ROD, double capsule_height = 0.05,
                        frond_effects without = FROND_EFFECT_GRAVITY, const frond_vec3& end = {LENGTH, 0, 0})
        : Stand(sleepless()) {
        h = 1.0 / 60;
        frond_material material = {};
        must(frond_material_preset("stem", &material));
        material.young = YOUNG;
        material.yield_strain = material.twist_to_bend = 0;
        material.damping_ratio = 0.5;
        const frond_stem stem = {-1, {0, 0, 0}, end, RADIUS, RADIUS};
        model = make_stems_of(&stem, 1, &material, FROND_REST_WITHOUT_GRAVITY, capsule_height);
        frond_plant_def plant_def = frond_default_plant_def();
        plant_def.mechanics = mechanics;
        plant_def.effects &= ~without;
        plant_def.root_height = -1;
        plant_def.mass_damping = 5;
        plant = add(plant_def, {0, 0, 0});
        const std::vector<double> x = places(plant);
        // The nodes about the begin hold the first chain node alone.
        for (size_t i = 0; i < x.size() / 3; i++)
            if (x[3 * i] * end.x + x[3 * i + 1] * end.y < 1e-3 * LENGTH) must(frond_plant_pin(plant, int(i)));
        frond_model_info info = {};
        must(frond_model_get_info(model, &info));
        mass = info.mass;
        node_count = info.chain_node_count;
        capsule_count = info.capsule_count;
        tip = node_count - 1;
        frond_organ stem_organ = {};
        must(frond_model_get_organ(model, 0, &stem_organ));
        bending = stem_organ.bending_thin.lower;
    }
    std::vector<frond_chain_state> state() const {
        std::vector<frond_chain_state> states = std::vector<frond_chain_state>(size_t(node_count));
        must(frond_plant_get_chain_state(plant, states.data(), node_count));
        return states;
    }
    std::vector<frond_section_force> sections() const {
        std::vector<frond_section_force> forces = std::vector<frond_section_force>(size_t(capsule_count));
        must(frond_plant_get_section_forces(plant, forces.data(), capsule_count));
        return forces;
    }
    template <class Load>
    void rest(int count, const Load& load) {
        for (int i = 0; i < count; i++) {
            load();
            steps(1);
        }
    }
};

TEST(ChainLoads, AMomentAtItsTipBendsACantileverIntoACircle) {
    Cantilever stem;
    ASSERT_EQ(stem.state()[size_t(stem.tip)].position.x, LENGTH);
    const double full = 2 * PI * stem.bending / LENGTH;
    int step = 0;
    stem.rest(500, [&] {
        const double moment = full * std::min(1.0, ++step / 300.0);
        must(frond_plant_add_chain_load(stem.plant, stem.tip, {0, 0, 0}, {0, 0, moment}));
    });
    const std::vector<frond_chain_state> states = stem.state();
    const frond_vec3& end = states[size_t(stem.tip)].position;
    EXPECT_NEAR(end.x, 0, 0.01 * LENGTH);
    EXPECT_NEAR(end.y, 0, 0.01 * LENGTH);
    double highest = 0;
    for (const frond_chain_state& state : states) highest = std::max(highest, state.position.y);
    EXPECT_NEAR(highest, LENGTH / PI, 0.01 * LENGTH);
    for (const frond_section_force& section : stem.sections()) {
        const double moment = std::hypot(section.bending_thin, section.bending_wide);
        EXPECT_NEAR(moment / full, 1, 0.01);
        EXPECT_NEAR(section.twist / full, 0, 0.01);
    }
}

TEST(ChainLoads, AMomentIsACoupleOnTets) {
    Cantilever stem(FROND_MECHANICS_TET_COROTATIONAL);
    const double moment = 0.1 * stem.bending / LENGTH;
    stem.rest(600, [&] { must(frond_plant_add_chain_load(stem.plant, stem.tip, {0, 0, 0}, {0, 0, moment})); });
    frond_capsule last = {};
    std::vector<frond_capsule> capsules(size_t(stem.capsule_count), last);
    must(frond_plant_get_capsules(stem.plant, capsules.data(), stem.capsule_count));
    EXPECT_NEAR(capsules.back().end.y / (0.05 * LENGTH), 1, 0.1);
}

TEST(ChainLoads, ADistributedLoadBendsACantileverAsInTheTables) {
    Cantilever stem;
    const double q = 0.05 * 8 * stem.bending / std::pow(LENGTH, 4);  // deflection of 5 % of the length
    stem.rest(900, [&] {
        for (int i = 0; i < stem.capsule_count; i++) must(frond_plant_add_distributed_load(stem.plant, i, {0, -q, 0}));
    });
    EXPECT_NEAR(stem.state()[size_t(stem.tip)].position.y / (-0.05 * LENGTH), 1, 0.005);
    const std::vector<frond_section_force> sections = stem.sections();
    for (int i = 0; i < stem.capsule_count; i++) {
        const double beyond = LENGTH * (1 - (i + 0.5) / stem.capsule_count);
        const frond_section_force& s = sections[size_t(i)];
        EXPECT_NEAR(std::hypot(s.shear_thin, s.shear_wide), q * beyond, 0.01 * q * LENGTH) << i;
        // Within a piece the clamped beam's moment is missing, a twenty-fourth of its load times its length.
        EXPECT_NEAR(std::hypot(s.bending_thin, s.bending_wide), 0.5 * q * beyond * beyond, 0.01 * q * LENGTH * LENGTH)
            << i;
    }
}

TEST(SectionForces, OfAnUprightStemAreTheWeightAbove) {
    Cantilever stem(FROND_MECHANICS_ROD, 0.05, 0, {0, LENGTH, 0});
    stem.steps(300);
    const std::vector<frond_section_force> sections = stem.sections();
    for (int i = 0; i < stem.capsule_count; i++) {
        const double above = 1 - (i + 0.5) / stem.capsule_count;
        EXPECT_NEAR(sections[size_t(i)].tension, -stem.mass * G * above, 0.005 * stem.mass * G) << i;
        EXPECT_NEAR(sections[size_t(i)].twist, 0, 1e-6);
    }
}

TEST(SectionForces, TwistAndBendWithTheirSigns) {
    Cantilever stem;
    const double moment = 0.05 * stem.bending / LENGTH;
    stem.rest(600, [&] { must(frond_plant_add_chain_load(stem.plant, stem.tip, {0, 0, 0}, {moment, 0, 2 * moment})); });
    for (const frond_section_force& s : stem.sections()) {
        EXPECT_NEAR(s.twist / moment, 1, 0.11);  // the bent axis turns by 0.1 against the moment
        const frond_vec3 wide = {s.axis.y * s.thin.z - s.axis.z * s.thin.y, s.axis.z * s.thin.x - s.axis.x * s.thin.z,
                                 s.axis.x * s.thin.y - s.axis.y * s.thin.x};
        // About z, by the components along both directions across.
        EXPECT_NEAR((s.bending_thin * wide.z - s.bending_wide * s.thin.z) / (2 * moment), 1, 0.02);
    }
}

TEST(ChainState, IsSetAndReadExactly) {
    Cantilever stem;
    for (int i = 0; i < frond_plant_get_node_count(stem.plant); i++) frond_plant_unpin(stem.plant, i);
    std::vector<frond_chain_state> states = stem.state();
    for (frond_chain_state& state : states) {
        // Turned by half a right angle about z, with the stem, and spinning about its axis.
        const double along = state.position.x;
        state.position = {along * std::sqrt(0.5), along * std::sqrt(0.5), 0.5};
        state.rotation = {0, 0, std::sin(PI / 8), std::cos(PI / 8)};
        state.velocity = {0.1, 0.2, 0.3};
        state.angular_velocity = {2, 2, 0};
    }
    must(frond_plant_set_chain_state(stem.plant, states.data(), stem.node_count));
    const std::vector<frond_chain_state> found = stem.state();
    for (size_t i = 0; i < states.size(); i++) {
        EXPECT_NEAR(found[i].position.x, states[i].position.x, 1e-12);
        EXPECT_NEAR(found[i].position.z, 0.5, 1e-12);
        EXPECT_NEAR(found[i].rotation.z, std::sin(PI / 8), 1e-12);
        EXPECT_NEAR(found[i].angular_velocity.x, 2, 1e-12);
        EXPECT_NEAR(found[i].angular_velocity.y, 2, 1e-12);
    }
    frond_energy energy = {};
    must(frond_plant_get_energy(stem.plant, &energy));
    EXPECT_NEAR(energy.elastic, 0, 1e-9);
    // It goes on as it was set.
    stem.steps(3);
    EXPECT_NEAR(stem.state()[0].angular_velocity.x, 2, 1.0);
    EXPECT_NEAR(stem.state()[0].position.y, 0.2 * 3 * stem.h, 0.02);
}

TEST(ChainApi, RefusesWhatItCannotDo) {
    Cantilever stem(FROND_MECHANICS_TET_COROTATIONAL);
    std::vector<frond_chain_state> states = std::vector<frond_chain_state>(size_t(stem.node_count));
    std::vector<frond_section_force> forces = std::vector<frond_section_force>(size_t(stem.capsule_count));
    EXPECT_EQ(frond_plant_get_chain_state(stem.plant, states.data(), stem.node_count), FROND_RESULT_UNSUPPORTED);
    EXPECT_EQ(frond_plant_get_section_forces(stem.plant, forces.data(), stem.capsule_count), FROND_RESULT_UNSUPPORTED);
    must(frond_plant_set_mechanics(stem.plant, FROND_MECHANICS_ROD));
    EXPECT_EQ(frond_plant_get_chain_state(stem.plant, nullptr, stem.node_count), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_get_chain_state(stem.plant, states.data(), 1), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_set_chain_state(stem.plant, nullptr, stem.node_count), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_set_chain_state(stem.plant, states.data(), stem.node_count), FROND_RESULT_BAD_ARGUMENT)
        << "rotations without direction";
    EXPECT_EQ(frond_plant_get_section_forces(stem.plant, forces.data(), 1), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_get_section_forces(stem.plant, nullptr, stem.capsule_count), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_add_chain_load(stem.plant, stem.node_count, {0, 0, 0}, {0, 0, 0}), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_add_chain_load(stem.plant, 0, {0, 0, 0}, {0, NAN, 0}), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_add_distributed_load(stem.plant, -1, {0, 0, 0}), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_add_distributed_load(stem.plant, 0, {INFINITY, 0, 0}), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_add_chain_load({}, 0, {0, 0, 0}, {0, 0, 0}), FROND_RESULT_BAD_HANDLE);
}

}  // namespace chain_api_tests
}  // namespace frond::test
