// Order of the implicit integrators on rods: two where the motion is smooth. A sudden load excites modes that no step
// resolves, and the order is then irregular.
#include <gtest/gtest.h>

#include <cmath>

#include "modelling/build.hpp"
#include "plant/plant_step.hpp"
#include "support/materials.hpp"
#include "support/model_def.hpp"

namespace frond::test {
namespace order_tests {

// Returns the nodes of a stem after half a second of gravity across it that rises and falls smoothly.
VecX bend(const std::shared_ptr<const Model>& model, frond_integrator which, int steps) {
    constexpr double DURATION = 0.5;  // [s]
    frond_plant_def def = plant_def(FROND_MECHANICS_ROD);
    def.integrator = which;
    def.effects = FROND_EFFECT_GRAVITY;
    const auto plant = create_plant(model, def);
    Surroundings surroundings;
    for (int i = 0; i < steps; i++) {
        surroundings.gravity = {GRAVITY * std::pow(std::sin(M_PI * (i + 0.5) / steps), 4), 0, 0};
        step_plant(*plant, surroundings, DURATION / steps);
    }
    return plant->state.motion.x;
}

TEST(Order, OfTrBdf2AndSdirk2IsTwoOnRods) {
    frond_organ_material material = {"stem", plain_material(900, 2e8, 0.3, 1e-3)};
    frond_model_def def = model_def();
    def.organs = &material;
    def.organ_count = 1;
    def.rest = FROND_REST_WITHOUT_GRAVITY;
    def.capsule_height = 0.1;
    const frond_stem stem = {-1, {0, 0, 0}, {0, 1, 0}, 0.015, 0.015};
    const auto model = build_from_stems(&stem, 1, def);
    for (const frond_integrator which : {FROND_INTEGRATOR_TR_BDF2, FROND_INTEGRATOR_SDIRK2}) {
        VecX last = bend(model, which, 60);
        double change = 0;
        for (int steps = 120; steps <= 480; steps *= 2) {
            const VecX now = bend(model, which, steps);
            const double next = (now - last).norm();
            if (change > 0) {
                EXPECT_NEAR(std::log2(change / next), 2, 0.08) << which << " " << steps;
            }
            change = next;
            last = now;
        }
        EXPECT_LT(change, 1e-3);
    }
}

}  // namespace order_tests
}  // namespace frond::test
