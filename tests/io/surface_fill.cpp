// Lost triangles come back where their neighbours tell what was lost, and nowhere else.
#include <gtest/gtest.h>

#include <cmath>

#include "surface/surface.hpp"

namespace frond::test {

// A tube of square or triangular section along y, open at both ends, of several rings.
static Surface tube(int sides, int rings) {
    Surface surface;
    for (int ring = 0; ring <= rings; ring++)
        for (int k = 0; k < sides; k++) {
            const double angle = 2 * M_PI * k / sides;
            surface.positions.push_back({0.1 * std::cos(angle), 0.3 * ring, 0.1 * std::sin(angle)});
        }
    for (int ring = 0; ring < rings; ring++)
        for (int k = 0; k < sides; k++) {
            const int a = ring * sides + k, b = ring * sides + (k + 1) % sides;
            surface.triangles.push_back({a, a + sides, b + sides});
            surface.triangles.push_back({a, b + sides, b});
        }
    surface.parts.resize(2);  // its lower and its upper half
    surface.parts[0].triangle_count = surface.parts[1].first_triangle = int(surface.triangles.size() / 2);
    surface.parts[1].triangle_count = int(surface.triangles.size()) - surface.parts[1].first_triangle;
    return surface;
}

static Vec3 area_of(const Surface& surface) {
    Vec3 sum = Vec3::Zero();
    for (const Triangle& t : surface.triangles) {
        const Vec3& a = surface.positions[size_t(t[0])];
        sum += 0.5 * (surface.positions[size_t(t[1])] - a).cross(surface.positions[size_t(t[2])] - a);
    }
    return sum;
}

TEST(LostTriangles, ComeBackWithTheSideAndThePartOfTheirNeighbours) {
    for (const int sides : {3, 4, 8})
        for (size_t lost : {size_t(2 * sides + 1), size_t(4 * sides)}) {
            const Surface whole = tube(sides, 4);
            Surface damaged = whole;
            damaged.triangles.erase(damaged.triangles.begin() + long(lost));
            const size_t part = lost < size_t(whole.parts[1].first_triangle) ? 0 : 1;
            damaged.parts[part].triangle_count--;
            if (part == 0) damaged.parts[1].first_triangle--;
            EXPECT_EQ(fill_lost_triangles(damaged), 1) << sides << " sides, triangle " << lost;
            EXPECT_EQ(damaged.triangles.size(), whole.triangles.size());
            EXPECT_LT((area_of(damaged) - area_of(whole)).norm(), 1e-12);
            for (size_t p = 0; p < 2; p++) EXPECT_EQ(damaged.parts[p].first_triangle, whole.parts[p].first_triangle);
        }
}

TEST(LostTriangles, AreNoneInTubesThatAreOpenAndInLoneTriangles) {
    for (const int sides : {3, 4, 8}) {
        Surface open = tube(sides, 2);
        EXPECT_EQ(fill_lost_triangles(open), 0) << sides;
    }
    Surface lone;
    lone.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    lone.triangles = {{0, 1, 2}};
    lone.parts.resize(1);
    lone.parts[0].triangle_count = 1;
    EXPECT_EQ(fill_lost_triangles(lone), 0);
    lone.triangles.push_back({2, 1, 3});
    lone.parts[0].triangle_count = 2;
    EXPECT_EQ(fill_lost_triangles(lone), 0);
}

}  // namespace frond::test
