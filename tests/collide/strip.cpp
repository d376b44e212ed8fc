// Cores of strips: nearest points by samples of them, and first times by small time steps, as FCL's conservative
// advancement misses contacts.
#include "collide/strip.hpp"

#include <gtest/gtest.h>

#include "collide/strip_cull.hpp"
#include "support/meshes.hpp"

namespace frond::test {
namespace strip_tests {

Vec3 random_point(Dice& dice, double size) {
    return Vec3(dice.uniform(-size, size), dice.uniform(-size, size), dice.uniform(-size, size));
}

// A line, or a quad that is bent along its diagonal.
StripCore random_core(Dice& dice, double spread) {
    StripCore core;
    core.is_line = dice.uniform(0, 1) < 0.4;
    const Vec3 middle = random_point(dice, spread), along = random_point(dice, 0.5), wide = random_point(dice, 0.3);
    core.at = {middle, middle + wide, middle + along, middle + along + wide + random_point(dice, 0.1)};
    if (core.is_line) core.at = {middle, middle, middle + along, middle + along};
    return core;
}

// Points of both triangles, or of the line.
std::vector<Vec3> samples_of(const StripCore& core) {
    constexpr int COUNT = 12;
    std::vector<Vec3> points;
    for (int part = 0; part < part_count(core); part++) {
        const auto t = part_of(core, part);
        for (int i = 0; i <= COUNT; i++)
            for (int k = 0; k <= COUNT - i; k++)
                points.push_back(t[0] + (t[1] - t[0]) * i / COUNT + (t[2] - t[0]) * k / COUNT);
    }
    return points;
}

TEST(Strip, NearestPointsAreNearestAndByTheirWeights) {
    Dice dice(1);
    for (int round = 0; round < 300; round++) {
        const StripCore a = random_core(dice, 1), b = random_core(dice, 1);
        const StripGap gap = gap_between(a, b);
        double least = INFINITY;
        for (const Vec3& p : samples_of(a))
            for (const Vec3& q : samples_of(b)) least = std::min(least, (p - q).norm());
        EXPECT_LE(gap.distance, least + 1e-9);
        EXPECT_GE(gap.distance, least - 0.1);
        if (gap.distance == 0) continue;
        const Vec3 between = point_on(a.at, gap.on_a) - point_on(b.at, gap.on_b);
        EXPECT_NEAR(between.norm(), gap.distance, 1e-7);
        EXPECT_NEAR(between.dot(gap.normal), gap.distance, 1e-7);
    }
}

StripCore between(const StripCore& before, const StripCore& after, double time) {
    StripCore now = before;
    for (size_t k = 0; k < 4; k++) now.at[k] += time * (after.at[k] - before.at[k]);
    return now;
}

// A quad bent along its diagonal is not convex: by all four corners time went backwards, and plants stood still.
TEST(Strip, FirstTimesAreThoseOfSmallSteps) {
    constexpr int STEPS = 400;
    constexpr double NEAR = 0.02;
    Dice dice(2);
    int hits = 0, misses = 0;
    for (int round = 0; round < 800; round++) {
        const StripCore a = random_core(dice, 0.5), b = random_core(dice, 0.5);
        StripCore a_after = a, b_after = b;
        const Vec3 way = random_point(dice, 1);
        for (size_t k = 0; k < 4; k++) {
            const size_t as = a.is_line ? k & 2 : k;
            a_after.at[k] += way + Vec3(0.05 * double(as), 0, 0);
        }
        if (gap_between(a, b).distance < 2 * NEAR) continue;
        const auto impact = first_impact(a, a_after, b, b_after, NEAR, gap_between(a, b));
        double first = 2;
        for (int i = 0; i <= STEPS && first > 1; i++)
            if (gap_between(between(a, a_after, double(i) / STEPS), between(b, b_after, double(i) / STEPS)).distance <
                NEAR)
                first = double(i) / STEPS;
        (first <= 1 ? hits : misses)++;
        if (first <= 1) {
            ASSERT_TRUE(impact) << round;
            EXPECT_LE(impact->time, first + 1e-9) << round;
            EXPECT_GE(impact->time, 0) << round;
            EXPECT_LE(impact->gap.distance, 1.02 * NEAR) << round;
        }
        if (stay_apart(a, a_after, b, b_after, NEAR)) {
            EXPECT_GT(first, 1) << round;
        }
    }
    EXPECT_GT(hits, 20);
    EXPECT_GT(misses, 20);
}

StripCore line(const Vec3& begin, const Vec3& end) {
    return {{begin, begin, end, end}, true};
}

StripCore moved(StripCore core, const Vec3& way) {
    for (Vec3& corner : core.at) corner += way;
    return core;
}

std::optional<StripImpact> impact_of(const StripCore& a, const Vec3& way, const StripCore& b, double near) {
    return first_impact(a, moved(a, way), b, b, near, gap_between(a, b));
}

TEST(Strip, FirstTimesAreThoseOfTheFormula) {
    constexpr double SHARE = 0.011;  // of the distance that counts as touching
    // A ball of 5 cm at 20 m/s in a step of 1/60 s goes through a stem of 1 cm, which small steps hardly see.
    const StripCore stem = line({0, 0, 0}, {0, 1, 0}), ball = line({-0.2, 0.5, 0}, {-0.2, 0.5, 0});
    const double near = 0.03;
    const Vec3 way(20.0 / 60, 0, 0);
    const auto hit = impact_of(ball, way, stem, near);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->time, (0.2 - near) / way.x(), SHARE * near / way.x());
    EXPECT_LT((hit->gap.normal - Vec3(-1, 0, 0)).norm(), 1e-9);
    // Thin shapes: a needle through a needle and through a face, at any speed.
    const StripCore needle = line({-1, -1e-3, 0}, {-1, 1e-3, 0}), other = line({0, 0, -1e-3}, {0, 0, 1e-3});
    const StripCore face = {{Vec3(0, -1, -1), Vec3(0, 1, -1), Vec3(0, -1, 1), Vec3(0, 1, 1)}, false};
    for (const double far : {2.0, 2e3, 2e6})
        for (const StripCore& target : {other, face}) {
            const auto thin = impact_of(needle, Vec3(far, 0, 0), target, 1e-6);
            ASSERT_TRUE(thin);
            EXPECT_NEAR(thin->time * far, 1, 1e-5);
        }
    // Past each other at a hair's breadth, at rest, and too near from the start.
    EXPECT_FALSE(impact_of(moved(ball, Vec3(0, 0, near * (1 + SHARE))), way, stem, near));
    EXPECT_FALSE(impact_of(ball, Vec3::Zero(), stem, near));
    EXPECT_EQ(impact_of(moved(ball, Vec3(0.19, 0, 0)), way, stem, near)->time, 0);
}

}  // namespace strip_tests
}  // namespace frond::test
