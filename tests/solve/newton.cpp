// Newton's method: quadratic convergence with the exact stiffness, and convergence from any start.
#include <gtest/gtest.h>

#include "support/rig.hpp"

namespace frond::test {
namespace newton_tests {

// Returns a soft beam thrown sideways hard, with all kinds of damping and a spring.
Rig thrown(int iterations, double tolerance, double young = 2e5, double speed = 6,
           frond_mechanics which = FROND_MECHANICS_TET_COROTATIONAL, int order = 1) {
    RigSettings settings = plain_settings(which);
    settings.order = order;
    Rig rig(box_model(2, 8, 2, {0.1, 0.8, 0.1}, {900, young, 0.3}), settings);
    rig.settings.newton_iterations = iterations;
    rig.settings.newton_tolerance = tolerance;
    rig.settings.mass_damping = 0.3;
    rig.settings.stiffness_damping = 0.01;
    rig.pin_below(1, 0);
    rig.loads.gravity = {0, -9.81, 0};
    rig.loads.springs.push_back(tet_spring(*rig.system, 3, {0.25, 0.25, 0.25, 0.25}, {0.2, 0.1, 0}, 30));
    for (int i = 0; i < rig.node_count(); ++i) point(rig.motion.v, i).x() = speed * point(rig.motion.x, i).y();
    return rig;
}

TEST(Newton, ConvergesQuadratically) {
    for (int order = 1; order <= HIGHEST_ORDER; ++order) {
        const auto start = [&](int iterations) {
            return thrown(iterations, 0, 2e5, 6, FROND_MECHANICS_TET_COROTATIONAL, order);
        };
        Rig reference = start(40);
        const SolveReport report = reference.step(1.0 / 30);
        ASSERT_TRUE(report.ok && report.converged);
        std::vector<double> errors;
        for (int iterations = 1; iterations <= 8; ++iterations) {
            Rig rig = start(iterations);
            ASSERT_TRUE(rig.step(1.0 / 30).ok);
            errors.push_back((rig.motion.x - reference.motion.x).norm());
            if (errors.back() < 1e-10) break;
        }
        // Each of the last steps before the limit of double precision about doubles the number of correct digits.
        ASSERT_GE(errors.size(), 3u);
        EXPECT_LT(errors.back(), 1e-10);
        const size_t n = errors.size();
        EXPECT_GT(std::log(errors[n - 2]) / std::log(errors[n - 3]), 1.6) << errors[n - 3] << " " << errors[n - 2];
    }
}

TEST(Newton, SaysWhetherItReachedItsTolerance) {
    Rig rig = thrown(2, 1e-10);
    SolveReport report = rig.step(1.0 / 30);
    EXPECT_TRUE(report.ok);
    EXPECT_FALSE(report.converged);
    rig = thrown(30, 1e-10);
    report = rig.step(1.0 / 30);
    EXPECT_TRUE(report.converged);
    EXPECT_GT(report.iterations, 2);
    EXPECT_LT(report.iterations, 15);
    // A loose tolerance is cheaper.
    rig = thrown(30, 1e-2);
    EXPECT_LT(rig.step(1.0 / 30).iterations, report.iterations);
}

TEST(Newton, NeedsOneSolveForALinearBody) {
    Rig rig = thrown(10, 1e-6, 2e5, 6, FROND_MECHANICS_TET_LINEAR);
    const SolveReport report = rig.step(1.0 / 30);
    EXPECT_TRUE(report.ok && report.converged);
    EXPECT_EQ(report.iterations, 1);
}

TEST(Newton, GetsToTheEndWhereTheExactStiffnessIsNotPositive) {
    // Nodes pressed together at random: strong compression, for which the exact stiffness has no Cholesky factor.
    for (int solver = 0; solver < FROND_LINEAR_SOLVER_COUNT; ++solver) {
        Rig rig = thrown(100, 1e-8, 1e5, 0);
        rig.settings.linear_solver = frond_linear_solver(solver);
        rig.settings.stiffness_damping = 0;
        rig.motion.x *= 0.4;
        rig.motion.pinned.assign(rig.motion.pinned.size(), 0);
        Dice dice(5);
        rig.motion.x += dice.vector(rig.motion.x.size(), 0.05);
        const SolveReport report = rig.step(0.5);
        EXPECT_TRUE(report.ok);
        EXPECT_TRUE(report.converged) << solver;
    }
}

TEST(Newton, IteratedStepsSolveTheEquationAtTheEndOfTheStep) {
    for (int mass = 0; mass < FROND_MASS_COUNT; ++mass) {
        Rig rig(box_model(1, 4, 1, {0.1, 0.4, 0.1}, {900, 1e5, 0.3}), plain_settings(), frond_mass(mass));
        rig.settings.newton_iterations = 20;
        rig.settings.newton_tolerance = 1e-11;
        rig.settings.mass_damping = 0.5;
        for (int i = 0; i < rig.node_count(); ++i) point(rig.motion.v, i).x() = 9 * point(rig.motion.x, i).y();
        const Motion before = rig.motion;
        const double h = 1.0 / 30;
        ASSERT_TRUE(rig.step(h).converged);
        // w . (M dv - h (f(x') - a M v')) = 0 for all w.
        VecX f = VecX::Zero(before.x.size());
        rig.row().add_force(elements_of(*rig.system), rig.motion.x, f);
        const VecX momentum = rig.motion.v - before.v + h * 0.5 * rig.motion.v;
        Dice dice(7);
        for (int trial = 0; trial < 5; ++trial) {
            const VecX w = dice.vector(f.size(), 1);
            const double inertia =
                0.5 * (kinetic_energy(*rig.system, w + momentum) - kinetic_energy(*rig.system, w - momentum));
            EXPECT_NEAR(inertia, h * w.dot(f), 1e-7 * h * f.norm());
        }
    }
}

}  // namespace newton_tests

}  // namespace frond::test
