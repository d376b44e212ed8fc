// Forces of the host: their momentum is what they give, however long they act and whatever integrates.
#include <gtest/gtest.h>

#include "plant/plant.hpp"
#include "support/materials.hpp"
#include "support/model_def.hpp"

namespace frond::test {
namespace push_tests {

constexpr double H = 1.0 / 60;

std::unique_ptr<Plant> free_stem(frond_mechanics which, frond_integrator method) {
    const frond_stem stem = {-1, {0, 0, 0}, {0, 0.6, 0}, 0.012, 0.01};
    const frond_organ_material organ = {"stem", plain_material(800, 5e7, 0.3, 1e-3)};
    frond_model_def model = model_def();
    model.cage_size = 0.08;
    model.organs = &organ;
    model.organ_count = 1;
    frond_plant_def def = plant_def(which);
    def.integrator = method;
    def.root_height = -1;
    def.mass_damping = 0;
    return create_plant(build_from_stems(&stem, 1, model), def);
}

Vec3 momentum(const Plant& plant) {
    const VecX& mass = node_mass_of(*plant.system);
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < mass.size(); i += plant.follow ? 2 : 1) sum += mass[i] * point(plant.state.motion.v, i);
    return sum;
}

// Pushes evenly, so that the stem flies without bending.
void push(Plant& plant, const Vec3& force) {
    const int nodes = node_count_of(plant);
    forces_of(plant).on_nodes = VecX::Zero(3 * nodes);
    for (int i = 0; i < nodes; i++) point(plant.input.forces->on_nodes, i) = force / nodes;
    plant.input.has_user_force = true;
}

struct EveryPush : testing::TestWithParam<std::tuple<frond_mechanics, frond_integrator>> {};
INSTANTIATE_TEST_SUITE_P(Push, EveryPush,
                         testing::Combine(testing::Values(FROND_MECHANICS_ROD, FROND_MECHANICS_TET_COROTATIONAL),
                                          testing::Values(FROND_INTEGRATOR_IMPLICIT_EULER, FROND_INTEGRATOR_BDF2,
                                                          FROND_INTEGRATOR_SDIRK2, FROND_INTEGRATOR_TR_BDF2,
                                                          FROND_INTEGRATOR_GENERALIZED_ALPHA)));

TEST_P(EveryPush, GivesItsMomentum) {
    const auto [which, method] = GetParam();
    for (const int before : {0, 1, 5})
        for (const int count : {1, 2, 3, 10}) {
            const auto plant = free_stem(which, method);
            const Vec3 force(0.2, 0.1, 0);
            for (int i = 0; i < before; i++) step_plant(*plant, {}, H);
            for (int i = 0; i < count; i++) {
                push(*plant, force);
                step_plant(*plant, {}, H);
                clear_user_force(*plant);
            }
            const Vec3 given = count * H * force;
            for (int i = 0; i < 10; i++) {
                step_plant(*plant, {}, H);
                EXPECT_LT((momentum(*plant) - given).norm(), 0.01 * given.norm())
                    << count << " steps after " << before << ", " << i + 1 << " steps later";
            }
        }
}

}  // namespace push_tests
}  // namespace frond::test
