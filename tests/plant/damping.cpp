// Material damping: the first mode decays with the organs' damping ratio, each organ damps its own bending, and a ratio
// of zero costs nothing and changes nothing.
#include <gtest/gtest.h>

#include <cmath>

#include "modelling/build.hpp"
#include "plant/plant_step.hpp"
#include "solve/integrator.hpp"
#include "support/materials.hpp"
#include "support/model_def.hpp"
#include "support/sanitized.hpp"

namespace frond::test {
namespace damping_tests {

constexpr double H = 1.0 / 240;

// Returns two stems one on top of the other, 0.8 m in all, each with its own damping ratio.
std::shared_ptr<const Model> stem_model(double low_ratio, double high_ratio, frond_rest rest) {
    const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.4, 0}, 0.02, 0.02}, {0, {0, 0.4, 0}, {0, 0.8, 0}, 0.02, 0.016}};
    frond_organ_material organs[] = {{"stem_0", plain_material(1000, 2e7, 0.3, 1e-3)},
                                     {"stem_1", plain_material(1000, 2e7, 0.3, 1e-3)}};
    organs[0].material.damping_ratio = low_ratio;
    organs[1].material.damping_ratio = high_ratio;
    frond_model_def def = {};
    def.scale = 1;
    def.allow_stiffening = INFINITY;
    def.cage_smoothness = 0.5;
    def.cage_size = 0.06;
    def.rest = rest;
    def.organs = organs;
    def.organ_count = 2;
    return build_from_stems(stems, 2, def);
}

// A plant that vibrates freely after a push at its top, with material damping only.
struct Swaying {
    std::unique_ptr<Plant> plant;
    Surroundings surroundings;
    double still;  // energy before the push [J]

    Swaying(const std::shared_ptr<const Model>& model, frond_mechanics which, double scale, bool heavy) {
        frond_plant_def def = plant_def(which);
        def.integrator = FROND_INTEGRATOR_TR_BDF2;
        def.tuning.newton_iterations = 2;
        def.material_damping = scale;
        plant = create_plant(model, def);
        if (heavy) surroundings.gravity = {0, -GRAVITY, 0};
        still = 0;
        still = energy();
        VecX v = VecX::Zero(3 * node_count_of(*plant));
        for (int i = 0; i < node_count_of(*plant); ++i) {
            const double y = cage_places(*plant)[3 * i + 1];
            if (!plant->input.pinned[size_t(i)]) v[3 * i] = 0.1 * y * y;
        }
        set_state(*plant, nullptr, v.data());
    }
    double tip() const { return plant->view.chain_positions.back().x(); }
    void step() { step_plant(*plant, surroundings, H); }

    double energy() const {
        const frond_energy e = energy_of(*plant, surroundings.gravity);
        return e.kinetic + e.elastic + e.gravity - still;
    }

    // Returns the damping ratio from the decay of energy over six half periods of the tip; energy, as an asymmetric
    // cage spreads vibration to the perpendicular plane. The first swing is left out, in which higher modes decay.
    double decay() {
        double before = 0, last = 0;
        int turns = 0, steps = 0;
        double sum_t = 0, sum_tt = 0, sum_e = 0, sum_te = 0;
        for (int n = 0; n < 1500 && turns < 8; ++n, before = last, last = tip()) {
            const double x = last;
            step();
            turns += n > 1 && (x - before) * (tip() - x) < 0;
            if (turns < 2) continue;
            const double t = H * steps++, e = std::log(energy());
            sum_t += t, sum_tt += t * t, sum_e += e, sum_te += t * e;
        }
        EXPECT_EQ(turns, 8) << "it does not sway";
        const double slope = (steps * sum_te - sum_t * sum_e) / (steps * sum_tt - sum_t * sum_t);
        const double decrement = -0.5 * slope * steps * H / 6;  // logarithmic decrement of half a period
        return decrement / std::hypot(decrement, M_PI);
    }
};

