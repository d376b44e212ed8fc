// Stems become tubes: closed, oriented outwards, with the requested radii and positions.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/error.hpp"
#include "core/log.hpp"
#include "io/import.hpp"

using namespace frond;

static frond_stem stem(int parent, Vec3 begin, Vec3 end, double radius_begin, double radius_end) {
    return {parent, {begin.x(), begin.y(), begin.z()}, {end.x(), end.y(), end.z()}, radius_begin, radius_end};
}

// Returns the signed volume by the divergence theorem: correct and positive only if closed and oriented outwards.
static double volume_of(const Surface& surface, const Part& part) {
    double volume = 0;
    for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
        const Triangle& corners = surface.triangles[size_t(t)];
        volume += surface.positions[size_t(corners[0])].dot(
                      surface.positions[size_t(corners[1])].cross(surface.positions[size_t(corners[2])])) /
                  6;
    }
    return volume;
}

TEST(Stems, AreClosedTubesOfTheRightVolume) {
    const double a = 0.02, b = 0.01, length = 0.5, pi = 3.14159265358979;
    const frond_stem one = stem(-1, {0.3, 0.1, -0.2}, Vec3(0.3, 0.1, -0.2) + length * Vec3(1, 2, 2) / 3, a, b);
    Surface surface = surface_from_stems(&one, 1);
    std::map<std::pair<int, int>, int> edges;
    for (const Triangle& t : surface.triangles)
        for (size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ((edges.count({edge.second, edge.first})), 1u);
    }
    const double cone = pi * length * (a * a + a * b + b * b) / 3, caps = 2 * pi * (a * a * a + b * b * b) / 3;
    // A ten-sided polygon has 0.935 of its circle's area; its corners lie 1.033 radii out, so that it bends alike.
    EXPECT_NEAR(volume_of(surface, surface.parts[0]) / (cone + caps), 0.935 * 1.033 * 1.033, 0.01);
}

TEST(Stems, EachIsAPartAndStaysWhereItWasPut) {
    const frond_stem tree[] = {stem(-1, {0, 0, 0}, {0, 0.5, 0}, 0.02, 0.015),
                               stem(0, {0, 0.5, 0}, {0.2, 0.8, 0}, 0.01, 0.005),
                               stem(0, {0, 0.5, 0}, {-0.2, 0.8, 0}, 0.01, 0.005)};
    Surface surface = surface_from_stems(tree, 3);
    ASSERT_EQ(surface.parts.size(), 3u);
    EXPECT_EQ(surface.parts[2].name, "stem_2");
    place_surface(surface, {});
    EXPECT_EQ(surface.parts.size(), 3u);
    EXPECT_EQ(surface.dropped_triangles, 0);
    EXPECT_EQ(surface.up, Vec3::UnitY());
    EXPECT_EQ(surface.scale, 1);
    EXPECT_NEAR(surface.lower().y(), -0.02, 1e-9);
    EXPECT_NEAR(surface.normals[0].y(), -1, 1e-3);
}

TEST(Stems, RefuseWhatIsNoTree) {
    const Vec3 o = Vec3::Zero(), y = Vec3::UnitY();
    const frond_stem rows[] = {stem(0, o, y, 0.1, 0.1),        stem(-2, o, y, 0.1, 0.1),
                               stem(-1, o, o, 0.1, 0.1),       stem(-1, o, y, 0, 0.1),
                               stem(-1, o, y, 0.1, -1),        stem(-1, o, y, NAN, 0.1),
                               stem(-1, o, y, 0.1, INFINITY),  stem(-1, o, Vec3(0, NAN, 0), 0.1, 0.1),
                               stem(-1, o, 1e30 * y, 0.1, 0.1)};
    for (const frond_stem& row : rows) EXPECT_THROW(surface_from_stems(&row, 1), Error);
    const frond_stem good = stem(-1, o, y, 0.1, 0.1);
    EXPECT_THROW(surface_from_stems(nullptr, 1), Error);
    EXPECT_THROW(surface_from_stems(&good, 0), Error);
    EXPECT_THROW(surface_from_stems(&good, -5), Error);
}

TEST(Stems, WarnOfOneThatBeginsInTheAir) {
    static std::string warning;
    set_log([](const char* message, void*) { warning = message; }, nullptr);
    const frond_stem tree[] = {stem(-1, {0, 0, 0}, {0, 0.5, 0}, 0.02, 0.015),
                               stem(0, {0.3, 0.5, 0}, {0.4, 0.8, 0}, 0.01, 0.005)};
    surface_from_stems(tree, 2);
    set_log(nullptr, nullptr);
    EXPECT_NE(warning.find("stem 1"), std::string::npos);
}
