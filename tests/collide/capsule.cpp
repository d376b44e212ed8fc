// Distances of capsules and triangles, with FCL as referee, and times of contact, with small time steps as referee.
// Wrong results of FCL 0.7 that these tests avoid:
// - scenes of millimetres: absolute tolerances make it miss most collisions of capsules with triangles; scenes here
//   have size 1, and results within 1e-5 of touching are not judged;
// - penetration depth, which is often off by more than 5 %: only distance and overlap are compared;
// - fcl::distance and fcl::collide do not support a capsule against a triangle, report it on stderr and return the
//   largest double: its own GJK (GJKSolver_indep) is called directly;
// - fcl::conservativeAdvancement misses contacts: small time steps judge moving shapes.
#include "collide/capsule.hpp"

#include <gtest/gtest.h>

#include "support/meshes.hpp"
#include "support/referee.hpp"

namespace frond::test {
namespace capsule_tests {

constexpr double REFEREE_TOLERANCE = 1e-5;  // tolerance of FCL's distances [m]

Vec3 random_point(Dice& dice, double size) {
    return Vec3(dice.uniform(-size, size), dice.uniform(-size, size), dice.uniform(-size, size));
}

Capsule random_capsule(Dice& dice) {
    const Vec3 begin = random_point(dice, 1);
    return {begin, begin + random_point(dice, 0.7), dice.uniform(0.02, 0.3)};
}

Corners random_triangle(Dice& dice) {
    const Vec3 corner = random_point(dice, 0.6);
    return {corner, corner + random_point(dice, 0.8), corner + random_point(dice, 0.8)};
}

// Checks that the points lie on the axes, the surfaces' distance is between them, and the normal points from b to a.
void expect_consistent(const Gap& gap, double radius) {
    ASSERT_TRUE(gap.normal.allFinite() && gap.on_a.allFinite() && gap.on_b.allFinite() && std::isfinite(gap.distance));
    EXPECT_NEAR(gap.normal.norm(), 1, 1e-12);
    const double between = (gap.on_a - gap.on_b).norm();
    if (between > 0) {
        EXPECT_NEAR(gap.distance, between - radius, 1e-12);
        EXPECT_NEAR(gap.normal.dot(gap.on_a - gap.on_b), between, 1e-12);
    }
}

// The referee returns -1 or 0 if shapes overlap.
void expect_same(const Gap& gap, double referee, bool referee_overlaps) {
    if (gap.distance > REFEREE_TOLERANCE) {
        EXPECT_NEAR(gap.distance, referee, REFEREE_TOLERANCE);
        EXPECT_FALSE(referee_overlaps);
    }
    if (gap.distance < -REFEREE_TOLERANCE) {
        EXPECT_LE(referee, REFEREE_TOLERANCE);
        EXPECT_TRUE(referee_overlaps);
    }
}

void expect_same_as_referee(const Capsule& a, const Capsule& b) {
    const Gap gap = gap_between(a, b);
    expect_consistent(gap, a.radius + b.radius);
    expect_same(gap, referee_distance(a, b), referee_overlap(a, b));
    EXPECT_NEAR(gap_between(b, a).distance, gap.distance, 1e-12);
}

TEST(Capsule, RandomPairsAreAsFarApartAsTheRefereeSays) {
    Dice dice(1);
    std::array<int, 4> met = {};  // pairs whose nearest points are ends of no axis, of one, of both; and overlaps
    for (int n = 0; n < 5000; ++n) {
        const Capsule a = random_capsule(dice), b = random_capsule(dice);
        expect_same_as_referee(a, b);
        const Gap gap = gap_between(a, b);
        const bool a_end = gap.on_a == a.begin || gap.on_a == a.end, b_end = gap.on_b == b.begin || gap.on_b == b.end;
        ++met[gap.distance < 0 ? 3 : size_t(a_end) + size_t(b_end)];
    }
    for (const int count : met) EXPECT_GT(count, 100);
}

TEST(Capsule, DegeneratePairsAreAsFarApartAsTheRefereeSays) {
    Dice dice(2);
    for (int n = 0; n < 500; ++n) {
        const Capsule a = random_capsule(dice);
        const Vec3 along = a.end - a.begin, aside = along.cross(random_point(dice, 1)).normalized();
        const double away = dice.uniform(0, 1), slide = dice.uniform(-2, 2);
        Capsule parallel = a, in_line = a, crossing = a, sphere = random_capsule(dice), nearly = a;
        for (Capsule* b : {&parallel, &nearly}) {
            b->begin += away * aside + slide * along;
            b->end += away * aside + slide * along;
        }
        nearly.end += 1e-7 * random_point(dice, 1);
        in_line.begin += slide * along;
        in_line.end += slide * along;
        crossing.begin = a.begin + dice.uniform(0, 1) * along - 0.5 * aside;
        crossing.end = crossing.begin + aside;
        sphere.end = sphere.begin;
        const Capsule a_sphere = {a.begin, a.begin, a.radius}, turned = {a.end, a.begin, a.radius};
        for (const Capsule& b : {parallel, nearly, in_line, crossing, sphere, a, turned}) {
            expect_same_as_referee(a, b);
            expect_same_as_referee(a_sphere, b);
        }
    }
}

TEST(Capsule, KnownGapsAreExact) {
    const Capsule along_x = {{-1, 0, 0}, {1, 0, 0}, 0.1};
    // Side to side, side to end, end to end.
    EXPECT_DOUBLE_EQ(gap_between(along_x, Capsule{{0, 1, -1}, {0, 1, 1}, 0.2}).distance, 0.7);
    EXPECT_DOUBLE_EQ(gap_between(along_x, Capsule{{0.3, 1, 0}, {0.3, 2, 0}, 0.2}).distance, 0.7);
    EXPECT_DOUBLE_EQ(gap_between(along_x, Capsule{{4, 4, 0}, {9, 4, 0}, 0.2}).distance, 4.7);
    EXPECT_EQ(gap_between(along_x, Capsule{{0, 1, -1}, {0, 1, 1}, 0.2}).normal, Vec3(0, -1, 0));
    // Axes that cross, and a capsule in itself: as deep as the sum of the radii.
    EXPECT_DOUBLE_EQ(gap_between(along_x, Capsule{{0, -1, 0}, {0, 1, 0}, 0.2}).distance, -0.3);
    EXPECT_EQ(std::abs(gap_between(along_x, Capsule{{0, -1, 0}, {0, 1, 0}, 0.2}).normal.z()), 1);
    EXPECT_EQ(gap_between(along_x, along_x).normal.x(), 0);
    // Through a face, nearer to its upper side.
    const Corners floor = {Vec3(-5, 0, -5), Vec3(5, 0, -5), Vec3(0, 0, 5)};
    const Gap through = gap_between(Capsule{{0, -0.2, 0}, {0, 1, 0}, 0.1}, floor);
    EXPECT_DOUBLE_EQ(through.distance, -0.3);
    EXPECT_LT((through.normal - Vec3(0, 1, 0)).norm(), 1e-15);
    EXPECT_DOUBLE_EQ(gap_between(Capsule{{-1, 2, 0}, {1, 2, 0}, 0.1}, floor).distance, 1.9);
}

void expect_same_as_referee(const Capsule& a, const Corners& b) {
    const Gap gap = gap_between(a, b);
    expect_consistent(gap, a.radius);
    expect_same(gap, referee_distance(a, b), referee_overlap(a, b));
}

TEST(Capsule, RandomTrianglesAreAsFarAwayAsTheRefereeSays) {
    Dice dice(3);
    int overlaps = 0, through = 0;
    for (int n = 0; n < 10000; ++n) {
        const Capsule a = random_capsule(dice);
        const Corners b = random_triangle(dice);
        expect_same_as_referee(a, b);
        const Gap gap = gap_between(a, b);
        overlaps += gap.distance < 0;
        through += gap.on_a == gap.on_b;
    }
    EXPECT_GT(overlaps, 500);
    EXPECT_GT(through, 50);
}

TEST(Capsule, DegenerateTrianglesAreAsFarAwayAsTheRefereeSays) {
    Dice dice(4);
    for (int n = 0; n < 500; ++n) {
        const Capsule a = random_capsule(dice);
        const Corners flat = random_triangle(dice);
        const Vec3 along = a.end - a.begin, aside = along.cross(random_point(dice, 1)).normalized();
        // The axis is beside the face and parallel to it, in its plane, or along an edge; triangles that are a segment
        // or a point.
        const Vec3 at = a.begin + dice.uniform(-0.5, 0.5) * along + dice.uniform(0, 0.6) * aside;
        const Vec3 third = along.cross(aside);
        expect_same_as_referee(a, Corners{at, at + along, at + third});
        expect_same_as_referee(a, Corners{at, at + 0.7 * along, at + 0.3 * along + aside});
        expect_same_as_referee(a, Corners{a.begin, a.end, at + aside});
        expect_same_as_referee(a, Corners{flat[0], flat[1], flat[0] + 0.3 * (flat[1] - flat[0])});
        expect_same_as_referee(a, Corners{flat[0], flat[0], flat[0]});
        expect_same_as_referee(Capsule{a.begin, a.begin, a.radius}, flat);
    }
}

// Moves a shape, and interpolates between two shapes of one kind.
Capsule moved(const Capsule& capsule, const Vec3& begin, const Vec3& end) {
    return {capsule.begin + begin, capsule.end + end, capsule.radius};
}
Capsule between(const Capsule& before, const Capsule& after, double time) {
    return {before.begin + time * (after.begin - before.begin), before.end + time * (after.end - before.end),
            before.radius};
}
Corners between(const Corners& before, const Corners& after, double time) {
    Corners now;
    for (size_t k = 0; k < 3; ++k) now[k] = before[k] + time * (after[k] - before[k]);
    return now;
}

// Checks the impact with small time steps: if the steps see a contact, it is found, no later than by them; at the time
// found the shapes touch, and before it the steps see them apart.
template <class Other>
void expect_impact(const Capsule& a0, const Capsule& a1, const Other& b0, const Other& b1, int& hits) {
    constexpr int STEPS = 400;
    constexpr double TOUCHING = 1e-5;
    const std::optional<Impact> impact = first_impact(a0, a1, b0, b1);
    const auto gap_at = [&](double time) { return gap_between(between(a0, a1, time), between(b0, b1, time)).distance; };
    hits += impact.has_value();
    if (impact && impact->time > 0) {
        ASSERT_LE(impact->time, 1);
        EXPECT_NEAR(gap_at(impact->time), 0, TOUCHING);
        EXPECT_NEAR(impact->gap.distance, gap_at(impact->time), 1e-12);
    }
    for (int step = 0; step <= STEPS; ++step) {
        const double time = double(step) / STEPS;
        if (impact && time >= impact->time) break;
        ASSERT_GT(gap_at(time), 0) << "at " << time;
    }
}

TEST(Capsule, MovingCapsulesMeetWhenSmallStepsSaySo) {
    Dice dice(5);
    int hits = 0;
    for (int n = 0; n < 2000; ++n) {
        const Capsule a = random_capsule(dice), b = random_capsule(dice);
        const Vec3 way = dice.uniform(0.3, 3) * (b.begin - a.begin) + random_point(dice, 0.5);
        const Vec3 other = random_point(dice, 0.5);
        // Straight on, and with rotation and stretching.
        expect_impact(a, moved(a, way, way), b, moved(b, other, other), hits);
        expect_impact(a, moved(a, way, way + random_point(dice, 1)), b, random_capsule(dice), hits);
    }
    EXPECT_GT(hits, 1000);
    EXPECT_LT(hits, 3500);
}

TEST(Capsule, MovingCapsulesMeetTrianglesWhenSmallStepsSaySo) {
    Dice dice(6);
    int hits = 0;
    for (int n = 0; n < 1500; ++n) {
        const Capsule a = random_capsule(dice);
        const Corners b = random_triangle(dice);
        const Vec3 way = dice.uniform(0.3, 3) * (b[0] - a.begin) + random_point(dice, 0.5);
        expect_impact(a, moved(a, way, way), b, b, hits);
        expect_impact(a, moved(a, way, way + random_point(dice, 1)), b, random_triangle(dice), hits);
    }
    EXPECT_GT(hits, 500);
    EXPECT_LT(hits, 2500);
}

TEST(Capsule, TimesOfContactAreThoseOfTheFormula) {
    // A ball of 5 cm at 20 m/s in a step of 1/60 s goes through a stem of 1 cm, which small steps hardly see.
    const Capsule stem = {{0, 0, 0}, {0, 1, 0}, 0.005}, ball = {{-0.2, 0.5, 0}, {-0.2, 0.5, 0}, 0.025};
    const Vec3 way(20.0 / 60, 0, 0);
    const auto hit = first_impact(ball, moved(ball, way, way), stem, stem);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->time, (0.2 - 0.03) / way.x(), 1e-5);
    EXPECT_LT((hit->gap.normal - Vec3(-1, 0, 0)).norm(), 1e-9);
    // Thin shapes: a needle through a needle and through a face, at any speed.
    const Capsule needle = {{-1, -1e-3, 0}, {-1, 1e-3, 0}, 1e-6}, other = {{0, 0, -1e-3}, {0, 0, 1e-3}, 1e-6};
    for (const double far : {2.0, 2e3, 2e6}) {
        const Vec3 on(far, 0, 0);
        const auto thin = first_impact(needle, moved(needle, on, on), other, other);
        ASSERT_TRUE(thin);
        EXPECT_NEAR(thin->time * far, 1, 1e-5);
        const Corners face = {Vec3(0, -1, -1), Vec3(0, 1, -1), Vec3(0, 0, 1)};
        const auto through = first_impact(needle, moved(needle, on, on), face, face);
        ASSERT_TRUE(through);
        EXPECT_NEAR(through->time * far, 1, 1e-5);
    }
    // Past each other at a hair's breadth, at rest, and overlapping from the start.
    const Capsule past = moved(ball, Vec3(0, 0, 0.03001), Vec3(0, 0, 0.03001));
    EXPECT_FALSE(first_impact(past, moved(past, way, way), stem, stem));
    EXPECT_FALSE(first_impact(ball, ball, stem, stem));
    EXPECT_EQ(first_impact(stem, moved(stem, way, way), stem, stem)->time, 0);
}

}  // namespace capsule_tests

}  // namespace frond::test
