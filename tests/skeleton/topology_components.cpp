#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "core/error.hpp"
#include "core/union_find.hpp"
#include "skeleton/topology.hpp"
#include "support/soups.hpp"
#include "surface/triangle_distance.hpp"

namespace frond::test {
namespace topology_components_tests {

double distance_of(const Topology& topology, int t, int u) {
    Corners a, b;
    for (size_t k = 0; k < 3; ++k) {
        a[k] = topology.points[size_t(topology.triangles[size_t(t)][k])];
        b[k] = topology.points[size_t(topology.triangles[size_t(u)][k])];
    }
    return std::sqrt(nearest_of_triangles(a, b).squared);
}

// Checks that there are no cycles, that every component is reached, and that points are on the named triangles.
void expect_tree(const Topology& topology) {
    ASSERT_EQ(int(topology.joints.size()), topology.component_count - 1);
    UnionFind sets(size_t(topology.component_count));
    for (const Joint& joint : topology.joints) {
        EXPECT_TRUE(sets.join(topology.triangle_component[size_t(joint.triangle_a)],
                              topology.triangle_component[size_t(joint.triangle_b)]));
        EXPECT_NEAR((joint.point_a - joint.point_b).norm(), distance_of(topology, joint.triangle_a, joint.triangle_b),
                    1e-9);
    }
}

TEST(Topology, WeldsVerticesAtTheSamePlace) {
    Surface surface;
    add_part(surface, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    add_part(surface, {{1 + 3e-7, 0, 0}, {1, 1, 0}, {0, 1, -2e-7}}, {{0, 1, 2}});
    add_part(surface, {{1 + 1e-4, 0, 0}, {2, 0, 0}, {2, 1, 0}}, {{0, 1, 2}});
    const Topology topology = make_topology(surface);
    EXPECT_EQ(topology.points.size(), 7u);
    EXPECT_EQ(topology.vertex_point[3], topology.vertex_point[1]);
    EXPECT_EQ(topology.vertex_point[5], topology.vertex_point[2]);
    EXPECT_EQ(topology.points[size_t(topology.vertex_point[3])], surface.positions[1]);
    EXPECT_EQ(topology.component_count, 2);
    EXPECT_EQ(topology.triangle_component, (std::vector<int>{0, 0, 1}));
    expect_tree(topology);
}

// Triangles of a scan or a printer's file, none of which shares a corner exactly.
TEST(Topology, OfASoupIsThatOfItsMesh) {
    constexpr int SIDES = 8, RINGS = 30;
    Surface surface;
    surface.parts.emplace_back();
    std::mt19937_64 engine(5);
    std::uniform_real_distribution<double> dice(-1e-5, 1e-5);
    const auto corner = [&](int ring, int k) {
        const double angle = 2 * M_PI * k / SIDES;
        surface.positions.push_back(
            Vec3(0.02 * std::cos(angle) + dice(engine), double(ring) / RINGS, 0.02 * std::sin(angle) + dice(engine)));
        return int(surface.positions.size()) - 1;
    };
    for (int ring = 0; ring < RINGS; ring++)
        for (int k = 0; k < SIDES; k++) {
            surface.triangles.push_back({corner(ring, k), corner(ring, k + 1), corner(ring + 1, k + 1)});
            surface.triangles.push_back({corner(ring, k), corner(ring + 1, k + 1), corner(ring + 1, k)});
        }
    surface.parts[0].triangle_count = int(surface.triangles.size());
    const Topology topology = make_topology(surface);
    EXPECT_EQ(topology.component_count, 1);
    EXPECT_EQ(topology.points.size(), size_t(SIDES * (RINGS + 1)));
}

TEST(Topology, WeldingMatchesComparingAllPairs) {
    Surface surface = random_soup(7, 150);
    const size_t count = surface.positions.size();
    for (size_t v = 0; v < count; ++v) surface.positions[v] = surface.positions[v].array().round() * 0.25;
    surface.positions[0] = Vec3(0, 0, 0);
    surface.positions[1] = Vec3(5, 3, 1);
    const Topology topology = make_topology(surface);
    for (size_t v = 0; v < count; ++v)
        for (size_t w = 0; w < v; ++w)
            EXPECT_EQ(topology.vertex_point[v] == topology.vertex_point[w],
                      surface.positions[v] == surface.positions[w]);
}

TEST(Topology, JoinsHundredsOfLooseCardsToTheStem) {
    Surface surface;
    add_tube(surface, {0, 0, 0}, 0.02, 2, 8, 20, false);
    std::mt19937_64 engine(3);
    for (int i = 0; i < 400; ++i) {
        const double angle = double(engine() % 1000) * 0.00628, y = 0.2 + 0.0042 * i;
        const Vec3 out(std::cos(angle), 0.3, std::sin(angle)), side(-std::sin(angle), 0, std::cos(angle));
        add_sheet(surface, 1, 3, [&](double s, double t) {
            return Vec3(Vec3(0, y, 0) + (0.015 + 0.2 * t) * out + 0.06 * (s - 0.5) * side);
        });
    }
    const Topology topology = make_topology(surface);
    EXPECT_EQ(topology.component_count, 401);
    expect_tree(topology);
    int on_stem = 0;
    for (const Joint& joint : topology.joints)
        on_stem += topology.triangle_component[size_t(joint.triangle_a)] == 0 ||
                   topology.triangle_component[size_t(joint.triangle_b)] == 0;
    EXPECT_EQ(on_stem, 400) << "each card crosses the stem and many other cards; it must hang on the stem";
}

TEST(Topology, JoinsNearestComponentsAsAllPairsWould) {
    // Equal small cards far apart, so that the cost of a joint depends on its length only.
    Surface surface;
    std::mt19937_64 engine(5);
    for (int i = 0; i < 60; ++i) {
        const Vec3 at(double(engine() % 1000) / 10, double(engine() % 1000) / 10, double(engine() % 1000) / 10);
        add_part(surface, {at, at + Vec3(0.01, 0, 0), at + Vec3(0, 0.01, 0)}, {{0, 1, 2}});
    }
    const Topology topology = make_topology(surface);
    expect_tree(topology);
    double found = 0;
    for (const Joint& joint : topology.joints) found += (joint.point_a - joint.point_b).norm();
    // Prim's algorithm over all pairs.
    std::vector<double> nearest(60, 1e300);
    std::vector<char> taken(60, 0);
    double least = 0;
    nearest[0] = 0;
    for (int step = 0; step < 60; ++step) {
        size_t best = 60;
        for (size_t i = 0; i < 60; ++i)
            if (!taken[i] && (best == 60 || nearest[i] < nearest[best])) best = i;
        taken[best] = 1;
        least += nearest[best];
        for (size_t i = 0; i < 60; ++i) nearest[i] = std::min(nearest[i], distance_of(topology, int(best), int(i)));
    }
    EXPECT_NEAR(found, least, 1e-9 * least);
}

TEST(Topology, HangsALeafOnOneStemAndTiesStemsAtTheFoot) {
    Surface surface;
    add_tube(surface, {0, 0, 0}, 0.02, 1, 8, 10, false);
    add_tube(surface, {0.3, 0, 0}, 0.02, 1, 8, 10, false);
    add_sheet(surface, 4, 1, [](double s, double t) { return Vec3(-0.1 + 0.5 * s, 0.7 + 0.1 * t, 0.001); });
    const Topology topology = make_topology(surface);
    expect_tree(topology);
    for (const Joint& joint : topology.joints) {
        const bool leaf = std::max(topology.triangle_component[size_t(joint.triangle_a)],
                                   topology.triangle_component[size_t(joint.triangle_b)]) == 2;
        if (leaf) {
            EXPECT_EQ(joint.point_a, joint.point_b);
        } else {
            EXPECT_LT(joint.point_a.y(), 0.11) << "stems are tied where they stand";
        }
    }
}

TEST(Topology, PutsUpWithSoups) {
    for (uint64_t seed = 0; seed < 100; ++seed) expect_tree(make_topology(random_soup(seed, 1 + int(seed % 40))));
}

TEST(Topology, GivesTheSameBitsAgain) {
    const Surface surface = random_soup(11, 300);
    const Topology a = make_topology(surface), b = make_topology(surface);
    ASSERT_EQ(a.joints.size(), b.joints.size());
    for (size_t j = 0; j < a.joints.size(); ++j) {
        EXPECT_EQ(a.joints[j].triangle_a, b.joints[j].triangle_a);
        EXPECT_EQ(a.joints[j].point_b, b.joints[j].point_b);
    }
}

TEST(Topology, RefusesAPointAndNothing) {
    Surface surface;
    EXPECT_THROW(make_topology(surface), Error);
    std::vector<Vec3> points(300, Vec3(1, 2, 3));
    std::vector<Triangle> triangles(1000000, {0, 1, 2});
    add_part(surface, points, triangles);
    try {
        make_topology(surface);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code, FROND_RESULT_BAD_GEOMETRY);
    }
    Surface bad;
    add_part(bad, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 7}});
    EXPECT_THROW(make_topology(bad), Error);
}

