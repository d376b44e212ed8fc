// Placing: scale and up axis, as requested, as declared or guessed.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/log.hpp"
#include "io/import.hpp"

using namespace frond;

static std::string last_warning;
static void keep_warning(const char* message, void*) {
    last_warning = message;
}

// Returns a bent stem with three leaves on its upper half; it stands on the origin and grows along `up`.
static Surface make_plant(double height, const Vec3& up) {
    Surface surface;
    const Vec3 side = up.unitOrthogonal(), depth = up.cross(side);
    const auto strip = [&](const Vec3& begin, const Vec3& end, const Vec3& wide) {
        const int first = int(surface.positions.size());
        for (int k = 0; k <= 10; ++k)
            for (double sign : {-1.0, 1.0})
                surface.positions.push_back(height * (begin + 0.1 * k * (end - begin) + sign * wide));
        for (int k = 0; k < 20; ++k)
            surface.triangles.push_back({first + k, first + k + 1 + k % 2, first + k + 2 - k % 2});
    };
    strip(Vec3::Zero(), up, 0.02 * side);
    strip(Vec3::Zero(), up, 0.02 * depth);
    strip(0.6 * up, 0.7 * up + 0.4 * side, 0.05 * depth);
    strip(0.7 * up, 0.8 * up - 0.4 * side, 0.05 * depth);
    strip(0.5 * up, 0.65 * up + 0.35 * depth, 0.05 * side);
    surface.parts.emplace_back();
    surface.parts.back().triangle_count = int(surface.triangles.size());
    return surface;
}

TEST(Place, TrustsASensibleScale) {
    for (double height : {0.03, 0.5, 2.1, 45.0}) {
        last_warning.clear();
        set_log(keep_warning, nullptr);
        Surface surface = make_plant(height, Vec3::UnitY());
        place_surface(surface, {});
        EXPECT_EQ(surface.scale, 1);
        EXPECT_NEAR(surface.height(), height, 0.05 * height);
        EXPECT_EQ(last_warning, "");
    }
}

TEST(Place, GuessesTheUnitOfAnAbsurdHeightAndWarns) {
    const double rows[][2] = {{210, 0.01}, {1500, 0.001}, {0.001, 1000}, {0.015, 100}, {3e7, 1e-7}, {1e-12, 1e12}};
    for (const auto& row : rows) {
        last_warning.clear();
        set_log(keep_warning, nullptr);
        Surface surface = make_plant(row[0], Vec3::UnitY());
        place_surface(surface, {});
        EXPECT_NEAR(surface.scale / row[1], 1, 1e-9) << row[0];
        EXPECT_GE(surface.height(), 0.1);
        EXPECT_LE(surface.height(), 3.2);
        EXPECT_NE(last_warning, "");
    }
}

TEST(Place, APlantCalledAHerbIsNoTree) {
    const struct {
        const char *file, *part;
        double height, scale;
    } rows[] = {{"white_lily.glb", "pPlane1", 20, 0.1},
                {"plant.glb", "Potted_Plant_Leaf_0", 10, 0.1},
                {"flower.ply", "", 28, 0.1},
                {"sunflower.glb", "", 2.5, 1},
                {"tree.glb", "", 28, 1},
                {"bobble.obj", "Circle", 39, 1},
                {"flower_tree.glb", "petals", 20, 1},
                {"plant.glb", "Flowerless", 20, 1}};
    for (const auto& row : rows) {
        last_warning.clear();
        set_log(keep_warning, nullptr);
        Surface surface = make_plant(row.height, Vec3::UnitY());
        surface.parts[0].name = row.part;
        place_surface(surface, {0, Vec3::Zero(), row.file});
        EXPECT_NEAR(surface.scale, row.scale, 1e-9) << row.file;
        EXPECT_EQ(last_warning.empty(), row.scale == 1) << row.file;
    }
    // A given scale is used.
    Surface surface = make_plant(20, Vec3::UnitY());
    place_surface(surface, {1, Vec3::Zero(), "lily.glb"});
    EXPECT_EQ(surface.scale, 1);
}

TEST(Place, TakesScaleAndUpAsTold) {
    Surface surface = make_plant(2, Vec3::UnitX());
    place_surface(surface, {0.5, Vec3(3, 0, 0)});
    EXPECT_NEAR(surface.height(), 1, 0.05);
    EXPECT_EQ(surface.scale, 0.5);
    EXPECT_EQ(surface.up, Vec3::UnitX());
    EXPECT_GT(surface.lower().y(), -0.05);
}

TEST(Place, ScaleIsPerFileUnitEvenWhenTheFileDeclaredAnother) {
    // A file in centimetres that was already converted to metres, and from z up to y up.
    Surface surface = make_plant(1, Vec3::UnitY());
    surface.scale = 0.01;
    surface.up = Vec3::UnitZ();
    surface.up_declared = true;
    place_surface(surface, {0.001, Vec3::UnitZ()});
    EXPECT_NEAR(surface.height(), 0.1, 0.005);
    EXPECT_NEAR(surface.scale, 0.001, 1e-15);
}