struct EveryDamping : testing::TestWithParam<int> {
    const frond_mechanics which = frond_mechanics(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Mechanics, EveryDamping,
                         testing::ValuesIn(SANITIZED
                                               ? std::vector<int>{FROND_MECHANICS_ROD}
                                               : std::vector<int>{FROND_MECHANICS_TET_COROTATIONAL,
                                                                  FROND_MECHANICS_TET_NEOHOOKEAN, FROND_MECHANICS_ROD}),
                         [](const auto& info) { return mechanics(frond_mechanics(info.param)).name; });

TEST_P(EveryDamping, FirstSwayDecaysWithTheRatioThatIsGiven) {
    for (double ratio : {0.02, 0.1}) {
        const auto model = stem_model(ratio, ratio, FROND_REST_WITHOUT_GRAVITY);
        // A cage of one cell across has a slightly different mode shape.
        const double few_per_cent = which == FROND_MECHANICS_ROD ? 0.03 : 0.06;
        EXPECT_NEAR(Swaying(model, which, 1, false).decay(), ratio, few_per_cent * ratio);
        EXPECT_NEAR(Swaying(model, which, 0.5, false).decay(), 0.5 * ratio, few_per_cent * ratio);
    }
}

// Weight lowers the frequency but does not change the damping.
TEST_P(EveryDamping, FirstSwayDecaysWithTheRatioUnderWeightToo) {
    const auto model = stem_model(0.05, 0.05, FROND_REST_STANDS_AS_MODELLED);
    EXPECT_NEAR(Swaying(model, which, 1, true).decay(), 0.05, 0.05 * 0.05);
}

TEST_P(EveryDamping, OrgansDampEachWhatBendsInItself) {
    const auto decay = [&](double low, double high) {
        return Swaying(stem_model(low, high, FROND_REST_WITHOUT_GRAVITY), which, 1, false).decay();
    };
    // Shares of the bending energy add up, and most of it is in the lower half.
    const double low = decay(0.1, 0), high = decay(0, 0.1);
    EXPECT_NEAR(low + high, 0.1, 0.005);
    EXPECT_GT(low, 0.08);
    EXPECT_GT(high, 0.002);
    EXPECT_NEAR(decay(0.1, 0.05), low + 0.5 * high, 0.005);
}

TEST_P(EveryDamping, RatioOfZeroChangesNoBit) {
    const auto run = [&](double ratio, double scale) {
        Swaying swaying(stem_model(ratio, ratio, FROND_REST_WITHOUT_GRAVITY), which, scale, false);
        swaying.plant->input.settings.stiffness_damping = 0.002;
        for (int n = 0; n < 50; ++n) swaying.step();
        return swaying.plant->state.motion.x;
    };
    const VecX without = run(0, 0);
    EXPECT_EQ(run(0, 1), without);
    EXPECT_EQ(run(0.05, 0), without);
    EXPECT_NE(run(0.05, 1), without);
}

// Elements with equal damping take a shorter computation; the general one gives the same.
TEST_P(EveryDamping, OneRatioOrTwoAlmostAlikeMoveAlike) {
    for (frond_integrator method : {FROND_INTEGRATOR_IMPLICIT_EULER, FROND_INTEGRATOR_BDF2, FROND_INTEGRATOR_SDIRK2,
                                    FROND_INTEGRATOR_GENERALIZED_ALPHA}) {
        const auto run = [&](double high) {
            Swaying swaying(stem_model(0.1, high, FROND_REST_WITHOUT_GRAVITY), which, 1, false);
            swaying.plant->input.settings.integrator = method;
            for (int n = 0; n < 100; ++n) swaying.step();
            return swaying.plant->state.motion.x;
        };
        const VecX alike = run(0.1), still = run(0.3);
        EXPECT_LT((run(0.1 * (1 + 1e-9)) - alike).norm(), 1e-5 * (still - alike).norm()) << integrator(method).name;
    }
}

TEST_P(EveryDamping, DampsNothingWhereTheEffectIsOff) {
    const auto model = stem_model(0.3, 0.3, FROND_REST_WITHOUT_GRAVITY);
    Swaying off(model, which, 1, false), none(model, which, 0, false);
    off.plant->input.effects &= ~uint32_t(FROND_EFFECT_DAMPING);
    for (int n = 0; n < 50; ++n) {
        off.step();
        none.step();
    }
    EXPECT_EQ(off.plant->state.motion.x, none.plant->state.motion.x);
}

}  // namespace damping_tests

}  // namespace frond::test
