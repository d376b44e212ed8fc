// Forces of the host: their momentum is what they give, however long they act and whatever integrates.
#include <gtest/gtest.h>

#include "mechanics/rotation.hpp"
#include "plant/plant_step.hpp"
#include "solve/integrator.hpp"
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

// A push that is found after the solve, as contacts' are, turns the nodes as one that was known before. The system is
// linear, so both are the same; but nodes that pass half a turn change their rotation vectors.
TEST(PushOfRods, AfterTheSolveIsThatWithin) {
    constexpr double SPIN = 20;  // [rad/s]
    const auto plant = free_stem(FROND_MECHANICS_ROD, FROND_INTEGRATOR_IMPLICIT_EULER);
    const int nodes = elements_of(*plant->system).node_count;
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0.6, 0, 0.8), Vec3(0.36, 0.48, 0.8)})
        for (double angle = 0.1; angle < 3.2; angle += 0.1) {
            Motion motion = plant->state.motion;
            const Mat3 turn = rotation_of<double>(angle * axis);
            for (int i = 0; i < nodes; i += 2) {
                point(motion.x, i) = turn * point(motion.x, i);
                point(motion.v, i) = (SPIN * axis).cross(point(motion.x, i));
                point(motion.x, i + 1) = angle * axis;
                point(motion.v, i + 1) = SPIN * axis;
            }
            motion.history.valid = false;
            SolveSettings settings = plant->input.settings;
            settings.is_touched = true;
            const auto workspace = make_workspace(plant->system);
            VecX impulse = VecX::Zero(motion.x.size()), dv;
            point(impulse, nodes - 2) = 1e-3 * axis.unitOrthogonal();

            Motion within = motion;
            Loads loads;
            loads.force = impulse / H;
            ASSERT_TRUE(solve_step(*workspace, settings, loads, H, within).ok);
            loads.force.setZero();
            ASSERT_TRUE(solve_step(*workspace, settings, loads, H, motion).ok);
            const VecX v = motion.v;
            ASSERT_TRUE(respond(*workspace, settings, impulse, dv));
            add_response(*workspace, dv, motion);
            EXPECT_GT((motion.v - v).norm(), 1e-3);
            unwind(motion);
            unwind(within);
            EXPECT_LT((motion.x - within.x).norm(), 1e-9) << angle << " about " << axis.transpose();
            EXPECT_LT((motion.v - within.v).norm(), 1e-7) << angle << " about " << axis.transpose();
        }
}

}  // namespace push_tests
}  // namespace frond::test
