// Collision shapes, ground and sky are left out of a plant, and nothing else is.
#include "io/surface_scenery.hpp"

#include <gtest/gtest.h>

#include "io/import.hpp"

using namespace frond;

static void add_box(Surface& surface, const Vec3& lower, const Vec3& upper, const std::string& name) {
    const int first = int(surface.positions.size());
    for (int k = 0; k < 8; ++k)
        surface.positions.push_back(
            Vec3((k & 1 ? upper : lower).x(), (k & 2 ? upper : lower).y(), (k & 4 ? upper : lower).z()));
    Part part;
    part.name = name;
    part.first_triangle = int(surface.triangles.size());
    for (const Triangle& t : {Triangle{0, 2, 1}, Triangle{1, 2, 3}, Triangle{4, 5, 6}, Triangle{5, 7, 6},
                              Triangle{0, 1, 4}, Triangle{1, 5, 4}, Triangle{2, 6, 3}, Triangle{3, 6, 7},
                              Triangle{0, 4, 2}, Triangle{2, 4, 6}, Triangle{1, 3, 5}, Triangle{3, 7, 5}})
        surface.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    part.triangle_count = int(surface.triangles.size()) - part.first_triangle;
    surface.parts.push_back(part);
}

// Returns a stem, 1 m high, with a leaf.
static Surface make_plant(const std::string& stem = "", const std::string& leaf = "") {
    Surface surface;
    add_box(surface, Vec3(-0.01, 0, -0.01), Vec3(0.01, 1, 0.01), stem);
    add_box(surface, Vec3(0.02, 0.7, -0.05), Vec3(0.3, 0.701, 0.05), leaf);
    return surface;
}

TEST(Scenery, NamesOfCollisionShapes) {
    for (const char* name : {"UCX_trunk", "UBX_Tree_01", "UCP_stem", "usp_fruit", "leaf-colonly", "tree-colonly.001",
                             "Trunk_collider", "PhysicsShape", "corn-convcolonly"})
        EXPECT_TRUE(names_a_collider(name)) << name;
    for (const char* name : {"leaf", "bark_col", "rice_hull", "broccoli", "colony", "Ucx", "stem.001", ""})
        EXPECT_FALSE(names_a_collider(name)) << name;
}

TEST(Scenery, IsLeftOutOfAnyPlant) {
    for (const bool is_named : {false, true}) {
        const Surface plant = is_named ? make_plant("stem", "leaf") : make_plant();
        for (int kind = 0; kind < 3; ++kind) {
            Surface surface = plant;
            if (kind == 0) add_box(surface, Vec3(-0.1, 0, -0.1), Vec3(0.1, 1, 0.1), "UCX_stem");
            if (kind == 1) add_box(surface, Vec3(-5, -0.001, -5), Vec3(5, 0, 5), "Plane");
            if (kind == 2) add_box(surface, Vec3(-40, -1, -40), Vec3(40, 30, 40), "Cube");
            place_surface(surface, {0, Vec3::UnitY()});
            EXPECT_EQ(surface.triangles.size(), plant.triangles.size()) << kind;
            EXPECT_NEAR(surface.height(), 1, 1e-6) << kind;
        }
    }
}

TEST(Scenery, OrgansStay) {
    // A lily's pad is wide, thin and low, but named a leaf; a pot is not wide enough for ground.
    Surface lily = make_plant("stem", "petal");
    add_box(lily, Vec3(-1, -0.001, -1), Vec3(1, 0, 1), "leaf_2");
    const size_t triangles = lily.triangles.size();
    EXPECT_FALSE(leave_out_scenery(lily));
    EXPECT_EQ(lily.triangles.size(), triangles);
    Surface pot = make_plant();
    add_box(pot, Vec3(-0.1, -0.2, -0.1), Vec3(0.1, 0, 0.1), "");
    EXPECT_FALSE(leave_out_scenery(pot));
    // A file of nothing but a collision shape is taken as it is.
    Surface hull;
    add_box(hull, Vec3::Zero(), Vec3::Ones(), "UCX_tree");
    EXPECT_FALSE(leave_out_scenery(hull));
    EXPECT_EQ(hull.triangles.size(), 12u);
}
