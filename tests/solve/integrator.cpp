// Integrators: their order of convergence, the damping of a mode, and when they must discard their history.
#include "solve/integrator.hpp"

#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "support/rig.hpp"

namespace frond::test {
namespace integrator_tests {

struct EveryIntegrator : testing::TestWithParam<int> {
    const frond_integrator which = frond_integrator(GetParam());
    const Integrator& row = integrator(which);
    int order() const {
        return which == FROND_INTEGRATOR_IMPLICIT_EULER || which == FROND_INTEGRATOR_SYMPLECTIC_EULER ? 1 : 2;
    }
};
std::string integrator_name(const testing::TestParamInfo<int>& info) {
    return integrator(frond_integrator(info.param)).name;
}
INSTANTIATE_TEST_SUITE_P(Integrators, EveryIntegrator, testing::Range(0, int(FROND_INTEGRATOR_COUNT)), integrator_name);

// ---- order ----------------------------------------------------------------------------------------------------

// Returns the positions after 0.2 s of a soft beam that swings through a wide arc under gravity.
VecX swing(frond_mechanics mechanics, frond_integrator which, int steps, int newton, double damping, bool uneven) {
    Rig rig(box_model(1, 4, 1, {0.1, 0.4, 0.1}, {900, 1e5, 0.3}), plain_settings(mechanics));
    rig.settings.integrator = which;
    rig.settings.newton_iterations = newton;
    rig.settings.newton_tolerance = 1e-10;
    rig.settings.stiffness_damping = damping;
    rig.pin_below(1, 0);
    rig.loads.gravity = {9.81, 0, 0};
    for (int i = 0; i < rig.node_count(); ++i) point(rig.motion.v, i).x() = 3 * point(rig.motion.x, i).y();
    for (int n = 0; n < steps; ++n) EXPECT_TRUE(rig.step(0.2 / steps * (uneven ? (n % 2 ? 0.8 : 1.2) : 1)).ok);
    return rig.motion.x;
}

TEST_P(EveryIntegrator, ConvergesWithItsOrderOnASwingingBeam) {
    for (frond_mechanics mechanics : {FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_TET_NEOHOOKEAN}) {
        const VecX exact = swing(mechanics, FROND_INTEGRATOR_TR_BDF2, 1500, 20, 0.01, false);
        for (int newton : {1, 20}) {
            const int coarse = row.is_explicit ? 1000 : 100;
            const double first = (swing(mechanics, which, coarse, newton, 0.01, false) - exact).norm();
            const double second = (swing(mechanics, which, 2 * coarse, newton, 0.01, false) - exact).norm();
            EXPECT_NEAR(std::log2(first / second), order(), 0.3) << first << " " << second << " newton " << newton;
            EXPECT_LT(second, order() == 1 ? 3e-2 : 2e-3);
        }
    }
}

TEST(Bdf2, ConvergesWithItsOrderInUnevenSteps) {
    const VecX exact = swing(FROND_MECHANICS_TET_COROTATIONAL, FROND_INTEGRATOR_TR_BDF2, 4000, 20, 0, false);
    const double first =
        (swing(FROND_MECHANICS_TET_COROTATIONAL, FROND_INTEGRATOR_BDF2, 400, 20, 0, true) - exact).norm();
    const double second =
        (swing(FROND_MECHANICS_TET_COROTATIONAL, FROND_INTEGRATOR_BDF2, 800, 20, 0, true) - exact).norm();
    EXPECT_GT(std::log2(first / second), 1.7) << first << " " << second;
}

// ---- kept amplitude of a mode ---------------------------------------------------------------------------------

// A single mode of a small linear beam; time is scaled so that its phase advances by z in each step.
struct Mode {
    Rig rig;
    VecX shape;
    Eigen::MatrixXd M;
    double omega = 0;
    Mode(int number, frond_integrator which, frond_mass mass = FROND_MASS_LUMPED)
        : rig(box_model(1, 1, 6, {0.1, 0.1, 0.6}, {1000, 1e5, 0.3}), plain_settings(FROND_MECHANICS_TET_LINEAR), mass) {
        rig.settings.integrator = which;
        rig.pin_below(2, 0);

        // Dense mass and stiffness of the free nodes, which come last.
        const Eigen::Index n = rig.motion.x.size(), free = n - 12;
        BlockMatrix K;
        K.set_pattern(elements_of(*rig.system).pattern);
        K.set_zero();
        mechanics(FROND_MECHANICS_TET_LINEAR)
            .add_stiffness(elements_of(*rig.system), rig.motion.x, Tangent::exact, 1, K);
        M.resize(n, n);
        for (Eigen::Index i = 0; i < n; ++i)
            for (Eigen::Index j = 0; j < n; ++j)
                M(i, j) = 0.5 * (kinetic_energy(*rig.system, VecX::Unit(n, i) + VecX::Unit(n, j)) -
                                 kinetic_energy(*rig.system, VecX::Unit(n, i) - VecX::Unit(n, j)));
        const Modes modes = modes_of(dense(K).bottomRightCorner(free, free), M.bottomRightCorner(free, free));
        const Eigen::Index index = number < 0 ? free + number : number;
        shape = VecX::Zero(n);
        shape.tail(free) = modes.shapes.col(index);
        omega = std::sqrt(modes.values[index]);
    }
    double place() const { return shape.dot(M * (rig.motion.x - positions_of(*rig.model))); }
    double speed() const { return shape.dot(M * rig.motion.v) / omega; }
    double amplitude() const { return std::hypot(place(), speed()); }
    // Returns the share of the amplitude that is left after `steps`.
    double kept(double z, int steps) {
        rig.motion.x += 1e-3 * shape;
        rig.steps(steps, z / omega);
        return amplitude() / 1e-3;
    }
};

constexpr double ONE_HERTZ = 2 * M_PI / 60;  // at 1/60 s [radian]

// Implicit Euler's amplitude decreases by 1 / sqrt(1 + z^2) per step, and its phase advances by atan z.
TEST(ImplicitEuler, DampsAOneHertzModeAsItsClosedFormSays) {
    for (int mass = 0; mass < FROND_MASS_COUNT; ++mass) {
        Mode mode(0, FROND_INTEGRATOR_IMPLICIT_EULER, frond_mass(mass));
        const double z = ONE_HERTZ;
        mode.rig.motion.x += 1e-3 * mode.shape;
        const int steps = 60;
        for (int step = 1; step <= steps; ++step) {
            ASSERT_TRUE(mode.rig.step(z / mode.omega).ok);
            const double amplitude = 1e-3 * std::pow(1 + z * z, -0.5 * step), angle = step * std::atan(z);
            ASSERT_NEAR(mode.place(), amplitude * std::cos(angle), 1e-9);
            ASSERT_NEAR(mode.speed(), -amplitude * std::sin(angle), 1e-9);
        }
        // The corresponding damping ratio, from the last state: 5 % at 1 Hz.
        const double zeta = -std::log(mode.amplitude() / 1e-3) / (steps * std::atan(z));
        EXPECT_NEAR(zeta, std::log(1 + z * z) / (2 * std::atan(z)), 1e-6);
        EXPECT_NEAR(zeta, 0.05, 0.005);
    }
}

TEST_P(EveryIntegrator, KeepsTheAmplitudeOfAOneHertzModeForFiveSeconds) {
    if (row.is_explicit) GTEST_SKIP() << "the beam's other modes are unstable at this step";
    const double kept = Mode(0, which).kept(ONE_HERTZ, 300);
    RecordProperty("kept", std::to_string(kept));
    if (which == FROND_INTEGRATOR_IMPLICIT_EULER) {
        EXPECT_NEAR(kept, std::pow(1 + ONE_HERTZ * ONE_HERTZ, -150), 1e-6);
        EXPECT_NEAR(kept, 0.2, 0.01);
    } else {
        EXPECT_GT(kept, which == FROND_INTEGRATOR_BDF2 ? 0.95 : 0.99);
        EXPECT_LT(kept, 1.001);
    }
}

TEST(GeneralizedAlpha, DampsTheHighestFrequenciesAsItsSpectralRadiusSays) {
    for (double radius : {0.0, 0.5, 0.8, 1.0}) {
        Mode mode(-1, FROND_INTEGRATOR_GENERALIZED_ALPHA);
        mode.rig.settings.spectral_radius = radius;
        mode.rig.motion.x += 1e-3 * mode.shape;
        // The method's own first step damps this mode away, so the mode restarts at rest with the rates of the method.
        mode.rig.steps(1, 1e4 / mode.omega);
        History& history = mode.rig.motion.history;
        ASSERT_TRUE(history.valid);
        mode.rig.motion.x = positions_of(*mode.rig.model) + 1e-3 * mode.shape;
        mode.rig.motion.v.setZero();
        history.x_rate.setZero();
        history.v_rate = -1e-3 * mode.omega * mode.omega * mode.shape;
        history.x_end = mode.rig.motion.x;
        history.v_end = mode.rig.motion.v;
        mode.rig.steps(20, 1e4 / mode.omega);
        const double before = std::abs(mode.place());
        mode.rig.steps(1, 1e4 / mode.omega);
        if (radius > 0.4) {
            EXPECT_NEAR(std::abs(mode.place()) / before, radius, 0.08);
        } else {
            EXPECT_LT(std::abs(mode.place()), 1e-6);
        }
    }
}

// ---- far bends ----------------------------------------------------------------------------------------------------

TEST_P(EveryIntegrator, StaysStableWhenLetGoFromALargeBend) {
    if (row.is_explicit) GTEST_SKIP() << "see the test below";
    for (int mechanics = 0; mechanics < TET_MECHANICS; ++mechanics) {
        Rig rig(box_model(1, 20, 1, {0.05, 1, 0.05}, {1000, 3e6, 0.3}), plain_settings(frond_mechanics(mechanics)));
        rig.pin_below(1, 0);
        const int end = rig.node_count() - 1;
        const double rest = point(rig.motion.x, end).x();

        // Pulled aside until it rests, then let go without any damping.
        rig.settings.newton_iterations = 20;
        point(rig.loads.force, end).x() = 6;
        rig.steps(100, 1.0);
        rig.loads.force.setZero();
        rig.motion.v.setZero();
        rig.settings.integrator = which;
        rig.settings.newton_iterations = 1;
        const double bent = point(rig.motion.x, end).x() - rest, before = rig.elastic_energy();
        if (mechanics != FROND_MECHANICS_TET_LINEAR) {
            EXPECT_GT(bent, 0.35);
        }
        double farthest = 0, energy = 0;
        for (int n = 0; n < 300; ++n) {
            ASSERT_TRUE(rig.step(1.0 / 60).ok);
            energy = rig.elastic_energy() + kinetic_energy(*rig.system, rig.motion.v);
            ASSERT_LT(energy, 1.05 * before) << n;
            if (n >= 240) farthest = std::max(farthest, std::abs(point(rig.motion.x, end).x() - rest));
        }
        const double kept = std::sqrt(energy / before);
        RecordProperty(std::string("kept_") + frond::mechanics(frond_mechanics(mechanics)).name, std::to_string(kept));
        EXPECT_GT(kept, which == FROND_INTEGRATOR_IMPLICIT_EULER ? 0.01 : 0.95) << mechanics;
        EXPECT_GT(farthest, which == FROND_INTEGRATOR_IMPLICIT_EULER ? 0.0 : 0.8 * bent) << mechanics;
    }
}

TEST(SymplecticEuler, KeepsEnergyInTinyStepsAndBlowsUpInLargeOnes) {
    for (double h : {2e-5, 1.0 / 60}) {
        Rig rig(box_model(1, 4, 1, {0.1, 0.4, 0.1}, {900, 1e6, 0.3}), plain_settings());
        rig.settings.integrator = FROND_INTEGRATOR_SYMPLECTIC_EULER;
        rig.pin_below(1, 0);
        for (int i = 0; i < rig.node_count(); ++i) point(rig.motion.v, i).x() = point(rig.motion.x, i).y();
        const double before = kinetic_energy(*rig.system, rig.motion.v);
        for (int n = 0; n < 2000 && rig.step(h).ok; ++n) {
        }
        const double now = kinetic_energy(*rig.system, rig.motion.v) + rig.elastic_energy();
        if (h < 1e-4) {
            EXPECT_NEAR(now, before, 0.01 * before);
        } else {
            EXPECT_FALSE(now < 1e3 * before);
        }
    }
}

// ---- history ------------------------------------------------------------------------------------------------------

Rig swinging(frond_integrator which) {
    Rig rig(box_model(1, 4, 1, {0.1, 0.4, 0.1}, {900, 1e5, 0.3}), plain_settings());
    rig.settings.integrator = which;
    rig.pin_below(1, 0);
    rig.loads.gravity = {9.81, 0, 0};
    rig.steps(5, 1.0 / 60);
    return rig;
}

TEST_P(EveryIntegrator, StartsAnewWhereSomethingElseMovedThePlant) {
    const double h = 1.0 / 60;
    using Change = void (*)(Rig&);
    const Change changes[] = {[](Rig& rig) { rig.motion.x[20] += 1e-9; }, [](Rig& rig) { rig.motion.v[25] -= 0.3; },
                              [](Rig& rig) { rig.motion.history.valid = false; }};
    for (const Change& change : changes) {
        Rig rig = swinging(which), fresh = swinging(which);
        EXPECT_EQ(rig.motion.history.valid, row.looks_back);
        change(rig);
        change(fresh);
        fresh.motion.history = {};
        rig.step(h);
        fresh.step(h);
        EXPECT_EQ(rig.motion.x, fresh.motion.x);
        EXPECT_EQ(rig.motion.v, fresh.motion.v);
    }
}

TEST_P(EveryIntegrator, GoesOnWithItsPastInACopyOfTheMotion) {
    const double h = 1.0 / 60;
    Rig rig = swinging(which), twin = swinging(which), without = swinging(which);
    twin.motion = rig.motion;
    without.motion.history = {};
    for (Rig* r : {&rig, &twin, &without}) r->step(h);
    EXPECT_EQ(rig.motion.x, twin.motion.x);
    EXPECT_EQ(rig.motion.x != without.motion.x, row.looks_back);
}

TEST(Bdf2, StartsAnewAfterAJumpOfTheTimeStepAndAfterAnotherIntegrator) {
    for (double h : {0.9 / 8 / 60, 2.1 / 60}) {
        Rig bdf2 = swinging(FROND_INTEGRATOR_BDF2), sdirk2 = swinging(FROND_INTEGRATOR_BDF2);
        sdirk2.settings.integrator = FROND_INTEGRATOR_SDIRK2;
        bdf2.step(h);
        sdirk2.step(h);
        EXPECT_EQ(bdf2.motion.x, sdirk2.motion.x);
    }
    Rig rig = swinging(FROND_INTEGRATOR_BDF2), fresh = swinging(FROND_INTEGRATOR_BDF2);
    for (Rig* r : {&rig, &fresh}) {
        r->settings.integrator = FROND_INTEGRATOR_SDIRK2;
        r->step(1.0 / 60);
        r->settings.integrator = FROND_INTEGRATOR_BDF2;
    }
    fresh.motion.history = {};
    rig.step(1.0 / 60);
    fresh.step(1.0 / 60);
    EXPECT_EQ(rig.motion.x, fresh.motion.x);
}

// A single first step keeps the amplitude; if something disturbs every step, the next ones damp, as implicit Euler that
// is solved to balance, and cost one solve.
TEST(Bdf2, StartsWithoutDampingButOnce) {
    Rig bdf2 = swinging(FROND_INTEGRATOR_BDF2), euler = swinging(FROND_INTEGRATOR_BDF2);
    euler.settings.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    euler.settings.newton_iterations = 20;
    for (int step = 0; step < 3; ++step) {
        bdf2.motion.v *= 0.99;
        const VecX start = euler.motion.x = bdf2.motion.x;
        euler.motion.v = bdf2.motion.v;
        EXPECT_EQ(bdf2.step(1.0 / 60).iterations, step == 0 ? 2 : 1);
        euler.step(1.0 / 60);
        const double off = (bdf2.motion.x - euler.motion.x).norm();
        const bool is_damped = off < 0.01 * (euler.motion.x - start).norm();
        EXPECT_EQ(is_damped, step > 0);
    }
    EXPECT_EQ(bdf2.step(1.0 / 60).iterations, 1);  // continues with its history
    bdf2.motion.v *= 0.99;
    EXPECT_EQ(bdf2.step(1.0 / 60).iterations, 2);
}

TEST(Bdf2, StartsAsFreelyAsSdirk2FromABentShapeAtRest) {
    // The amplitude that the first step removes from a 1 Hz mode; implicit Euler removes z^2 / 2 of it.
    Mode mode(0, FROND_INTEGRATOR_BDF2), euler(0, FROND_INTEGRATOR_IMPLICIT_EULER);
    EXPECT_LT(1 - mode.kept(ONE_HERTZ, 1), 1e-4);
    EXPECT_NEAR(1 - euler.kept(ONE_HERTZ, 1), ONE_HERTZ * ONE_HERTZ / 2, 1e-4);
}

TEST_P(EveryIntegrator, AStepThatFailsLeavesThePastOfTheNextOneUnused) {
    if (row.is_explicit) GTEST_SKIP() << "takes any force";
    Rig rig = swinging(which), twin = swinging(which);
    rig.loads.force.setConstant(1e300);
    EXPECT_FALSE(rig.step(1.0 / 60).ok);
    rig.loads.force.setZero();
    rig.step(1.0 / 60);
    twin.step(1.0 / 60);
    EXPECT_EQ(rig.motion.x, twin.motion.x);
}

}  // namespace integrator_tests

}  // namespace frond::test
