// Chain nodes on hinges, ball joints and forks, against the formulas of statics and dynamics.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "support/supported.hpp"

namespace frond::test {
namespace supports_tests {

constexpr double PI = 3.14159265358979323846, G = 9.81, LENGTH = 1;

frond_plant_def damped(double mass_damping, bool has_weight = false) {
    frond_plant_def def = Supported::bare();
    def.mass_damping = mass_damping;
    if (has_weight) def.effects |= FROND_EFFECT_GRAVITY;
    return def;
}
frond_plant_def free_to_swing(frond_integrator integrator = FROND_INTEGRATOR_BDF2) {
    frond_plant_def def = damped(0, true);
    def.integrator = integrator;
    return def;
}

// Its deflections are a tenth of the section's radius of gyration, so that tension between its ends, which do not
// move, bears a 400th of its load.
struct Beam : Supported {
    explicit Beam(const frond_plant_def& def, double young) : Supported({LENGTH, 0, 0}, young, def) {
        support(0, FROND_HELD_TURNS_ACROSS_AXIS);
        support(tip, FROND_HELD_TURNS_ACROSS_AXIS);
    }
    double bending() const { return organ.bending_thin.lower; }
};

TEST(Supports, ABeamOnTwoHingesBendsUnderItsMiddleLoadByFL3Over48EI) {
    Beam beam(damped(40), 1e9);
    const double force = 48 * beam.bending() / std::pow(LENGTH, 3) * 0.05 * STEM_RADIUS;
    beam.under(beam.tip / 2, {0, -force, 0}, 600);
    EXPECT_NEAR(beam.state(beam.tip / 2).position.y / (-0.05 * STEM_RADIUS), 1, 0.01);
    for (const int end : {0, beam.tip}) {
        frond_vec3 held = {}, moment = {};
        must(frond_plant_get_support_force(beam.plant, end, &held, &moment));
        EXPECT_NEAR(held.y / force, 0.5, 0.005);
        EXPECT_NEAR(std::abs(turn_about(beam.state(end).rotation, {0, 0, 1})) / (3 * 0.05 * STEM_RADIUS), 1, 0.02);
        EXPECT_NEAR(moment.x, 0, 1e-6 * force);
        EXPECT_NEAR(moment.z, 0, 1e-12);
    }
}

TEST(Supports, ABeamOnTwoHingesBendsUnderItsWeightBy5QL4Over384EI) {
    Beam beam(damped(40, true), 2e10);
    const double q = beam.mass * G / LENGTH, w = 5 * q * std::pow(LENGTH, 4) / (384 * beam.bending());
    ASSERT_LT(w, 0.06 * STEM_RADIUS);
    beam.steps(600);
    EXPECT_NEAR(beam.state(beam.tip / 2).position.y / -w, 1, 0.01);
    frond_vec3 all = {};
    must(frond_plant_get_support_force(beam.plant, 0, &all, nullptr));
    EXPECT_NEAR(all.y / (beam.mass * G), 0.5 - 0.5 / beam.tip / 2, 0.03);
}

TEST(Supports, AHingeAlongABeamBearsItsWeightAsAClampDoes) {
    Supported beam({LENGTH, 0, 0}, 1e10, damped(40, true));
    beam.support(0, FROND_HELD_TURNS_ACROSS_AXIS, {-2, 0, 0});
    beam.steps(600);
    const double q = beam.mass * G / LENGTH, w = q * std::pow(LENGTH, 4) / (8 * beam.organ.bending_thin.lower);
    EXPECT_NEAR(beam.state(beam.tip).position.y / -w, 1, 0.01);
    frond_vec3 force = {}, moment = {};
    must(frond_plant_get_support_force(beam.plant, 0, &force, &moment));
    EXPECT_NEAR(moment.z / (beam.mass * G * LENGTH / 2), 1, 0.005);
    EXPECT_NEAR(moment.x, 0, 1e-9);
    EXPECT_NEAR(force.y / (beam.mass * G), 1, 0.03);  // the first half segment's weight is the node's own
}

TEST(Supports, ABeamWithATurnHeldAndItsPlaceFreeSlides) {
    Supported beam({LENGTH, 0, 0}, 1e9, damped(0));
    beam.support(0, FROND_HELD_TURNS_ALL, {0, 0, 1}, false);
    beam.under(0, {0.1, 0, 0}, 60);
    EXPECT_NEAR(beam.state(0).position.x / (0.5 * 0.1 / beam.mass), 1, 0.05);
    EXPECT_NEAR(turn_about(beam.state(0).rotation, {0, 0, 1}), 0, 1e-12);
}

// The period of a physical pendulum with amplitude a is 2 pi sqrt(2 L / 3 g) (1 + a^2 / 16).
TEST(Supports, AStemOnAHingeSwingsAsAPhysicalPendulumInItsPlane) {
    constexpr double AMPLITUDE = 0.1;
    const frond_vec3 axis = {0.6, 0, 0.8}, side = {0.8, 0, -0.6};
    Supported stem({side.x * std::sin(AMPLITUDE), -std::cos(AMPLITUDE), side.z * std::sin(AMPLITUDE)}, 1e9,
                   free_to_swing());
    stem.support(0, FROND_HELD_TURNS_ACROSS_AXIS, axis);
    stem.h = 1.0 / 240;
    double before = 0, first = 0, last = 0;
    int passes = 0;
    for (int i = 1; i <= 240 * 10; i++) {
        stem.steps(1);
        const frond_vec3 p = stem.state(stem.tip).position;
        const double out = p.x * side.x + p.z * side.z;
        EXPECT_NEAR(p.x * axis.x + p.z * axis.z, 0, 1e-9);
        if (before > 0 && out <= 0) {
            last = (i - out / (out - before)) * stem.h;
            if (passes++ == 0) first = last;
        }
        before = out;
    }
    ASSERT_GT(passes, 3);
    const double period = 2 * PI * std::sqrt(2 * LENGTH / (3 * G)) * (1 + AMPLITUDE * AMPLITUDE / 16);
    EXPECT_NEAR((last - first) / (passes - 1) / period, 1, 0.01);
}

// A node that was turned when the hinge was made has rotation vectors on a curve.
TEST(Supports, AHingeMadeOnATurnedStemHoldsItInItsPlane) {
    for (const frond_integrator integrator : {FROND_INTEGRATOR_BDF2, FROND_INTEGRATOR_GENERALIZED_ALPHA}) {
        Supported stem({0, 0, LENGTH}, 1e8, free_to_swing(integrator));
        std::vector<frond_chain_state> states = stem.state();
        for (frond_chain_state& state : states) {
            // By 120 degrees about (1, 1, 1), which takes z to x.
            state.rotation = {0.5, 0.5, 0.5, 0.5};
            state.position = {state.position.z, 0, 0};
        }
        must(frond_plant_set_chain_state(stem.plant, states.data(), stem.tip + 1));
        stem.support(0, FROND_HELD_TURNS_ACROSS_AXIS, {0, 0, 1});
        double lowest = 0;
        for (int i = 0; i < 180; i++) {
            stem.steps(1);
            const frond_chain_state end = stem.state(stem.tip), root = stem.state(0);
            lowest = std::min(lowest, end.position.y);
            EXPECT_NEAR(end.position.z, 0, 1e-3 * LENGTH) << i;  // as far as that of a clamped one
            // The image of the node's own y is the axis.
            const frond_quat& q = root.rotation;
            EXPECT_NEAR(2 * (q.y * q.z + q.w * q.x), 1, 1e-9) << i;
            EXPECT_NEAR(std::hypot(root.position.x, root.position.y, root.position.z), 0, 1e-15);
        }
        EXPECT_LT(lowest, -0.95 * LENGTH);
    }
}

TEST(Supports, AStemOnABallJointFallsOverAndHangsAndNeverGainsEnergy) {
    Supported stem({0.05, LENGTH, 0.02}, 1e8, damped(1, true));
    stem.support(0, FROND_HELD_TURNS_NONE);
    frond_energy_ledger before = stem.ledger();
    const double lift = stem.mass * G * LENGTH;
    for (int i = 0; i < 900; i++) {
        stem.steps(1);
        const frond_energy_ledger now = stem.ledger();
        EXPECT_GT(now.dissipated - before.dissipated, -(now.error - before.error) - 1e-5 * lift) << i;
        before = now;
    }
    EXPECT_NEAR(before.pins, 0, 1e-12);
    EXPECT_NEAR(before.dissipated / lift, 1, 0.02);
    const frond_chain_state end = stem.state(stem.tip);
    EXPECT_NEAR(end.position.y / LENGTH, -1, 0.02);
}

// By one solve with forces of the step's start it gained several times what it has.
TEST(Supports, AStemThatFallsAsideInAForkNeverGainsEnergyByImplicitEuler) {
    for (const double h : {1.0 / 60, 1.0 / 240}) {
        Supported stem({-0.04, LENGTH, 0}, 1e8, free_to_swing(FROND_INTEGRATOR_IMPLICIT_EULER));
        stem.support(0, FROND_HELD_TURNS_ABOUT_AXIS, {0, -0.9, -0.6});
        stem.h = h;
        const double lift = stem.mass * G * LENGTH;
        double most = 0, gained = 0, swing = 0;
        stem.ledger();
        for (int i = 0; i * h < 3; i++) {
            stem.steps(1);
            const frond_energy_ledger now = stem.ledger();
            most = std::max(most, now.dissipated);
            gained = std::max(gained, most - now.dissipated);
            swing = std::max(swing, now.now.kinetic);
        }
        EXPECT_LT(gained, 1e-3 * lift) << h;
        EXPECT_GT(swing, 0.02 * lift) << h;
    }
}

// A narrow beam on forks under a load in its middle tilts at 16.94 sqrt(EI GJ) / L^2 (Timoshenko and Gere 1961, 6.3).
struct NarrowBeam : Supported {
    NarrowBeam() : Supported({LENGTH, 0, 0}, 1e11, damped(4), 20, {0.1, 0.001}) {
        support(0, FROND_HELD_TURNS_ABOUT_AXIS, {1, 0, 0});
        support(tip, FROND_HELD_TURNS_ABOUT_AXIS, {1, 0, 0});
        h = 1.0 / 240;
    }
    // Returns how far aside its middle stays, over its thickness, under a share of that load after a push.
    double stays_aside(double share) {
        const double critical = 16.94 * std::sqrt(organ.bending_thin.lower * organ.torsion.lower) / (LENGTH * LENGTH);
        under(tip / 2, {0, -share * critical, 1e-4 * critical}, 24);
        under(tip / 2, {0, -share * critical, 0}, 1200);
        for (const int end : {0, tip}) EXPECT_NEAR(turn_about(state(end).rotation, {1, 0, 0}), 0, 1e-9);
        return std::abs(state(tip / 2).position.z) / 0.001;
    }
};

TEST(Supports, ANarrowBeamOnForksTiltsAtItsBucklingLoad) {
    NarrowBeam below, above;
    EXPECT_LT(below.stays_aside(0.97), 1e-3);
    EXPECT_GT(above.stays_aside(1.03), 0.1);
}

struct Way {
    frond_integrator integrator;
    double h;  // [s]
};
std::vector<Way> every_way() {
    std::vector<Way> all;
    for (int i = 0; i < FROND_INTEGRATOR_SYMPLECTIC_EULER; i++)
        for (const double h : {1.0 / 30, 1.0 / 60, 1.0 / 240}) all.push_back({frond_integrator(i), h});
    return all;
}
struct EverySupport : testing::TestWithParam<Way> {
    // Moves for three seconds; returns what it lost, over what lifts it. In a step it may gain what the guard allows:
    // in one of 1/30 s a fall turns a stem by 0.2 rad, held or not.
    static double loss(
        Supported& stem, double h, const std::function<void()>& load = [] {}) {
        constexpr double MOST_GIVEN = 0.015;
        stem.h = h;
        const double lift = stem.mass * G * LENGTH;
        frond_energy_ledger before = stem.ledger();
        for (int i = 0; i * h < 3; i++) {
            load();
            stem.steps(1);
            const frond_energy_ledger now = stem.ledger();
            EXPECT_GT(now.dissipated, before.dissipated - (now.error - before.error) - MOST_GIVEN * lift) << i;
            before = now;
        }
        EXPECT_EQ(stem.report().trouble & FROND_TROUBLE_REWOUND, 0u);
        return before.dissipated / lift;
    }
};
INSTANTIATE_TEST_SUITE_P(EveryWay, EverySupport, testing::ValuesIn(every_way()), [](const auto& info) {
    return std::string(frond_integrator_name(info.param.integrator)) + "_" +
           std::to_string(int(std::lround(1 / info.param.h)));
});

TEST_P(EverySupport, HoldsAStemThatSwingsFarAndGivesNoEnergy) {
    for (const frond_held_turns turns :
         {FROND_HELD_TURNS_NONE, FROND_HELD_TURNS_ABOUT_AXIS, FROND_HELD_TURNS_ACROSS_AXIS, FROND_HELD_TURNS_ALL}) {
        const frond_vec3 along = {1, 0, 0}, level = {0, 0, 1}, up = {0, 1, 0};
        Supported stem({LENGTH, 0, 0}, 1e8, free_to_swing(GetParam().integrator));
        stem.support(0, turns, turns == FROND_HELD_TURNS_ABOUT_AXIS ? along : level);
        EXPECT_GT(loss(stem, GetParam().h), -1e-3) << turns;
        const frond_chain_state root = stem.state(0);
        EXPECT_NEAR(std::hypot(root.position.x, root.position.y, root.position.z), 0, 1e-15);
        if (turns == FROND_HELD_TURNS_NONE) continue;
        EXPECT_NEAR(turn_about(root.rotation, along), 0, 1e-9) << turns;
        if (turns == FROND_HELD_TURNS_ABOUT_AXIS) continue;
        EXPECT_NEAR(turn_about(root.rotation, up), 0, 1e-9) << turns;
        if (turns == FROND_HELD_TURNS_ALL) {
            EXPECT_NEAR(turn_about(root.rotation, level), 0, 1e-9);
        }
    }
}

// It is strained between its ends, which a solve's straight way does not foresee.
TEST_P(EverySupport, HoldsABeamAtBothEndsThatIsShakenAndGivesNoEnergy) {
    for (const frond_held_turns turns : {FROND_HELD_TURNS_ACROSS_AXIS, FROND_HELD_TURNS_ALL}) {
        Supported beam({LENGTH, 0, 0}, 1e8, free_to_swing(GetParam().integrator));
        beam.support(0, turns, {1, 0.2, 0.5});
        beam.support(beam.tip, turns, {1, 0, 1});
        const double load = 5 * beam.mass * G;
        double t = 0;
        EXPECT_GT(loss(beam, GetParam().h,
                       [&] {
                           t += beam.h;
                           if (std::fmod(t, 1) > 0.3) return;
                           const frond_vec3 force = {0, load * std::sin(7 * t), load * std::cos(5 * t)};
                           must(frond_plant_add_chain_load(beam.plant, beam.tip / 2, force, {0, 0, 0}));
                       }),
                  0);
        EXPECT_EQ(beam.state(beam.tip).position.x, LENGTH);
    }
}

TEST(Supports, HoldInExplicitStepsToo) {
    for (const frond_mass mass : {FROND_MASS_LUMPED, FROND_MASS_CONSISTENT}) {
        frond_plant_def def = free_to_swing(FROND_INTEGRATOR_SYMPLECTIC_EULER);
        def.tuning.mass = mass;
        Supported stem({LENGTH, 0, 0}, 1e6, def, 4);
        stem.support(0, FROND_HELD_TURNS_ACROSS_AXIS, {0, 0.6, 0.8});
        stem.h = 1e-5;
        stem.steps(20000);
        const frond_chain_state root = stem.state(0), end = stem.state(stem.tip);
        EXPECT_LT(end.position.y, -0.05);
        EXPECT_EQ(std::hypot(root.position.x, root.position.y, root.position.z), 0);
        EXPECT_NEAR(turn_about(root.rotation, {0, 0.8, -0.6}), 0, 1e-12);
        EXPECT_NEAR(turn_about(root.rotation, {1, 0, 0}), 0, 1e-12);
        EXPECT_LT(turn_about(root.rotation, {0, 0.6, 0.8}), -0.01);
    }
}

}  // namespace supports_tests
}  // namespace frond::test
