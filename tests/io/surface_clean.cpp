// Cleaning a surface: what is removed, what is kept, and the computed normals.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "io/import.hpp"

using namespace frond;

static Surface make(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles) {
    Surface surface;
    surface.positions = positions;
    surface.triangles = triangles;
    surface.parts.emplace_back();
    surface.parts[0].triangle_count = int(triangles.size());
    return surface;
}

static const std::vector<Vec3> SQUARE = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(Clean, DropsBadFlatAndRepeatedTrianglesAndKeepsTheOrder) {
    Surface surface = make(SQUARE, {{0, 1, 2}, {0, 1, 9}, {0, -1, 2}, {1, 1, 2}, {0, 2, 3}, {1, 2, 0}, {3, 2, 0}});
    surface.positions.push_back({2, 0, 0});
    surface.triangles.push_back({0, 1, 4});  // collinear
    surface.parts[0].triangle_count = 8;
    clean_surface(surface);
    EXPECT_EQ(surface.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(surface.dropped_triangles, 6);
    EXPECT_EQ(surface.positions, SQUARE);
    EXPECT_EQ(surface.parts[0].triangle_count, 2);
}

TEST(Clean, KeepsALeafThatWasDrawnTwiceBackToBack) {
    std::vector<Vec3> positions = SQUARE;
    positions.insert(positions.end(), SQUARE.begin(), SQUARE.end());
    Surface surface = make(positions, {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}});
    clean_surface(surface);
    EXPECT_EQ(surface.triangles.size(), 4u);
    for (int i = 0; i < 4; ++i) EXPECT_GT(surface.normals[size_t(i)].z(), 0.99f);
    for (int i = 4; i < 8; ++i) EXPECT_LT(surface.normals[size_t(i)].z(), -0.99f);
}