TEST(Place, GuessesUpFromTheFoot) {
    for (int axis : {1, 2}) {
        Surface surface = make_plant(1, Vec3::Unit(axis));
        place_surface(surface, {});
        EXPECT_EQ(surface.up, Vec3::Unit(axis));
        EXPECT_NEAR(surface.height(), 1, 0.05);
    }
}

TEST(Place, AnOrganDrawnAlongXFromItsFootStands) {
    // A spike: a thin cross that lies on the ground and begins at the origin.
    Surface surface;
    for (const Vec3& wide : {Vec3(0, 0.04, 0), Vec3(0, 0, 0.04)}) {
        const int first = int(surface.positions.size());
        for (int k = 0; k <= 10; ++k)
            for (double sign : {-1.0, 1.0}) surface.positions.push_back(Vec3(0.1 * k, 0, 0) + sign * wide);
        for (int k = 0; k < 20; ++k)
            surface.triangles.push_back({first + k, first + k + 1 + k % 2, first + k + 2 - k % 2});
    }
    surface.parts.emplace_back();
    surface.parts.back().triangle_count = int(surface.triangles.size());
    Surface row = surface;
    place_surface(surface, {});
    EXPECT_EQ(surface.up, Vec3::UnitX());
    EXPECT_NEAR(surface.height(), 1, 0.05);
    // A row of plants around the origin stays in place.
    for (Vec3& position : row.positions) position.x() -= 0.5;
    place_surface(row, {});
    EXPECT_EQ(row.up, Vec3::UnitY());
}

TEST(Place, ATallPlantWithItsOriginInTheMiddleStandsAlongItsLength) {
    Surface surface = make_plant(1, Vec3::UnitZ());
    for (Vec3& position : surface.positions) {
        position.z() -= 0.5;
        position.x() *= 0.5;
        position.y() *= 0.5;
    }
    place_surface(surface, {});
    EXPECT_EQ(surface.up, Vec3::UnitZ());
}

TEST(Place, BelievesADeclaredUpAxis) {
    Surface surface = make_plant(1, Vec3::UnitZ());
    surface.up_declared = true;
    place_surface(surface, {});
    EXPECT_EQ(surface.up, Vec3::UnitY());
}

TEST(Place, TurnsNormalsToo) {
    Surface surface = make_plant(1, Vec3::UnitZ());
    surface.normals.assign(surface.positions.size(), Vec3f(0, 0, 1));
    place_surface(surface, {});
    for (const Vec3f& normal : surface.normals) EXPECT_GT(normal.y(), 0.999f);
}

TEST(Place, PlacingTwiceChangesNothing) {
    Surface surface = make_plant(200, Vec3::UnitZ());
    place_surface(surface, {0, Vec3::UnitZ()});
    const std::vector<Vec3> once = surface.positions;
    place_surface(surface, {0.1, Vec3::UnitZ()});
    EXPECT_EQ(surface.positions, once);
}

TEST(Place, FetchesAPlantFromFarAway) {
    Surface surface = make_plant(1, Vec3::UnitY());
    for (Vec3& position : surface.positions) position += Vec3(4e5, 100, 5e6);
    last_warning.clear();
    set_log(keep_warning, nullptr);
    place_surface(surface, {0, Vec3::UnitY()});
    EXPECT_NEAR(surface.lower().y(), 0, 1e-9);
    EXPECT_NEAR(surface.lower().x() + surface.upper().x(), 0, 1e-9);
    EXPECT_NE(last_warning, "");

    // A metre beside the origin is the artist's choice.
    Surface near = make_plant(1, Vec3::UnitY());
    for (Vec3& position : near.positions) position.x() += 5;
    place_surface(near, {0, Vec3::UnitY()});
    EXPECT_GT(near.lower().x(), 4);
}

TEST(Place, RefusesBadOptions) {
    const double nan = std::nan("");
    for (const ImportOptions& options : {ImportOptions{-1, Vec3::Zero()}, ImportOptions{nan, Vec3::Zero()},
                                         ImportOptions{1, Vec3(nan, 0, 0)}, ImportOptions{INFINITY, Vec3::Zero()}}) {
        Surface surface = make_plant(1, Vec3::UnitY());
        EXPECT_THROW(place_surface(surface, options), Error);
    }
}

TEST(Triangles, AreTakenAsTheyAre) {
    const float xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 5, 5};
    const int32_t indices[] = {0, 1, 2};
    const Surface surface = surface_from_triangles(xyz, 4, indices, 1);
    EXPECT_EQ(surface.positions.size(), 4u);
    EXPECT_EQ(surface.triangles.size(), 1u);
    const int32_t bad[] = {0, 1, 4};
    EXPECT_THROW(surface_from_triangles(xyz, 4, bad, 1), Error);
    EXPECT_THROW(surface_from_triangles(nullptr, 4, indices, 1), Error);
    EXPECT_THROW(surface_from_triangles(xyz, 4, nullptr, 1), Error);
    EXPECT_THROW(surface_from_triangles(xyz, -1, indices, 1), Error);
    EXPECT_THROW(surface_from_triangles(xyz, 4, indices, 0), Error);
    EXPECT_THROW(surface_from_triangles(xyz, 4, indices, 2000000000), Error);
}
