// Steps that are divided where their error requires it.
#include <gtest/gtest.h>

#include <cmath>

#include "modelling/build.hpp"
#include "plant/pins.hpp"
#include "plant/plant_step.hpp"
#include "support/materials.hpp"

namespace frond::test {
namespace substeps_tests {

constexpr double H = 1.0 / 30;

std::shared_ptr<const Model> stem_model() {
    const frond_stem stem = {-1, {0, 0, 0}, {0, 0.6, 0}, 0.012, 0.012};
    frond_organ_material organ = {"stem", plain_material(1000, 1e8, 0.3, 1e-3)};
    frond_model_def def = {};
    def.scale = 1;
    def.allow_stiffening = INFINITY;
    def.cage_smoothness = 0.5;
    def.cage_size = 0.08;
    def.organs = &organ;
    def.organ_count = 1;
    return build_from_stems(&stem, 1, def);
}

std::unique_ptr<Plant> stem(const std::shared_ptr<const Model>& model, frond_mechanics which, int most,
                            double tolerance) {
    frond_plant_def def = {};
    def.rotation = {0, 0, 0, 1};
    def.mechanics = which;
    def.element_order = 1;
    def.integrator = FROND_INTEGRATOR_BDF2;
    def.tuning.newton_iterations = 4;
    def.tuning.newton_tolerance = 1e-9;
    def.tuning.linear_iterations = 100;
    def.tuning.linear_tolerance = 1e-6;
    def.effects = FROND_EFFECT_ALL;
    def.tuning.max_substeps = most;
    def.tuning.substep_tolerance = tolerance;
    return create_plant(model, def);
}

// Lets the plant swing freely after a push on all its nodes; returns the position of its end after a third of a second.
Vec3 swing(Plant& plant, double h, int* solves = nullptr) {
    const VecX& modelled = cage_places(plant);
    std::vector<double> velocities(size_t(modelled.size()), 0);
    for (int i = 0; i < node_count_of(plant); ++i) velocities[3 * size_t(i)] = 3 * point(modelled, i).y();
    set_state(plant, nullptr, velocities.data());
    Surroundings surroundings;
    surroundings.gravity = {0, -GRAVITY, 0};
    for (int n = 0; n < int(std::lround(1 / (3 * h))); ++n) {
        step_plant(plant, surroundings, h);
        EXPECT_EQ(plant.trouble & ~uint32_t(FROND_TROUBLE_NOT_CONVERGED), 0u);
        if (solves) *solves += plant.report.iterations;
    }
    return plant.view.chain_positions.back();
}

struct Substeps : testing::TestWithParam<int> {
    const frond_mechanics which = frond_mechanics(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Mechanics, Substeps,
                         testing::Values(int(FROND_MECHANICS_TET_COROTATIONAL), int(FROND_MECHANICS_ROD)));

TEST_P(Substeps, MakeTheErrorAsSmallAsIsAskedFor) {
    const std::shared_ptr<const Model> model = stem_model();
    const Vec3 exact = swing(*stem(model, which, 1, 1e-4), H / 256);
    double before = (swing(*stem(model, which, 1, 1e-4), H) - exact).norm();
    int solves_before = 0;
    for (double tolerance : {1e-3, 1e-4}) {
        int solves = 0;
        const double error = (swing(*stem(model, which, 64, tolerance), H, &solves) - exact).norm();
        EXPECT_LT(error, 0.6 * before) << tolerance;
        EXPECT_GT(solves, solves_before);
        before = error;
        solves_before = solves;
    }
    EXPECT_LT(before, 0.005);
}

TEST_P(Substeps, AreNoMoreThanAllowedAndOneWhereNothingMoves) {
    const std::shared_ptr<const Model> model = stem_model();
    const auto plant = stem(model, which, 4, 1e-9);
    swing(*plant, H);
    EXPECT_EQ(plant->state.substeps, 4);
    const auto still = stem(model, which, 64, 1e-7);
    Surroundings surroundings;
    surroundings.gravity = {0, -GRAVITY, 0};
    for (int n = 0; n < 5; ++n) step_plant(*still, surroundings, H);
    EXPECT_EQ(still->state.substeps, 1);
    EXPECT_LE(still->report.iterations, 4);
}

TEST_P(Substeps, ThatAreOffChangeNoBit) {
    const std::shared_ptr<const Model> model = stem_model();
    const auto off = stem(model, which, 1, 1e-9), loose = stem(model, which, 64, 1);
    swing(*off, H);
    swing(*loose, H);
    EXPECT_EQ(off->state.motion.x, loose->state.motion.x);
    EXPECT_EQ(off->state.trend.rate.size(), 0);
}

TEST_P(Substeps, MoveWhatIsHeldEvenly) {
    const std::shared_ptr<const Model> model = stem_model();
    const auto plant = stem(model, which, 8, 1e-6);
    const Surroundings surroundings;
    // Move the whole foot, so that the plant is carried along.
    const VecX from = cage_places(*plant);
    for (int n = 1; n <= 6; ++n) {
        for (int i = 0; i < node_count_of(*plant); ++i)
            if (plant->input.pinned[size_t(i)]) move_pin(*plant, i, point(from, i) + Vec3(0.02 * n, 0, 0));
        step_plant(*plant, surroundings, H);
        for (int i = 0; i < node_count_of(*plant); ++i)
            if (plant->input.pinned[size_t(i)]) {
                EXPECT_LT((point(cage_places(*plant), i) - point(from, i) - Vec3(0.02 * n, 0, 0)).norm(), 2e-4);
            }
    }
    EXPECT_GT(plant->state.substeps, 1);
    EXPECT_EQ(plant->trouble & FROND_TROUBLE_REWOUND, 0u);
}

}  // namespace substeps_tests

}  // namespace frond::test
