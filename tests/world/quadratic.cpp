// Elements of order 2 through the C API: cantilevers bend as the beam formula says, with the caller's tets and in
// Frond's own cages, with every mechanics of tets, and plants stand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "frond/frond.h"
#include "support/sanitized.hpp"

namespace quadratic_tests {

constexpr double YOUNG = 1e8, POISSON = 0.3;

frond_organ_material tissue() {
    frond_organ_material organ = {"stem", {}};
    organ.material.density = 900;
    organ.material.young = YOUNG;
    organ.material.poisson = POISSON;
    organ.material.thickness = 1e-4;
    return organ;
}

frond_model_def model_def(const frond_organ_material& organ) {
    frond_model_def def = frond_default_model_def();
    def.scale = 1;
    def.up = {0, 1, 0};
    def.rest = FROND_REST_WITHOUT_GRAVITY;
    def.organs = &organ;
    def.organ_count = 1;
    return def;
}

// Returns an upright square beam of one cell across, each cell `aspect` times as long as thick.
frond_model square_beam(double width, double aspect, int cells) {
    std::vector<double> xyz;
    std::vector<int32_t> tets;
    for (int j = 0; j <= cells; j++)
        for (int k = 0; k < 2; k++)
            for (int i = 0; i < 2; i++)
                for (double value : {width * (i - 0.5), aspect * width * j, width * (k - 0.5)}) xyz.push_back(value);
    static constexpr int CELL[6][4] = {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7},
                                       {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};
    for (int j = 0; j < cells; j++)
        for (const auto& tet : CELL)
            for (int c : tet) tets.push_back(4 * (j + (c >> 1 & 1)) + 2 * (c >> 2 & 1) + (c & 1));
    const frond_organ_material organ = tissue();
    const frond_model_def def = model_def(organ);
    frond_model model = {};
    EXPECT_EQ(frond_model_from_tets(xyz.data(), int(xyz.size() / 3), tets.data(), int(tets.size() / 4), &def, &model),
              FROND_OK)
        << frond_last_error();
    return model;
}

// Returns the displacement of an upright cantilever's top by a force, shared by the highest cage nodes [m].
double push_aside(frond_model model, frond_mechanics mechanics, double root_height, double force) {
    frond_world_def world_def = frond_default_world_def();
    world_def.gravity = {0, 0, 0};
    world_def.max_substep = 1;
    frond_world world = {};
    EXPECT_EQ(frond_world_create(&world_def, &world), FROND_OK);
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = mechanics;
    def.element_order = 2;
    def.root_height = root_height;
    def.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    def.tuning.newton_iterations = 6;
    def.mass_damping = def.stiffness_damping = def.material_damping = 0;
    frond_plant plant = {};
    EXPECT_EQ(frond_plant_create(world, model, &def, &plant), FROND_OK) << frond_last_error();
    const int count = frond_plant_get_node_count(plant);
    std::vector<double> before(size_t(3 * count)), after(before), v(before);
    EXPECT_EQ(frond_plant_get_state(plant, before.data(), v.data(), count), FROND_OK);
    double top = -INFINITY;
    for (size_t i = 1; i < before.size(); i += 3) top = std::max(top, before[i]);
    std::vector<int> ends;
    for (int i = 0; i < count; i++)
        if (before[size_t(3 * i + 1)] > top - 1e-6) ends.push_back(i);
    for (int step = 0; step < 20; step++) {
        const frond_vec3 share = {force / double(ends.size()), 0, 0};
        for (int node : ends) EXPECT_EQ(frond_plant_add_force(plant, node, share), FROND_OK);
        EXPECT_EQ(frond_world_step(world, 1), FROND_OK);
    }
    EXPECT_EQ(frond_plant_get_state(plant, after.data(), v.data(), count), FROND_OK);
    double moved = 0;
    for (int node : ends) moved += (after[size_t(3 * node)] - before[size_t(3 * node)]) / double(ends.size());
    frond_world_destroy(world);
    return moved;
}

struct EveryTets : testing::TestWithParam<frond_mechanics> {};
INSTANTIATE_TEST_SUITE_P(Quadratic, EveryTets,
                         testing::Values(FROND_MECHANICS_TET_LINEAR, FROND_MECHANICS_TET_COROTATIONAL,
                                         FROND_MECHANICS_TET_NEOHOOKEAN),
                         [](const auto& info) { return std::string(frond_mechanics_name(info.param)); });

TEST_P(EveryTets, BendInSlenderCellsOfTheCallersAsTheBeamFormulaSays) {
    if (SANITIZED && GetParam() != FROND_MECHANICS_TET_COROTATIONAL) GTEST_SKIP() << "the same code";
    constexpr double WIDTH = 0.02;
    constexpr int CELLS = 8;
    for (double aspect : {1.0, 2.0, 5.0}) {
        const frond_model model = square_beam(WIDTH, aspect, CELLS);
        const double length = aspect * WIDTH * CELLS, EI = YOUNG * std::pow(WIDTH, 4) / 12;
        const double shear = 1 + 0.6 * (1 + POISSON) * std::pow(WIDTH / length, 2);  // Timoshenko, of a square: 5/6 A
        const double force = 0.01 * 3 * EI / (length * length);
        const double wanted = shear * force * std::pow(length, 3) / (3 * EI);
        EXPECT_NEAR(push_aside(model, GetParam(), 1e-6, force), wanted, 0.05 * wanted) << "aspect " << aspect;
        frond_model_destroy(model);
    }
}

TEST_P(EveryTets, BendInFrondsOwnCageAsTheBeamFormulaSays) {
    if (SANITIZED && GetParam() != FROND_MECHANICS_TET_COROTATIONAL) GTEST_SKIP() << "the same code";
    constexpr double LENGTH = 1;
    for (double aspect : {5.0, 10.0, 20.0}) {
        const double radius = LENGTH / aspect / 2;
        const frond_stem stem = {-1, {0, 0, 0}, {0, LENGTH, 0}, radius, radius};
        const frond_organ_material organ = tissue();
        frond_model_def def = model_def(organ);
        def.cage_size = std::max(3 * radius, 0.1);  // one cell across
        frond_model model = {};
        ASSERT_EQ(frond_model_from_stems(&stem, 1, &def, &model), FROND_OK) << frond_last_error();
        const double EI = YOUNG * M_PI * std::pow(radius, 4) / 4;
        const double force = 0.01 * 3 * EI / (LENGTH * LENGTH);
        // The cage extends beyond the stem's end, where the force acts with a longer lever arm.
        frond_cage_view cage;
        ASSERT_EQ(frond_model_get_cage(model, &cage), FROND_OK);
        double top = 0;
        for (int i = 0; i < cage.node_count; i++) top = std::max(top, cage.nodes[3 * i + 1]);
        const double beyond = top - LENGTH;
        const double wanted = force * LENGTH * (LENGTH * LENGTH / 3 + LENGTH * beyond + beyond * beyond) / EI;
        EXPECT_NEAR(push_aside(model, GetParam(), 0, force), wanted, 0.05 * wanted) << "aspect " << aspect;
        frond_model_destroy(model);
    }
}

TEST_P(EveryTets, StandAsModelled) {
    if (SANITIZED && GetParam() != FROND_MECHANICS_TET_COROTATIONAL) GTEST_SKIP() << "the same code";
    const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.5, 0}, 0.012, 0.01},
                                {0, {0, 0.5, 0}, {0.3, 0.8, 0.1}, 0.008, 0.004}};
    const frond_organ_material organ = tissue();
    frond_model_def def = model_def(organ);
    def.cage_size = 0.1;
    def.rest = FROND_REST_STANDS_AS_MODELLED;
    frond_model model = {};
    ASSERT_EQ(frond_model_from_stems(stems, 2, &def, &model), FROND_OK) << frond_last_error();
    const frond_world_def world_def = frond_default_world_def();
    frond_world world = {};
    ASSERT_EQ(frond_world_create(&world_def, &world), FROND_OK);
    frond_plant_def plant_def = frond_default_plant_def();
    plant_def.mechanics = GetParam();
    plant_def.element_order = 2;
    frond_plant plant = {};
    ASSERT_EQ(frond_plant_create(world, model, &plant_def, &plant), FROND_OK) << frond_last_error();
    const int count = frond_plant_get_node_count(plant);
    std::vector<double> before(size_t(3 * count)), after(before), v(before);
    ASSERT_EQ(frond_plant_get_state(plant, before.data(), v.data(), count), FROND_OK);
    for (int i = 0; i < 120; i++) ASSERT_EQ(frond_world_step(world, 1.0 / 60), FROND_OK);
    ASSERT_EQ(frond_plant_get_state(plant, after.data(), v.data(), count), FROND_OK);
    for (size_t i = 0; i < before.size(); i++) EXPECT_NEAR(after[i], before[i], 1e-4 * 0.8);
    frond_world_destroy(world);
    frond_model_destroy(model);
}

}  // namespace quadratic_tests
