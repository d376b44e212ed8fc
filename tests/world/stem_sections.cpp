// Stems with sections of their own bend and twist as beam theory says of them.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/stand.hpp"

namespace frond::test {
namespace stem_sections_tests {

constexpr double LENGTH = 1, RADIUS = 0.01, YOUNG = 1e9, POISSON = 0.3, PI = 3.14159265358979323846;
constexpr double SHEAR = YOUNG / (2 * (1 + POISSON));

// A level stem of rods along x, clamped at its begin, without gravity.
struct Shaped : Stand {
    frond_plant plant = {};
    frond_organ organ = {};
    int tip = 0;
    explicit Shaped(const frond_stem_section& section, double radius_end = RADIUS) {
        h = 1.0 / 60;
        frond_model_def def = frond_default_model_def();
        frond_organ_material material = {"stem", {}};
        must(frond_material_preset("stem", &material.material));
        material.material.young = YOUNG;
        material.material.poisson = POISSON;
        material.material.hollow = material.material.twist_to_bend = material.material.yield_strain = 0;
        material.material.damping_ratio = 1;
        def.organs = &material;
        def.organ_count = 1;
        def.scale = 1;
        def.up = {0, 1, 0};
        def.rest = FROND_REST_WITHOUT_GRAVITY;
        def.capsule_height = LENGTH / 40;
        const frond_stem stem = {-1, {0, 0, 0}, {LENGTH, 0, 0}, RADIUS, radius_end};
        must(frond_model_from_stem_sections(&stem, &section, 1, &def, &model));
        must(frond_model_get_organ(model, 0, &organ));
        frond_plant_def plant_def = plant_def_without_gravity();
        plant = add(plant_def, {0, 0, 0});
        const std::vector<double> x = places(plant);
        for (size_t i = 0; i < x.size() / 3; i++)
            if (x[3 * i] < 1e-3) must(frond_plant_pin(plant, int(i)));
        tip = frond_plant_get_chain_node_count(plant) - 1;
    }
    static frond_plant_def plant_def_without_gravity() {
        frond_plant_def def = frond_default_plant_def();
        def.mechanics = FROND_MECHANICS_ROD;
        def.effects &= ~uint32_t(FROND_EFFECT_GRAVITY);
        def.root_height = -1;
        def.mass_damping = 20;
        return def;
    }
    frond_chain_state under(const frond_vec3& force, const frond_vec3& moment) {
        for (int i = 0; i < 900; i++) {
            must(frond_plant_add_chain_load(plant, tip, force, moment));
            steps(1);
        }
        std::vector<frond_chain_state> states(size_t(tip) + 1);
        must(frond_plant_get_chain_state(plant, states.data(), tip + 1));
        return states.back();
    }
};

double round_inertia(double radius) {
    return PI * std::pow(radius, 4) / 4;
}

TEST(StemSections, ARectangleBendsByItsTwoMoments) {
    const double w = 0.02, t = 0.01, force = 0.01;
    const frond_stem_section section = {FROND_OUTLINE_RECTANGLE, w, t, {0, 1, 0}, 0, 0, 0, 0};
    Shaped thin(section), wide(section);
    EXPECT_NEAR(thin.organ.bending_thin.lower / (YOUNG * w * t * t * t / 12), 1, 1e-9);
    EXPECT_NEAR(thin.organ.bending_wide.lower / (YOUNG * t * w * w * w / 12), 1, 1e-9);
    // J of a rectangle of two to one is 0.229 w t^3 (Timoshenko).
    EXPECT_NEAR(thin.organ.torsion.lower / (SHEAR * 0.229 * w * t * t * t), 1, 2e-3);
    const double bend = force * std::pow(LENGTH, 3) / 3;
    EXPECT_NEAR(thin.under({0, force, 0}, {0, 0, 0}).position.y / (bend / (YOUNG * w * t * t * t / 12)), 1, 5e-3);
    EXPECT_NEAR(wide.under({0, 0, force}, {0, 0, 0}).position.z / (bend / (YOUNG * t * w * w * w / 12)), 1, 5e-3);
}

TEST(StemSections, ATubeBendsByItsWall) {
    const double hollow = 0.8, force = 0.01;
    Shaped tube({FROND_OUTLINE_ROUND, 0, 0, {0, 0, 0}, 0, hollow, 0, 0});
    const double wall = round_inertia(RADIUS) - round_inertia(hollow * RADIUS);
    EXPECT_NEAR(tube.organ.bending_thin.lower / (YOUNG * wall), 1, 1e-9);
    EXPECT_NEAR(tube.organ.torsion.lower / (SHEAR * 2 * wall), 1, 1e-9);
    EXPECT_NEAR(tube.under({0, force, 0}, {0, 0, 0}).position.y / (force / (3 * YOUNG * wall)), 1, 5e-3);
}

// Flexibility along x is 1 / E(x): the deflection by a force at the tip is P times the integral of (1 - x)^2 / E I.
TEST(StemSections, AModulusThatChangesAlongTheStemBendsItAsTheIntegralSays) {
    const double force = 0.005, begin = 2e9, end = 5e8;
    Shaped graded({FROND_OUTLINE_ROUND, 0, 0, {0, 0, 0}, 0, 0, begin, end});
    double flexibility = 0;
    for (int i = 0; i < 10000; i++) {
        const double x = (i + 0.5) / 10000;
        flexibility += (1 - x) * (1 - x) / (begin + x * (end - begin)) / 10000;
    }
    EXPECT_NEAR(graded.under({0, force, 0}, {0, 0, 0}).position.y / (force * flexibility / round_inertia(RADIUS)), 1,
                5e-3);
}

// A section that turns by a quarter bends sideways too: by the integral of (1 - x)^2 times its turned flexibility.
TEST(StemSections, ATwistedRectangleBendsAside) {
    const double w = 0.02, t = 0.01, force = 0.01, twist = PI / 2;
    Shaped twisted({FROND_OUTLINE_RECTANGLE, w, t, {0, 1, 0}, twist, 0, 0, 0});
    const double soft = 12 / (YOUNG * w * t * t * t), stiff = 12 / (YOUNG * t * w * w * w);
    double along = 0, aside = 0;
    for (int i = 0; i < 10000; i++) {
        const double x = (i + 0.5) / 10000, c = std::cos(twist * x), s = std::sin(twist * x);
        along += (1 - x) * (1 - x) * (c * c * soft + s * s * stiff) / 10000;
        aside += (1 - x) * (1 - x) * c * s * (soft - stiff) / 10000;
    }
    const frond_vec3 end = twisted.under({0, force, 0}, {0, 0, 0}).position;
    EXPECT_NEAR(end.y / (force * along), 1, 0.01);
    EXPECT_NEAR(end.z / (force * aside), 1, 0.02);
}

// A cone of a rectangle: flexibility L^3 / (3 E I_begin) times the begin's size over the end's.
TEST(StemSections, ARectangleTapersWithTheRadii) {
    const double w = 0.02, t = 0.01, force = 0.002;
    Shaped cone({FROND_OUTLINE_RECTANGLE, w, t, {0, 1, 0}, 0, 0, 0, 0}, RADIUS / 3);
    const double EI = YOUNG * w * t * t * t / 12;
    EXPECT_NEAR(cone.under({0, force, 0}, {0, 0, 0}).position.y / (3 * force / (3 * EI)), 1, 0.01);
}

TEST(StemSections, RefuseWhatCannotBe) {
    const frond_stem stem = {-1, {0, 0, 0}, {0, 1, 0}, RADIUS, RADIUS};
    const frond_model_def def = frond_default_model_def();
    frond_model model = {};
    const frond_stem_section good = {FROND_OUTLINE_RECTANGLE, 0.02, 0.01, {0, 0, 1}, 0.1, 0.1, 1e9, 1e9};
    std::vector<frond_stem_section> wrong(9, good);
    wrong[0].width = 0;
    wrong[1].thickness = 0.03;
    wrong[2].thin.x = NAN;
    wrong[3].twist = INFINITY;
    wrong[4].hollow = 1;
    wrong[5].young_begin = -1;
    wrong[6].young_end = 1e13;
    wrong[7].outline = FROND_OUTLINE_COUNT;
    wrong[8].hollow = NAN;
    for (const frond_stem_section& section : wrong) {
        EXPECT_EQ(frond_model_from_stem_sections(&stem, &section, 1, &def, &model), FROND_RESULT_BAD_ARGUMENT);
        EXPECT_EQ(model.id, 0u);
    }
    EXPECT_EQ(frond_model_from_stem_sections(&stem, nullptr, 1, &def, &model), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_model_from_stem_sections(nullptr, &good, 1, &def, &model), FROND_RESULT_BAD_ARGUMENT);
    ASSERT_EQ(frond_model_from_stem_sections(&stem, &good, 1, &def, &model), FROND_OK) << frond_last_error();
    frond_model_destroy(model);
}

}  // namespace stem_sections_tests
}  // namespace frond::test