TEST(Clean, DropsUnusedVerticesWithAllThatBelongsToThem) {
    Surface surface = make({{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {8, 8, 8}, {0, 1, 0}}, {{1, 2, 4}});
    surface.uvs = {{9, 9}, {0, 0}, {1, 0}, {8, 8}, {0, 1}};
    surface.colors = {{9, 9, 9, 9}, {0, 0, 0, 1}, {1, 0, 0, 1}, {8, 8, 8, 8}, {0, 1, 0, 1}};
    clean_surface(surface);
    EXPECT_EQ(surface.positions.size(), 3u);
    EXPECT_EQ(surface.triangles[0], (Triangle{0, 1, 2}));
    EXPECT_EQ(surface.uvs[2], Vec2f(0, 1));
    EXPECT_EQ(surface.colors[2], (Color{0, 1, 0, 1}));
}

TEST(Clean, EmptyPartsGoAndTheOthersStayInPlace) {
    Surface surface = make(SQUARE, {{0, 0, 1}, {0, 1, 2}, {0, 2, 3}});
    surface.parts.resize(3);
    for (int i = 0; i < 3; ++i) {
        surface.parts[size_t(i)].name = std::to_string(i);
        surface.parts[size_t(i)].first_triangle = i;
        surface.parts[size_t(i)].triangle_count = 1;
    }
    clean_surface(surface);
    ASSERT_EQ(surface.parts.size(), 2u);
    EXPECT_EQ(surface.parts[0].name, "1");
    EXPECT_EQ(surface.parts[0].first_triangle, 0);
    EXPECT_EQ(surface.parts[1].first_triangle, 1);
}

TEST(Clean, AbsurdVerticesLoseTheirTriangles) {
    const double nan = std::nan("");
    Surface surface = make(SQUARE, {{0, 1, 2}, {0, 2, 3}, {0, 1, 4}, {0, 1, 5}, {0, 1, 6}});
    surface.positions.insert(surface.positions.end(), {{nan, 0, 0}, {0, INFINITY, 0}, {0, 0, 2e9}});
    clean_surface(surface);
    EXPECT_EQ(surface.triangles.size(), 2u);
    EXPECT_EQ(surface.dropped_triangles, 3);
    EXPECT_EQ(surface.repaired_vertices, 3) << "normals that nobody gave are not mended";
}

TEST(Clean, RefusesWhenNothingIsLeft) {
    const double nan = std::nan("");
    for (const Surface& bad : {make({}, {}), make({{nan, 0, 0}, {nan, 1, 0}, {nan, 0, 1}}, {{0, 1, 2}}),
                               make({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {{0, 1, 2}}), make(SQUARE, {{0, 1, 7}})}) {
        Surface surface = bad;
        try {
            clean_surface(surface);
            FAIL();
        } catch (const Error& error) {
            EXPECT_EQ(error.code, FROND_RESULT_BAD_GEOMETRY);
        }
    }
}

// Returns large triangles across the plant, slightly offset so that none is a duplicate.
static Surface make_pile(int count) {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    for (int i = 0; i < count; i++) {
        const double z = 1e-5 * i;
        positions.insert(positions.end(), {{0, 0, z}, {1, 0, z}, {0, 1, z}});
        triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return make(positions, triangles);
}

TEST(Clean, RefusesFarMoreFacesThanAPlantHasAtOnce) {
    Surface many = make_pile(1500), too_many = make_pile(5000);
    clean_surface(many);
    try {
        clean_surface(too_many);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code, FROND_RESULT_BAD_GEOMETRY);
    }
}

TEST(Clean, RefusesArraysThatDoNotAgree) {
    Surface surface = make(SQUARE, {{0, 1, 2}});
    surface.uvs.resize(3);
    EXPECT_THROW(clean_surface(surface), Error);
    surface = make(SQUARE, {{0, 1, 2}});
    surface.parts[0].triangle_count = 2;
    EXPECT_THROW(clean_surface(surface), Error);
    surface.parts.clear();
    EXPECT_THROW(clean_surface(surface), Error);
}

TEST(Clean, SmallButRealTrianglesStay) {
    // A leaf hair of a hundredth of a millimetre on a plant of two metres.
    Surface surface =
        make({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1e-5, 0, 1}, {2e-5, 0, 1}, {1e-5, 1e-5, 1}}, {{0, 1, 2}, {3, 4, 5}});
    clean_surface(surface);
    EXPECT_EQ(surface.triangles.size(), 2u);
}

TEST(Normals, AreSmoothOverASphereAndAcrossItsSeam) {
    // Every triangle has vertices of its own: only their positions coincide.
    Surface surface;
    const int n = 24;
    const auto at = [](int i, int j) {
        const double a = 2 * 3.14159265358979 * (i % 24) / 24, b = 3.14159265358979 * j / 24;
        return Vec3(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a));
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (const auto& corners : {std::array<Vec3, 3>{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                                        std::array<Vec3, 3>{at(i, j), at(i + 1, j + 1), at(i, j + 1)}}) {
                const int first = int(surface.positions.size());
                for (const Vec3& corner : corners) surface.positions.push_back(corner);
                surface.triangles.push_back({first, first + 1, first + 2});
            }
    surface.parts.emplace_back();
    surface.parts[0].triangle_count = int(surface.triangles.size());
    clean_surface(surface);
    for (size_t i = 0; i < surface.positions.size(); ++i)
        EXPECT_GT(surface.normals[i].cast<double>().dot(surface.positions[i].normalized()), 0.98);
}

TEST(Normals, ThoseThatAreThereAreKeptAndMadeUnit) {
    Surface surface = make(SQUARE, {{0, 1, 2}, {0, 2, 3}});
    surface.normals = {{0, 3, 0}, {0, 0, 0}, {NAN, 0, 0}, {0.6f, 0, 0.8f}};
    clean_surface(surface);
    EXPECT_EQ(surface.normals[0], Vec3f(0, 1, 0));
    EXPECT_GT(surface.normals[1].z(), 0.99f);
    EXPECT_GT(surface.normals[2].z(), 0.99f);
    EXPECT_NEAR(surface.normals[3].x(), 0.6f, 1e-6f);
    EXPECT_EQ(surface.repaired_vertices, 2);
}
