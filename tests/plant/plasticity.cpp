// Plastic strain of a bent plant: none below yield, a permanent bend beyond it in rods as in tets, and no energy gain.
#include <gtest/gtest.h>

#include <cmath>

#include "modelling/build.hpp"
#include "plant/plant_step.hpp"
#include "support/materials.hpp"

namespace frond::test {
namespace plasticity_tests {

constexpr double H = 1.0 / 120;

// Returns a stem of 0.6 m that bends to its yield under some 4.7 N at its tip.
std::shared_ptr<const Model> stem_model(double yield_strain, double creep = 0,
                                        frond_rest rest = FROND_REST_STANDS_AS_MODELLED) {
    const frond_stem stem = {-1, {0, 0, 0}, {0, 0.6, 0}, 0.012, 0.012};
    frond_organ_material organ = {"stem", plain_material(1000, 1e8, 0.3, 1e-3)};
    organ.material.yield_strain = yield_strain;
    organ.material.creep_rate = creep;
    frond_model_def def = {};
    def.scale = 1;
    def.allow_stiffening = INFINITY;
    def.cage_smoothness = 0.5;
    def.cage_size = 0.08;
    def.rest = rest;
    def.organs = &organ;
    def.organ_count = 1;
    return build_from_stems(&stem, 1, def);
}

struct Bending {
    std::unique_ptr<Plant> plant;
    Surroundings surroundings;
    int vertex;  // vertex at the tip

