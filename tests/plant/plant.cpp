// What follows the cage: surface, normals and chain of one plant, without a world.
#include "plant/plant.hpp"

#include <gtest/gtest.h>

#include "build/build.hpp"

using namespace frond;

static std::shared_ptr<const Model> small_model() {
    const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.5, 0}, 0.02, 0.015},
                                {0, {0, 0.5, 0}, {0.2, 0.8, 0}, 0.015, 0.01}};
    frond_model_def def = {};
    def.scale = 1;
    def.cage_smoothness = 0.5;
    return build_from_surface(surface_from_stems(stems, 2), def);
}

static frond_plant_def plant_def() {
    frond_plant_def def = {};
    def.rotation = {0, 0, 0, 1};
    def.newton_iterations = 1;
    def.max_iterations = 100;
    def.tolerance = 1e-6;
    def.effects = FROND_ALL_EFFECTS;
    return def;
}

// Moves all nodes of a plant by x -> A x + b in its own frame.
static void deform(Plant& plant, const Mat3& A, const Vec3& b) {
    for (int i = 0; i < plant.motion.x.size() / 3; i++)
        point(plant.motion.x, i) = A * plant.model->cage.nodes[size_t(i)] + b;
    update_chain(plant);
    update_surface(plant, FROND_ALL_EFFECTS);
}

TEST(Surface, FollowsAnAffineMoveOfTheCageExactly) {
    const auto plant = create_plant(small_model(), plant_def());
    Mat3 A;
    A << 1.2, 0.3, 0, -0.2, 0.9, 0.1, 0.05, 0, 1.1;
    const Vec3 b(0.3, -0.2, 0.7);
    deform(*plant, A, b);
    const Surface& surface = plant->model->surface;
    const Mat3 cofactor = A.determinant() * A.inverse().transpose();
    for (size_t v = 0; v < surface.positions.size(); v++) {
        const Vec3 position = A * surface.positions[v] + b;
        const Vec3 normal = (cofactor * surface.normals[v].cast<double>()).normalized();
        for (int axis = 0; axis < 3; axis++) {
            EXPECT_NEAR(plant->surface_positions[3 * v + size_t(axis)], position[axis], 2e-6);
            EXPECT_NEAR(plant->surface_normals[3 * v + size_t(axis)], normal[axis], 1e-5);
        }
    }
    for (size_t i = 0; i < plant->model->chain.nodes.size(); i++)
        EXPECT_LT((plant->chain_positions[i] - (A * plant->model->chain.nodes[i].position + b)).norm(), 1e-9);
}

TEST(Surface, StandsInTheWorldWhereThePlantIsPlaced) {
    frond_plant_def def = plant_def();
    def.position = {5, 6, 7};
    def.rotation = {0, 0, 2, 2};  // a quarter turn about z, not of length one
    const auto plant = create_plant(small_model(), def);
    const Surface& surface = plant->model->surface;
    for (size_t v = 0; v < surface.positions.size(); v++) {
        const Vec3& rest = surface.positions[v];
        EXPECT_NEAR(plant->surface_positions[3 * v], 5 - rest.y(), 2e-6);
        EXPECT_NEAR(plant->surface_positions[3 * v + 1], 6 + rest.x(), 2e-6);
        EXPECT_NEAR(plant->surface_positions[3 * v + 2], 7 + rest.z(), 2e-6);
    }
}

TEST(Root, IsHeldAtTheFootAndNowhereElse) {
    const auto plant = create_plant(small_model(), plant_def());
    int pinned = 0;
    for (size_t i = 0; i < plant->motion.pinned.size(); i++) {
        if (!plant->motion.pinned[i]) continue;
        pinned++;
        EXPECT_LT(plant->model->cage.nodes[i].y(), 0.3);
    }
    EXPECT_GE(pinned, 4);
    frond_plant_def def = plant_def();
    def.root_height = -1;
    const auto loose = create_plant(small_model(), def);
    for (uint8_t p : loose->motion.pinned) EXPECT_FALSE(p);
    def.root_height = 0.4;
    const auto half = create_plant(small_model(), def);
    for (size_t i = 0; i < half->motion.pinned.size(); i++)
        EXPECT_EQ(bool(half->motion.pinned[i]),
                  half->model->cage.nodes[i].y() < half->model->surface.lower().y() + 0.4);
}

TEST(Plants, OfOneModelShareTheirSystem) {
    const auto model = small_model();
    const auto a = create_plant(model, plant_def()), b = create_plant(model, plant_def());
    EXPECT_EQ(a->system.get(), b->system.get());
    frond_plant_def def = plant_def();
    def.mass = FROND_CONSISTENT;
    EXPECT_NE(create_plant(model, def)->system.get(), a->system.get());
}

TEST(Grab, TakesTheNearestVertex) {
    const auto plant = create_plant(small_model(), plant_def());
    const Surface& surface = plant->model->surface;
    for (size_t v = 0; v < surface.positions.size(); v += 7)
        EXPECT_LT((vertex_position(*plant, nearest_vertex(*plant, surface.positions[v])) - surface.positions[v]).norm(),
                  1e-9);
}
