// Properties of a step with every mechanics, integrator, linear solver and mass.
#include <gtest/gtest.h>

#include "support/rig.hpp"

namespace frond::test {
namespace step_tests {

struct EveryStep : EveryCombination {
    const double H = time_step();
    // Returns velocity and displacement of a point from v on, accelerated by g - a v, by the integrator's recurrence.
    std::array<double, 2> recurrence(double v, double g, double a, int steps) const;
};
INSTANTIATE_TEST_SUITE_P(Step, EveryStep, testing::ValuesIn(every_combination()), combination_name);

std::array<double, 2> EveryStep::recurrence(double v, double g, double a, int steps) const {
    double x = 0, x_prev = 0, v_prev = 0, x_rate = 0, v_rate = 0;
    const double h = H;
    // v' = base + step (g - a v')
    const auto stage = [&](double base, double step) { return (base + step * g) / (1 + step * a); };
    const auto sdirk2 = [&] {
        const double q = 1 - std::sqrt(0.5), v1 = stage(v, q * h), v_base = v + (1 - q) / q * (v1 - v);
        const double v2 = stage(v_base, q * h);
        x += h * ((1 - q) * v1 + q * v2);
        v = v2;
        x_rate = v, v_rate = g - a * v;
    };
    for (int n = 0; n < steps; ++n) {
        const double x_now = x, v_now = v;
        switch (GetParam().integrator) {
            case FROND_INTEGRATOR_IMPLICIT_EULER:
                v = stage(v, h), x += h * v;
                break;
            case FROND_INTEGRATOR_BDF2:
                if (n == 0) {
                    sdirk2();
                    break;
                }
                v = stage((4 * v - v_prev) / 3, 2 * h / 3);
                x = (4 * x - x_prev) / 3 + 2 * h / 3 * v;
                break;
            case FROND_INTEGRATOR_SDIRK2:
                sdirk2();
                break;
            case FROND_INTEGRATOR_TR_BDF2: {
                const double q = 2 - std::sqrt(2.0), v1 = stage(v + q * h / 2 * (g - a * v), q * h / 2);
                const double x1 = x + q * h / 2 * (v + v1), b = 1 / (q * (2 - q)), c = (1 - q) * (1 - q) * b;
                v = stage(b * v1 - c * v, q * h / 2);
                x = b * x1 - c * x + q * h / 2 * v;
                break;
            }
            case FROND_INTEGRATOR_GENERALIZED_ALPHA: {
                if (n == 0) {
                    sdirk2();
                    break;
                }
                // rates: m r' + (1-m) r = f((1-f) y + f y'), y' = y + h ((1-c) r + c r')
                const double s = 0.8, m = (3 - s) / (2 + 2 * s), f = 1 / (1 + s), c = 0.5 + m - f;
                const double r = (g - a * (v + f * h * (1 - c) * v_rate) - (1 - m) * v_rate) / (m + a * f * h * c);
                const double v_next = v + h * ((1 - c) * v_rate + c * r);
                const double x_rate_next = ((1 - f) * v + f * v_next - (1 - m) * x_rate) / m;
                x += h * ((1 - c) * x_rate + c * x_rate_next);
                v = v_next, v_rate = r, x_rate = x_rate_next;
                break;
            }
            case FROND_INTEGRATOR_SYMPLECTIC_EULER:
                v += h * (g - a * v), x += h * v;
                break;
            default:
                ADD_FAILURE() << "give the new integrator its recurrence here";
        }
        x_prev = x_now, v_prev = v_now;
    }
    return {v, x};
}

TEST_P(EveryStep, FallsFreelyByTheIntegratorsOwnRecurrence) {
    Rig rig(box_model(2, 2, 2, {0.1, 0.1, 0.1}, {900, 1e6, 0.3}), settings(), mass());
    rig.loads.gravity = {1, -9.81, 2};
    const VecX start = rig.motion.x;
    const int steps = 30;
    rig.steps(steps, H);
    const std::array<double, 2> unit = recurrence(0, 1, 0, steps);
    EXPECT_NEAR(unit[0], H * steps, 1e-12);
    EXPECT_NEAR(unit[1], H * H * steps * steps / 2, H * H * steps);
    for (int i = 0; i < rig.node_count(); ++i) {
        EXPECT_NEAR((point(rig.motion.x, i) - point(start, i) - unit[1] * rig.loads.gravity).norm(), 0, 1e-9);
        EXPECT_NEAR((point(rig.motion.v, i) - unit[0] * rig.loads.gravity).norm(), 0, 1e-9);
    }
}

TEST_P(EveryStep, KeepsMomentum) {
    Rig rig(box_model(1, 3, 1, {0.1, 0.3, 0.1}, {900, 1e5, 0.3}), settings(), mass());
    rig.settings.stiffness_damping = 0.01;
    Dice dice(1);
    rig.motion.v = dice.vector(rig.motion.v.size(), 1);
    const Vec3 before = rig.momentum();
    rig.steps(40, H);
    EXPECT_NEAR((rig.momentum() - before).norm(), 0, 1e-9 * before.norm());
    EXPECT_GT(rig.elastic_energy(), 0);
}

TEST_P(EveryStep, TakesEnergyAwayAndNeverGives) {
    Rig rig(box_model(1, 4, 1, {0.1, 0.4, 0.1}, {900, 1e5, 0.3}), settings(), mass());
    rig.settings.newton_iterations = 5;
    rig.pin_below(1, 0);
    // Only implicit Euler removes energy in every single step; the others must not return any in the end.
    const bool euler = GetParam().integrator == FROND_INTEGRATOR_IMPLICIT_EULER;
    const double slack = euler ? 1e-6 : 0.01;
    for (int i = 0; i < rig.node_count(); ++i) point(rig.motion.v, i).x() = 3 * point(rig.motion.x, i).y();
    double before = kinetic_energy(*rig.system, rig.motion.v) + rig.elastic_energy();
    for (int n = 0; n < 120; ++n) {
        ASSERT_TRUE(rig.step(H).ok);
        const double now = kinetic_energy(*rig.system, rig.motion.v) + rig.elastic_energy();
        EXPECT_LE(now, before * (1 + slack) + 1e-12) << n;
        if (euler) before = now;
    }
}

TEST_P(EveryStep, MassDampingSlowsTheWholeBodyAlike) {
    Rig rig(box_model(1, 1, 2, {0.1, 0.1, 0.2}), settings(), mass());
    rig.settings.mass_damping = 2;
    for (int i = 0; i < rig.node_count(); ++i) point(rig.motion.v, i) = Vec3(1, -2, 0.5);
    rig.steps(10, H);
    const Vec3 expected = Vec3(1, -2, 0.5) * recurrence(1, 0, 2, 10)[0];
    EXPECT_NEAR(expected.y(), -2 * std::exp(-2 * 10 * H), 0.02);
    for (int i = 0; i < rig.node_count(); ++i) EXPECT_NEAR((point(rig.motion.v, i) - expected).norm(), 0, 1e-9);
}

TEST_P(EveryStep, StiffnessDampingStopsShakingButNotTurning) {
    if (is_explicit()) GTEST_SKIP() << "too short for it to be seen";
    const auto spin_after = [&](double damping) {
        Rig rig(box_model(2, 2, 2, {0.1, 0.1, 0.1}, {900, 1e6, 0.3}), settings(), mass());
        rig.settings.stiffness_damping = damping;
        const Vec3 middle(0.05, 0.05, 0.05), spin(0, 0.2, 0);
        for (int i = 0; i < rig.node_count(); ++i) point(rig.motion.v, i) = spin.cross(point(rig.motion.x, i) - middle);
        rig.steps(20, H);
        return kinetic_energy(*rig.system, rig.motion.v);
    };
    EXPECT_NEAR(spin_after(0.1), spin_after(0), 1e-3 * spin_after(0));

    const auto shake_after = [&](double damping) {
        Rig rig(box_model(1, 4, 1, {0.1, 0.4, 0.1}, {900, 1e5, 0.3}), settings(), mass());
        rig.settings.stiffness_damping = damping;
        rig.pin_below(1, 0);
        for (int i = 0; i < rig.node_count(); ++i) point(rig.motion.v, i).x() = 0.1 * point(rig.motion.x, i).y();
        rig.steps(20, H);
        return kinetic_energy(*rig.system, rig.motion.v) + rig.elastic_energy();
    };
    EXPECT_LT(shake_after(0.1), 0.5 * shake_after(0));
}

TEST_P(EveryStep, GivesTheSameBitsAgain) {
    const auto run = [&] {
        Rig rig(tree_model(5, 4, 3, {900, 1e7, 0.3}), settings(), mass());
        rig.settings.newton_iterations = 3;
        rig.settings.stiffness_damping = 0.002;
        rig.settings.tolerance = 1e-8;
        rig.pin_below(1, 0);
        rig.loads.gravity = {3, -9.81, 1};
        rig.loads.springs.push_back(tet_spring(*rig.system, 7, {0.1, 0.2, 0.3, 0.4}, {0.5, 0.5, 0.5}, 20));
        for (int n = 0; n < 10; ++n) rig.step(H);
        return rig.motion;
    };
    const Motion once = run(), again = run();
    EXPECT_EQ(std::memcmp(once.x.data(), again.x.data(), sizeof(double) * size_t(once.x.size())), 0);
    EXPECT_EQ(std::memcmp(once.v.data(), again.v.data(), sizeof(double) * size_t(once.v.size())), 0);
}

struct EveryEulerStep : EveryStep {};
static std::vector<Combination> euler_combinations() {
    std::vector<Combination> all = every_combination();
    all.erase(std::remove_if(all.begin(), all.end(),
                             [](const auto& c) { return c.integrator != FROND_INTEGRATOR_IMPLICIT_EULER; }),
              all.end());
    return all;
}
INSTANTIATE_TEST_SUITE_P(Step, EveryEulerStep, testing::ValuesIn(euler_combinations()), combination_name);

TEST_P(EveryEulerStep, TakesNoForceForForcesOfZero) {
    const Model box = box_model(1, 2, 1, {0.1, 0.2, 0.1}, {900, 1e4, 0.3});
    Rig with(box, settings(), mass()), without(box, settings(), mass());
    without.loads.force.resize(0);
    for (Rig* rig : {&with, &without}) {
        rig->loads.gravity = {0, -9.81, 0};
        ASSERT_TRUE(rig->step(H).ok && rig->step(H).ok);
    }
    EXPECT_EQ(with.motion.x, without.motion.x);
    EXPECT_EQ(with.motion.v, without.motion.v);
}

// The equation itself, assembled from dense parts: (M + h D + h^2 K) dv = h (f - D v - h K v).
TEST_P(EveryEulerStep, SolvesTheEquationOfThePaperWithItsSignsRight) {
    Rig rig(box_model(1, 2, 1, {0.1, 0.2, 0.1}, {900, 1e4, 0.3}), settings(), mass());
    rig.settings.mass_damping = 0.7;
    rig.settings.stiffness_damping = 0.01;
    Dice dice(2);
    rig.motion.x += dice.vector(rig.motion.x.size(), 0.01);
    rig.motion.v = dice.vector(rig.motion.x.size(), 1);
    rig.loads.force = dice.vector(rig.motion.x.size(), 0.1);
    const Motion before = rig.motion;
    ASSERT_TRUE(rig.step(H).ok);

    // K v and f from the mechanics, M from kinetic energy: 1/2 (a+b) M (a+b) - 1/2 (a-b) M (a-b) = 2 a M b.
    const Elements& elements = elements_of(*rig.system);
    const Mechanics& body = rig.row();
    BlockMatrix K;
    K.set_pattern(elements.pattern);
    K.set_zero();
    body.add_stiffness(elements, before.x, Tangent::positive, 1, K);
    VecX f = rig.loads.force;
    body.add_force(elements, before.x, f);
    const auto mass_times = [&](const VecX& a, const VecX& b) {
        return 0.5 * (kinetic_energy(*rig.system, a + b) - kinetic_energy(*rig.system, a - b));
    };
    const VecX dv = rig.motion.v - before.v, v = before.v;
    VecX Kdv, Kv;
    K.multiply(dv, Kdv);
    K.multiply(v, Kv);
    const double a = 0.7, b = 0.01;
    for (int trial = 0; trial < 10; ++trial) {
        const VecX w = dice.vector(dv.size(), 1);
        const double left = (1 + H * a) * mass_times(w, dv) + (H * b + H * H) * w.dot(Kdv);
        const double right = H * (w.dot(f) - a * mass_times(w, v) - (b + H) * w.dot(Kv));
        EXPECT_NEAR(left, right, 1e-8 * std::abs(w.dot(f)) * H + 1e-9);
    }
    EXPECT_NEAR((rig.motion.x - before.x - H * rig.motion.v).norm(), 0, 1e-14);
}

struct EveryOrder : testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Mass, EveryOrder, testing::Range(1, HIGHEST_ORDER + 1));

TEST_P(EveryOrder, MassIsTheSameLumpedAndConsistentInSum) {
    const Model model = tree_model(4, 3, 2, {750, 1e6, 0.3});
    RigSettings settings = plain_settings();
    settings.order = GetParam();
    const Rig lumped(model, settings), consistent(model, settings, FROND_MASS_CONSISTENT);
    double volume = 0;
    for (double v : tets_of(*lumped.system).volume) volume += v;
    EXPECT_NEAR(lumped.mass(), 750 * volume, 1e-12 * lumped.mass());
    VecX v(lumped.motion.v.size());
    for (int i = 0; i < lumped.node_count(); ++i) point(v, i) = Vec3(1, 2, 3);
    EXPECT_NEAR(kinetic_energy(*lumped.system, v), 7 * lumped.mass(), 1e-12 * lumped.mass());
    EXPECT_NEAR(kinetic_energy(*consistent.system, v), 7 * lumped.mass(), 1e-12 * lumped.mass());
    // A varying field has less kinetic energy with the consistent mass matrix.
    Dice dice(3);
    const VecX wild = dice.vector(v.size(), 1);
    EXPECT_LT(kinetic_energy(*consistent.system, wild), kinetic_energy(*lumped.system, wild));
}

// Contacts follow on such steps, so their forces are not where velocities lead: what spins was inflated by them, and
// the more the stronger its damping.
TEST(Step, StrainsNothingThatSpinsFreelyAmidContacts) {
    for (const double damping : {0.0, 0.01})
        for (const double rate : {1.0, 4.0, 10.0})
            for (const double h : {1.0 / 240, 1.0 / 60}) {
                Rig rig(box_model(2, 8, 2, {0.05, 0.6, 0.05}, {900, 1e8, 0.3}), plain_settings());
                rig.settings.integrator = FROND_INTEGRATOR_BDF2;
                rig.settings.is_touched = true;
                rig.settings.stiffness_damping = damping;
                for (int i = 0; i < rig.node_count(); ++i)
                    point(rig.motion.v, i) = Vec3(0, 0, rate).cross(Vec3(point(rig.motion.x, i)));
                const double before = kinetic_energy(*rig.system, rig.motion.v);
                for (int step = 0; step < 30; ++step) {
                    rig.motion.history.valid = false;
                    rig.motion.history.shaken = true;
                    ASSERT_TRUE(rig.step(h).ok);
                }
                const double after = kinetic_energy(*rig.system, rig.motion.v);
                EXPECT_LT(rig.elastic_energy(), 1e-3 * before) << damping << " " << rate << " " << h;
                EXPECT_NEAR(after, before, 0.3 * before) << damping << " " << rate << " " << h;
            }
}

TEST(Step, ReportsWhatItCost) {
    constexpr double H = 1.0 / 60;
    Rig rig(tree_model(10, 6, 4, {900, 1e8, 0.3}), plain_settings());
    rig.pin_below(1, 0);
    rig.loads.gravity = {0, -9.81, 0};
    const SolveReport report = rig.step(H);
    EXPECT_TRUE(report.ok && report.converged);
    EXPECT_EQ(report.iterations, 1);
    EXPECT_EQ(report.inverted, 0);
    EXPECT_GT(report.ms_assembly, 0);
    EXPECT_GT(report.ms_solve, 0);
    EXPECT_LT(report.residual, 1e-8);
}

}  // namespace step_tests

}  // namespace frond::test