TEST(Topology, MeasuresTrianglesAsSamplingDoes) {
    std::mt19937_64 engine(9);
    const auto uniform = [&engine] { return double(engine() >> 11) * 0x1p-53; };
    for (int round = 0; round < 200; ++round) {
        Corners a, b;
        for (size_t k = 0; k < 3; ++k) {
            a[k] = Vec3(uniform(), uniform(), uniform());
            b[k] = Vec3(uniform() + 0.7, uniform(), uniform());
        }
        if (round % 5 == 0) b[2] = b[1];
        const NearestPair pair = nearest_of_triangles(a, b);
        EXPECT_NEAR((pair.a - pair.b).squaredNorm(), pair.squared, 1e-12);
        EXPECT_LT((nearest_in_triangle(a, pair.a) - pair.a).norm(), 1e-9);
        EXPECT_LT((nearest_in_triangle(b, pair.b) - pair.b).norm(), 1e-9);
        double sampled = 1e300;
        const int n = 40;
        for (int i = 0; i <= n; ++i)
            for (int k = 0; i + k <= n; ++k) {
                const Vec3 place = a[0] + double(i) / n * (a[1] - a[0]) + double(k) / n * (a[2] - a[0]);
                sampled = std::min(sampled, (nearest_in_triangle(b, place) - place).norm());
            }
        const double found = std::sqrt(pair.squared);
        EXPECT_LE(found, sampled + 1e-9);
        EXPECT_GE(found, sampled - 2.0 / n);
    }
}

}  // namespace topology_components_tests

}  // namespace frond::test