    Bending(const std::shared_ptr<const Model>& model, frond_mechanics which) {
        frond_plant_def def = {};
        def.rotation = {0, 0, 0, 1};
        def.mechanics = which;
        def.element_order = 1;
        def.integrator = FROND_INTEGRATOR_BDF2;
        def.tuning.newton_iterations = 2;
        def.tuning.newton_tolerance = 1e-9;
        def.tuning.linear_iterations = 100;
        def.tuning.linear_tolerance = 1e-6;
        def.effects = FROND_EFFECT_ALL;
        plant = create_plant(model, def);
        surroundings.gravity = {0, -GRAVITY, 0};
        vertex = nearest_vertex(*plant, Vec3(0, 0.6, 0));
    }
    Vec3 tip() const { return plant->view.chain_positions.back(); }
    // Applies a force with strong damping, so that the plant comes to rest.
    void rest(double force) {
        plant->input.settings.mass_damping = 20;
        pull(force);
        for (int n = 0; n < 240; ++n) step_plant(*plant, surroundings, H);
    }
    // Pulls by a soft spring from far away, which acts as a constant force.
    void pull(double force) {
        plant->input.grabs.clear();
        if (force != 0) plant->input.grabs.push_back({vertex, Vec3(force / 0.01, 0, 0), 0.01, 0});
    }
    // Returns the permanent displacement of the tip after a force was applied and removed [m].
    double set_after(double force) {
        rest(0);
        const double before = tip().x();
        rest(force);
        rest(0);
        return tip().x() - before;
    }
};

struct EveryPlasticity : testing::TestWithParam<int> {
    const frond_mechanics which = frond_mechanics(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Mechanics, EveryPlasticity,
                         testing::Values(int(FROND_MECHANICS_TET_COROTATIONAL), int(FROND_MECHANICS_TET_NEOHOOKEAN),
                                         int(FROND_MECHANICS_ROD)),
                         [](const auto& info) { return mechanics(frond_mechanics(info.param)).name; });

// EI = 1.63 N m^2; the rim at the foot yields at 2 % under EI 0.02 / (r L) = 4.5 N.
TEST_P(EveryPlasticity, NothingIsKeptOrAllocatedBelowTheYield) {
    Bending bending(stem_model(0.02), which), elastic(stem_model(0), which);
    for (double force : {0.0, 2.5, 0.0}) {
        bending.rest(force);
        elastic.rest(force);
    }
    EXPECT_EQ(bending.plant->state.own_elements, nullptr);
    EXPECT_EQ(bending.plant->state.motion.x, elastic.plant->state.motion.x);
}

TEST_P(EveryPlasticity, ASetIsKeptBeyondTheYieldAndOnlyWithTheEffect) {
    const double set = Bending(stem_model(0.02), which).set_after(7);
    const double in_rods = Bending(stem_model(0.02), FROND_MECHANICS_ROD).set_after(7);
    EXPECT_GT(in_rods, 0.02);
    EXPECT_NEAR(set, in_rods, 0.5 * in_rods);
    Bending off(stem_model(0.02), which);
    off.plant->input.effects &= ~uint32_t(FROND_EFFECT_PLASTICITY);
    EXPECT_NEAR(off.set_after(7), 0, 1e-4);
    EXPECT_EQ(off.plant->state.own_elements, nullptr);
}

TEST_P(EveryPlasticity, StandingItKeepsItsShapeWhateverItsYield) {
    Bending bending(stem_model(1e-6, 100), which);
    const Vec3 before = bending.tip();
    for (int n = 0; n < 600; ++n) step_plant(*bending.plant, bending.surroundings, H);
    EXPECT_LT((bending.tip() - before).norm(), 0.005 * 0.6);
}

TEST_P(EveryPlasticity, HeldAsideItCreeps) {
    Bending bending(stem_model(0.02, 0.3), which), still(stem_model(0.02, 0), which);
    for (Bending* b : {&bending, &still}) b->rest(6);
    const double crept = bending.tip().x(), held = still.tip().x();
    EXPECT_GT(crept, held + 1e-3);
    bending.rest(6);
    EXPECT_GT(bending.tip().x(), crept);
}

// After release from far beyond yield without any damping, the energy never grows.
TEST_P(EveryPlasticity, EnergyNeverGrowsWhileItSways) {
    Bending bending(stem_model(0.02, 0.1, FROND_REST_WITHOUT_GRAVITY), which);
    bending.surroundings.gravity.setZero();
    bending.rest(9);
    bending.plant->input.settings.mass_damping = 0;
    bending.plant->input.settings.integrator = FROND_INTEGRATOR_TR_BDF2;
    bending.pull(0);
    const auto energy = [&] {
        const frond_energy e = energy_of(*bending.plant, Vec3::Zero());
        return e.kinetic + e.elastic;
    };
    const double start = energy();
    double least = start;
    for (int n = 0; n < 600; ++n) {
        step_plant(*bending.plant, bending.surroundings, H / 2);
        const double now = energy();
        ASSERT_LE(now, least + 1e-3 * start) << "step " << n;
        least = std::min(least, now);
    }
    EXPECT_LT(least, 0.999 * start);
}

TEST_P(EveryPlasticity, WhatIsLastingIsSavedAndRestoredToTheBit) {
    const auto model = stem_model(0.02, 0.1);
    Bending bending(model, which), other(model, which);
    bending.rest(7);
    const std::vector<double> plastic = plastic_of(*bending.plant);
    ASSERT_FALSE(plastic.empty());
    set_plastic(*other.plant, plastic);
    EXPECT_EQ(plastic_of(*other.plant), plastic);
    other.plant->input.settings.mass_damping = bending.plant->input.settings.mass_damping;
    other.plant->input.grabs = bending.plant->input.grabs;
    other.plant->state.motion = bending.plant->state.motion;
    for (int n = 0; n < 20; ++n)
        for (Bending* b : {&bending, &other}) step_plant(*b->plant, b->surroundings, H);
    EXPECT_EQ(other.plant->state.motion.x, bending.plant->state.motion.x);
    EXPECT_EQ(plastic_of(*other.plant), plastic_of(*bending.plant));
    set_plastic(*other.plant, {});
    EXPECT_TRUE(plastic_of(*other.plant).empty());
    EXPECT_NE(energy_of(*other.plant, Vec3::Zero()).elastic, energy_of(*bending.plant, Vec3::Zero()).elastic);
}

// If the solve fails, the plant is rewound, and the failed step leaves no plastic strain.
TEST_P(EveryPlasticity, AStepThatIsRewoundLeavesNothing) {
    Bending bending(stem_model(0.02), which);
    bending.rest(7);
    const std::vector<double> plastic = plastic_of(*bending.plant);
    bending.plant->state.motion.v.setConstant(std::numeric_limits<double>::quiet_NaN());
    step_plant(*bending.plant, bending.surroundings, H);
    EXPECT_TRUE(bending.plant->trouble & FROND_TROUBLE_REWOUND);
    EXPECT_EQ(plastic_of(*bending.plant), plastic);
}

TEST(PlasticityOfTets, IsHandedToOtherTets) {
    Bending bending(stem_model(0.02), FROND_MECHANICS_TET_COROTATIONAL);
    bending.rest(7);
    bending.rest(0);
    const double set = bending.tip().x();
    const std::vector<double> plastic = plastic_of(*bending.plant);
    set_mechanics(*bending.plant, FROND_MECHANICS_TET_NEOHOOKEAN);
    EXPECT_EQ(plastic_of(*bending.plant), plastic);
    bending.rest(0);
    EXPECT_NEAR(bending.tip().x(), set, 0.1 * set);
    set_mechanics(*bending.plant, FROND_MECHANICS_ROD);
    EXPECT_TRUE(plastic_of(*bending.plant).empty());
}

// Tets stiffer by a factor yield at a strain smaller by its square root, so at the same energy.
TEST(PlasticityOfTets, BeginsAtOneEnergyWhateverTheirModuli) {
    const auto model = stem_model(0.02, 0, FROND_REST_WITHOUT_GRAVITY);
    const auto soft = mechanics(FROND_MECHANICS_TET_LINEAR).make(*model, FROND_MECHANICS_TET_LINEAR);
    model->rest_shapes->stiffer[0][FROND_MECHANICS_TET_LINEAR].assign(model->cage.tets.size(), 4);
    const auto stiff = mechanics(FROND_MECHANICS_TET_LINEAR).make(*model, FROND_MECHANICS_TET_LINEAR);
    ASSERT_EQ(soft->yields.size(), model->cage.tets.size());
    for (size_t e = 0; e < soft->yields.size(); ++e)
        EXPECT_NEAR(stiff->yields[e].strain, soft->yields[e].strain / 2, 1e-12);
}

}  // namespace plasticity_tests

}  // namespace frond::test
