// Distances of capsules and triangles, with FCL as referee.
// Wrong results of FCL 0.7 that these tests avoid:
// - scenes of millimetres: absolute tolerances make it miss most collisions of capsules with triangles; scenes here
//   have size 1, and results within 1e-5 of touching are not judged;
// - penetration depth, which is often off by more than 5 %: only distance and overlap are compared;
// - fcl::distance and fcl::collide do not support a capsule against a triangle, report it on stderr and return the
//   largest double: its own GJK (GJKSolver_indep) is called directly.
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

}  // namespace capsule_tests

}  // namespace frond::test
