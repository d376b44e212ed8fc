// frond_recommend keeps its promises on stems: of errors within a factor of 1.2, of costs within two.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "study/problems.hpp"

using namespace frond::study;

namespace recommend_tests {

// Beams: slow and soft, about as measured, fast and stiff.
const Beam BEAMS[] = {{0.03, 2e7, 900, 0.4, {}}, {0.02, 1.28e8, 1000, 0.3, {}}, {0.015, 2e9, 600, 0.3, {}}};

frond_advice advice_for(const Model& model, double error, double cpu) {
    frond_advice advice;
    EXPECT_EQ(frond_recommend(model.handle, error, cpu, &advice), FROND_OK) << frond_last_error();
    return advice;
}

Setup setup_of(const frond_advice& advice) {
    Setup setup;
    setup.plant = advice.plant;
    setup.plant.effects &= ~uint32_t(FROND_EFFECT_DAMPING);
    setup.dt = advice.time_step;
    setup.resolution =
        int(std::lround(Beam::LENGTH / (advice.capsule_height > 0 ? advice.capsule_height : advice.cage_size)));
    return setup;
}

ModelPtr stem(const Beam& beam) {
    return make_beam(beam, static_baseline());
}

TEST(Recommend, KeepsItsErrorWithinAFifth) {
    Session session;
    session.effort = Effort::TINY;
    for (const Beam& beam : BEAMS)
        for (double wanted : {0.2, 0.04, 0.01}) {
            const frond_advice advice = advice_for(*stem(beam), wanted, 0);
            EXPECT_LE(advice.error, wanted);
            const Outcome outcome = sway_of(beam, setup_of(advice), session);
            EXPECT_LE(outcome.error, 1.2 * advice.error) << beam.young << " " << wanted;
        }
}

// The processor may differ from the table's, and may be busy: each time is compared with that of the cheapest settings
// of the measured beam, taken just before, and the median of three such pairs counts.
TEST(Recommend, KeepsItsCostWithinAFactorOfTwo) {
    Session session;
    session.effort = Effort::QUICK;
    const frond_advice first = advice_for(*stem(BEAMS[1]), 0.2, 0);
    const auto cost_of = [&](const Beam& beam, const frond_advice& advice) {
        std::array<double, 3> costs;
        for (double& cost : costs) {
            const double slower = sway_of(BEAMS[1], setup_of(first), session).cpu_per_second / first.cpu;
            cost = sway_of(beam, setup_of(advice), session).cpu_per_second / slower;
        }
        std::sort(costs.begin(), costs.end());
        return costs[1];
    };
    for (const Beam& beam : BEAMS)
        for (double wanted : {0.2, 0.04}) {
            const frond_advice advice = advice_for(*stem(beam), wanted, 0);
            const double cpu = cost_of(beam, advice);
            EXPECT_LE(cpu, 2 * advice.cpu) << beam.young << " " << wanted;
            EXPECT_GE(cpu, advice.cpu / 2) << beam.young << " " << wanted;
        }
}

TEST(Recommend, SpendsABudgetOnAccuracy) {
    const ModelPtr model = stem(BEAMS[1]);
    double before = 1e9;
    for (double share : {1.0, 4.0, 16.0}) {
        const double budget = share * advice_for(*model, 0.2, 0).cpu;
        const frond_advice advice = advice_for(*model, 0, budget);
        EXPECT_LE(advice.cpu, budget);
        EXPECT_LE(advice.error, before);
        before = advice.error;
    }
}

// A stem with a tenth of the stiffness has a period sqrt(10) times as long and may take longer steps.
TEST(Recommend, TakesStepsInProportionToThePeriod) {
    Beam soft = BEAMS[1];
    soft.young /= 10;
    const frond_advice a = advice_for(*stem(BEAMS[1]), 0.1, 0), b = advice_for(*stem(soft), 0.1, 0);
    EXPECT_NEAR(b.time_step / a.time_step, std::sqrt(10.0), 0.01);
    EXPECT_EQ(a.plant.mechanics, b.plant.mechanics);
}

TEST(Recommend, KnowsTheStemsOfACookedModel) {
    const ModelPtr model = stem(BEAMS[1]);
    std::vector<uint8_t> bytes(frond_model_get_saved_size(model->handle));
    must(frond_model_save_bytes(model->handle, bytes.data(), bytes.size()));
    frond_model again = {};
    must(frond_model_load_bytes(bytes.data(), bytes.size(), &again));
    const frond_advice a = advice_for(*model, 0.05, 0), b = advice_for(Model(again), 0.05, 0);
    EXPECT_EQ(a.capsule_height, b.capsule_height);
    EXPECT_EQ(a.time_step, b.time_step);
    EXPECT_EQ(a.error, b.error);
}

TEST(Recommend, RefusesWhatCannotBeAndSaysWhatCan) {
    const ModelPtr model = stem(BEAMS[1]);
    frond_advice advice;
    for (const auto& [error, cpu] :
         {std::pair<double, double>{0, 0}, {0.1, 0.1}, {-1, 0}, {NAN, 0}, {2, 0}, {0, INFINITY}}) {
        EXPECT_EQ(frond_recommend(model->handle, error, cpu, &advice), FROND_RESULT_BAD_ARGUMENT)
            << error << " " << cpu;
        EXPECT_EQ(advice.time_step, 0);
    }
    EXPECT_EQ(frond_recommend(model->handle, 0.1, 0, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_recommend({}, 0.1, 0, &advice), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_recommend(model->handle, 1e-9, 0, &advice), FROND_RESULT_UNSUPPORTED);
    EXPECT_NE(std::string(frond_last_error()).find("the least is"), std::string::npos);
    EXPECT_EQ(frond_recommend(model->handle, 0, 1e-12, &advice), FROND_RESULT_UNSUPPORTED);
    EXPECT_NE(std::string(frond_last_error()).find("the cheapest take"), std::string::npos);
}

}  // namespace recommend_tests
