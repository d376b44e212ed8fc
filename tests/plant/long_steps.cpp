// Steps longer than the periods of hanging parts: fruits on thin peduncles come to rest where they hung.
#include <gtest/gtest.h>

#include "plant/plant_step.hpp"
#include "support/materials.hpp"
#include "support/model_def.hpp"

namespace frond::test {
namespace long_steps_tests {

// Returns a stiff post with an arm from which a fruit hangs on a thread, whose weight restores it 15 times as strongly
// as its stiffness.
std::shared_ptr<const Model> gallows() {
    const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.6, 0}, 0.02, 0.02},
                                {0, {0, 0.6, 0}, {0.3, 0.6, 0}, 0.02, 0.02},
                                {1, {0.3, 0.6, 0}, {0.3, 0.5, 0}, 0.002, 0.002},
                                {2, {0.3, 0.5, 0}, {0.3, 0.35, 0}, 0.02, 0.02}};
    const frond_organ_material organ = {"stem", plain_material(1000, 1e8, 0.3, 1e-3)};
    frond_model_def def = model_def();
    def.capsule_height = 0.05;
    def.organs = &organ;
    def.organ_count = 1;
    return build_from_stems(stems, 4, def);
}

std::unique_ptr<Plant> plant_of(const std::shared_ptr<const Model>& model) {
    frond_plant_def def = plant_def(FROND_MECHANICS_ROD);
    def.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    def.effects &= ~uint32_t(FROND_EFFECT_PLASTICITY | FROND_EFFECT_BREAKING);
    return create_plant(model, def);
}

// Tilts gravity for two steps, then lets the plant swing.
void swing(Plant& plant, double h) {
    Surroundings surroundings;
    surroundings.gravity = {0.1 * GRAVITY, -GRAVITY, 0.05 * GRAVITY};
    // Returns the largest displacement.
    const auto farthest = [&] {
        double way = 0;
        for (int i = 0; i < plant.state.motion.x.size() / 3; i += 2)
            way = std::max(way, (point(plant.state.motion.x, i) - point(elements_of(plant).modelled, i)).norm());
        return way;
    };
    double most = 0;
    for (int step = 0; step < 60; ++step) {
        if (step == 2) surroundings.gravity = {0, -GRAVITY, 0};
        step_plant(plant, surroundings, h);
        EXPECT_EQ(plant.trouble & FROND_TROUBLE_REWOUND, 0u) << step;
        most = std::max(most, farthest());
        ASSERT_LT(most, 0.6) << step;
    }
    EXPECT_GT(most, 0.003);
    EXPECT_LT(farthest(), 0.1 * most) << "steps of " << h;
}

TEST(LongSteps, LetWhatHangsOnAThreadComeToRest) {
    const auto model = gallows();
    for (double h : {0.1, 0.5, 2.0}) swing(*plant_of(model), h);
}

TEST(LongSteps, LetACucumberComeToRest) {
    const auto model = build_from_file(FROND_SOURCE_DIR "/models/cucumber/cucumber.obj", model_def());
    for (double h : {0.1, 0.5}) swing(*plant_of(model), h);
}

// A stem in a cage, bent far by sideways gravity and let go.
struct Swung {
    double kept = 0;  // share of its energy after half a second [-]
    int retried = 0;  // steps that were retried
};
Swung let_go(frond_integrator integrator, double h) {
    const frond_stem stem = {-1, {0, 0, 0}, {0, 1, 0}, 0.01, 0.01};
    const frond_organ_material organ = {"stem", plain_material(1000, 2e8, 0.3, 1e-4)};
    frond_model_def def = model_def();
    def.cage_size = 0.1;
    def.rest = FROND_REST_WITHOUT_GRAVITY;
    def.organs = &organ;
    def.organ_count = 1;
    frond_plant_def undamped = plant_def(FROND_MECHANICS_TET_COROTATIONAL);
    undamped.mass_damping = undamped.stiffness_damping = 0;
    undamped.effects = FROND_EFFECT_GRAVITY;
    const auto plant = create_plant(build_from_stems(&stem, 1, def), undamped);
    Surroundings surroundings;
    surroundings.gravity = {80, 0, 0};
    plant->input.settings.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    for (int i = 0; i < 200; i++) step_plant(*plant, surroundings, 0.05);
    surroundings.gravity.setZero();
    plant->input.settings.integrator = integrator;
    const double before = energy_of(*plant, Vec3::Zero()).elastic;
    Swung swung;
    for (double time = 0; time < 0.5; time += h) {
        step_plant(*plant, surroundings, h);
        swung.retried += (plant->trouble & FROND_TROUBLE_RETRIED) != 0;
    }
    const frond_energy after = energy_of(*plant, Vec3::Zero());
    swung.kept = (after.elastic + after.kinetic) / before;
    return swung;
}

// If one solve does not balance forces, more do; a step by implicit Euler would end the vibration.
TEST(LongSteps, KeepASwingThatOneSolveCannotFollow) {
    for (const frond_integrator integrator : {FROND_INTEGRATOR_BDF2, FROND_INTEGRATOR_SDIRK2}) {
        const Swung far = let_go(integrator, 1.0 / 30);
        EXPECT_GT(far.retried, 2) << integrator;
        EXPECT_GT(far.kept, integrator == FROND_INTEGRATOR_BDF2 ? 0.45 : 0.7) << integrator;
        EXPECT_LT(far.kept, 1.02) << integrator;
        const Swung near = let_go(integrator, 1.0 / 60);
        EXPECT_LE(near.retried, integrator == FROND_INTEGRATOR_BDF2 ? 0 : 2) << integrator;
        EXPECT_GT(near.kept, 0.85) << integrator;
        EXPECT_LT(near.kept, 1.02) << integrator;
    }
}

}  // namespace long_steps_tests

}  // namespace frond::test
