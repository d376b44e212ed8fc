// A sample of the table of what comes at plants: what goes through, and that the count of crossings can tell.
#include "stability/sweeps.hpp"

#include <gtest/gtest.h>

#include "stability/crossing.hpp"
#include "support/sanitized.hpp"

namespace frond::stability {
namespace {

std::string told(const Sweep& sweep) {
    return std::string(name_of(sweep.meeting)) + ", " + frond_mechanics_name(sweep.mechanics) + ", " +
           std::to_string(sweep.speed) + " m/s, " + std::to_string(sweep.dt) + " s";
}

void expect_none_passes(const std::vector<Meeting>& meetings, const std::vector<double>& speeds, double dt) {
    for (const Meeting meeting : meetings)
        for (const frond_mechanics mechanics : {FROND_MECHANICS_ROD, FROND_MECHANICS_TET_COROTATIONAL})
            for (const double speed : speeds) {
                if (SANITIZED && speed < 5) continue;
                const Sweep sweep = {meeting, mechanics, speed, dt};
                const Verdict verdict = run_sweep(sweep);
                EXPECT_EQ(verdict.color, Color::GREEN) << told(sweep) << ": " << verdict.text;
            }
}

TEST(Sweeps, PlantsPassThroughNoPlants) {
    expect_none_passes({Meeting::STEM, Meeting::ITSELF, Meeting::LEAF}, {0.5, 5, 20}, 1.0 / 60);
    expect_none_passes({Meeting::STEM, Meeting::ITSELF, Meeting::LEAF}, {1, 10}, 1.0 / 30);
}

TEST(Sweeps, BodiesPassThroughNoPlantsAtModerateSpeeds) {
    expect_none_passes({Meeting::WALL, Meeting::WIRE, Meeting::PLATE}, {0.2, 0.5}, 1.0 / 60);
    expect_none_passes({Meeting::WALL, Meeting::WIRE, Meeting::PLATE}, {2}, 1.0 / 60);
    expect_none_passes({Meeting::WALL, Meeting::WIRE, Meeting::PLATE}, {2}, 1.0 / 240);
    expect_none_passes({Meeting::BALL}, {0.5, 5, 50}, 1.0 / 60);
}

// A stem that swings back meets a ball where neither was foreseen, and Bullet looks before a ball moves.
TEST(Sweeps, BallsPassThroughNoStemsAtAnySpeed) {
    expect_none_passes({Meeting::BALL}, {10, 20, 100}, 1.0 / 60);
    expect_none_passes({Meeting::BALL}, {5, 10, 20}, 1.0 / 30);
}

// What holds at round speeds holds beside them: where in a step things meet, and how they swing back, is chance.
TEST(Sweeps, PassNothingAtNeighbouringSpeedsEither) {
    constexpr int MOST = 20;
    constexpr double BESIDE = 0.004;  // from one to the next
    const Sweep sweeps[] = {{Meeting::ITSELF, FROND_MECHANICS_ROD, 1, 1.0 / 30},
                            {Meeting::STEM, FROND_MECHANICS_ROD, 1, 1.0 / 30},
                            {Meeting::BALL, FROND_MECHANICS_ROD, 10, 1.0 / 30},
                            {Meeting::BALL, FROND_MECHANICS_ROD, 20, 1.0 / 30}};
    for (Sweep sweep : sweeps) {
        const double middle = sweep.speed;
        for (int k = -MOST; k <= MOST; k++) {
            sweep.speed = middle * (1 + BESIDE * k);
            const Verdict verdict = run_sweep(sweep);
            EXPECT_EQ(verdict.color, Color::GREEN) << told(sweep) << ": " << verdict.text;
        }
    }
}

// What gets past a kinematic body does not do so in silence.
TEST(Sweeps, WhatIsLeftBehindSaysSo) {
    for (const Meeting meeting : {Meeting::WALL, Meeting::WIRE, Meeting::PLATE})
        for (const double dt : {1.0 / 60, 1.0 / 30}) {
            const Sweep sweep = {meeting, FROND_MECHANICS_TET_COROTATIONAL, dt < 0.02 ? 10.0 : 5.0, dt};
            EXPECT_NE(run_sweep(sweep).text, "passes in silence") << told(sweep);
        }
}

// What passes by more than half of the plant's size in a step is reported.
TEST(Sweeps, WhatIsOutOfReachSaysSo) {
    const Sweep sweep = {Meeting::STEM, FROND_MECHANICS_ROD, 100, 1.0 / 30};
    EXPECT_EQ(run_sweep(sweep).color, Color::GREY);
}

// One line goes through another, beside it, and there and back.
TEST(Sweeps, CrossingsAreCountedBySide) {
    const auto upright = [](double x, double z) { return Core{{frond_vec3{x, -1, z}, frond_vec3{x, 1, z}}}; };
    const Core level = {{frond_vec3{0, 0.1, -1}, frond_vec3{0, 0.1, 1}}};
    EXPECT_EQ(std::abs(crossings(upright(-1, 0.2), upright(1, 0.3), level, level)), 1);
    EXPECT_EQ(crossings(upright(-1, 1.2), upright(1, 1.3), level, level), 0);
    EXPECT_EQ(crossings(upright(-1, 0), upright(-0.1, 0), level, level), 0);
    EXPECT_EQ(
        crossings(upright(-1, 0), upright(1, 0), level, level) + crossings(upright(1, 0), upright(-1, 0), level, level),
        0);
}

}  // namespace
}  // namespace frond::stability
