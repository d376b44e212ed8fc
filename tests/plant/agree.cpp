// All mechanics agree on whole plants: corn and cucumber stand where their rods stand and have the same natural
// frequencies, by the modes of stiffness and mass as well as by free vibration.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include "calibration/calibration.hpp"
#include "calibration/static_stiffness.hpp"
#include "calibration/sway.hpp"
#include "modelling/build.hpp"
#include "plant/plant_step.hpp"
#include "support/model_def.hpp"
#include "support/sanitized.hpp"

namespace frond::test {
namespace agree_tests {

constexpr double ALIKE = 0.05;  // allowed relative difference between mechanics

std::shared_ptr<const Model> load(const std::string& name, double capsule_radius = 0) {
    static std::map<std::pair<std::string, double>, std::shared_ptr<const Model>> models;
    std::shared_ptr<const Model>& model = models[{name, capsule_radius}];
    frond_model_def def = model_def();
    def.capsule_radius = capsule_radius;
    if (!model) model = build_from_file(std::string(FROND_SOURCE_DIR) + "/models/" + name + "/" + name + ".obj", def);
    return model;
}

// Returns the first natural frequencies [Hz].
std::array<double, 2> frequencies(const std::shared_ptr<const Model>& model, frond_mechanics which, int order = 1) {
    ensure_rest_shape(*model, which, order);
    const auto system = make_system(model, which, FROND_MASS_LUMPED, order);
    const Elements& elements = elements_of(*system);
    const std::vector<uint8_t> still = still_nodes(*model, elements, mechanics(which).moves_chain);
    StaticStiffness stiffness(elements.pattern);
    if (!stiffness.set(elements, still, mechanics(which, order), Tangent::exact, elements.modelled)) return {};
    const auto sways = first_sways(stiffness.factor, node_mass_of(*system), still);
    return {std::sqrt(sways[0].square) / (2 * M_PI), std::sqrt(sways[1].square) / (2 * M_PI)};
}

// Returns the frequency of the highest peak of a signal's spectrum, with Hann's window [Hz].
double main_frequency(const std::vector<double>& signal, double h) {
    double mean = 0, best = 0, largest = 0;
    for (double s : signal) mean += s / double(signal.size());
    for (double f = 0.2; f < 6; f += 0.005) {
        double cosine = 0, sine = 0;
        for (size_t i = 0; i < signal.size(); i++) {
            const double window = 1 - std::cos(2 * M_PI * (double(i) + 0.5) / double(signal.size()));
            cosine += window * (signal[i] - mean) * std::cos(2 * M_PI * f * h * double(i));
            sine += window * (signal[i] - mean) * std::sin(2 * M_PI * f * h * double(i));
        }
        if (std::hypot(cosine, sine) <= largest) continue;
        largest = std::hypot(cosine, sine);
        best = f;
    }
    return best;
}

struct Standing {
    Vec3 tip;          // position under weight [m]
    double frequency;  // frequency of free vibration after a pull along x by a hundredth of the weight [Hz]
};
Standing watch(const std::shared_ptr<const Model>& model, frond_mechanics which) {
    constexpr double H = 1.0 / 120, DURATION = 8, LONG_STEP = 0.1, ASIDE = 0.01;  // [s], [-]
    constexpr int LONG_STEPS = 60;
    frond_plant_def def = {};
    def.rotation = {0, 0, 0, 1};
    def.mechanics = which;
    def.element_order = 1;
    def.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    def.tuning.newton_iterations = 2;
    def.tuning.newton_tolerance = 1e-6;
    def.tuning.linear_iterations = 100;
    def.tuning.linear_tolerance = 1e-6;
    def.effects = FROND_EFFECT_GRAVITY;
    const auto plant = create_plant(model, def);
    Surroundings surroundings;
    Standing standing;
    surroundings.gravity = {0, -GRAVITY, 0};
    for (int i = 0; i < LONG_STEPS; i++) step_plant(*plant, surroundings, LONG_STEP);
    const std::vector<ChainNode>& nodes = model->chain.nodes;
    size_t tip = 0;
    for (size_t i = 0; i < nodes.size(); i++)
        if (nodes[i].position.y() > nodes[tip].position.y()) tip = i;
    standing.tip = plant->view.chain_positions[tip];
    surroundings.gravity.x() = ASIDE * GRAVITY;
    for (int i = 0; i < LONG_STEPS; i++) step_plant(*plant, surroundings, LONG_STEP);
    surroundings.gravity.x() = 0;
    plant->input.settings.integrator = FROND_INTEGRATOR_BDF2;
    std::vector<double> sway;
    for (double t = 0; t < DURATION; t += H) {
        step_plant(*plant, surroundings, H);
        double sum = 0;
        for (size_t i = 0; i < nodes.size(); i++) sum += model->chain_mass[i] * plant->view.chain_positions[i].x();
        sway.push_back(sum);
    }
    standing.frequency = main_frequency(sway, H);
    return standing;
}

struct EveryPlant : testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Agree, EveryPlant, testing::Values("corn", "cucumber"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(EveryPlant, HasTheSameFirstSwaysInAllMechanics) {
    const auto model = load(GetParam());
    const auto rods = frequencies(model, FROND_MECHANICS_ROD);
    ASSERT_GT(rods[0], 0);
    for (int which = 0; which < FROND_MECHANICS_COUNT; which++) {
        const auto own = frequencies(model, frond_mechanics(which));
        for (size_t i : {0, 1})
            EXPECT_NEAR(own[i], rods[i], ALIKE * rods[i]) << mechanics(frond_mechanics(which)).name << " sway " << i;
    }
}

// A cage of quadratic tets is calibrated separately.
TEST(QuadraticTets, SwayAsTheRodsOfTheirPlantDo) {
    if (SANITIZED) GTEST_SKIP() << "takes minutes";
    const auto model = load("corn");
    const auto rods = frequencies(model, FROND_MECHANICS_ROD);
    for (const frond_mechanics which :
         {FROND_MECHANICS_TET_LINEAR, FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_TET_NEOHOOKEAN}) {
        const auto own = frequencies(model, which, 2);
        // Measured: 0.8, 5.2 (leaves in resonance with the stem) and 3.4 %; the last is a fit that ends anywhere from
        // 2.3 to 3.5 % if the leaves' density changes by 1 %.
        const double alike = which == FROND_MECHANICS_TET_LINEAR       ? 0.02
                             : which == FROND_MECHANICS_TET_NEOHOOKEAN ? 0.04
                                                                       : 0.06;
        for (size_t i : {0, 1}) EXPECT_NEAR(own[i], rods[i], alike * rods[i]) << mechanics(which).name << " sway " << i;
    }
}

struct EveryKind : testing::TestWithParam<std::tuple<const char*, frond_mechanics>> {};
INSTANTIATE_TEST_SUITE_P(Agree, EveryKind,
                         testing::Combine(testing::Values("corn", "cucumber"),
                                          testing::Values(FROND_MECHANICS_TET_LINEAR, FROND_MECHANICS_TET_COROTATIONAL,
                                                          FROND_MECHANICS_TET_NEOHOOKEAN,
                                                          FROND_MECHANICS_SPRING_CHAIN)),
                         [](const auto& info) {
                             return std::string(std::get<0>(info.param)) + "_" +
                                    mechanics(std::get<1>(info.param)).name;
                         });

TEST_P(EveryKind, StandsAndSwaysLikeRods) {
    if (SANITIZED) GTEST_SKIP() << "takes minutes";
    const auto [name, which] = GetParam();
    const auto model = load(name);
    const Standing rods = watch(model, FROND_MECHANICS_ROD), standing = watch(model, which);
    EXPECT_LT((standing.tip - rods.tip).norm(), ALIKE * model->surface.height());
    EXPECT_NEAR(standing.frequency, rods.frequency, ALIKE * rods.frequency);
}

// Fig 7 of the paper: the radius determines the springs.
TEST(SpringChain, IsStifferWithThickerCapsules) {
    const auto as_shape = frequencies(load("corn"), FROND_MECHANICS_SPRING_CHAIN);
    EXPECT_GT(frequencies(load("corn", 0.02), FROND_MECHANICS_SPRING_CHAIN)[0], 1.2 * as_shape[0]);
}

}  // namespace agree_tests

}  // namespace frond::test
