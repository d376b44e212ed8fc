// Strains of capsules, compared with the beam formula.
#include <cmath>
#include <vector>

#include "support/stems.hpp"

namespace strains_tests {

constexpr double LENGTH = 0.6, RADIUS = 0.006, YOUNG = 2e8;

// A straight stem without gravity.
struct Stem {
    frond_world world = {};
    frond_model model = {};
    frond_plant plant = {};
    explicit Stem(frond_mechanics mechanics) {
        frond_world_def world_def = frond_default_world_def();
        world_def.gravity = {0, 0, 0};
        world_def.sleep_distance = 0;
        EXPECT_EQ(frond_world_create(&world_def, &world), FROND_OK);
        frond_model_def def = frond_default_model_def();
        frond_organ_material organ = {"stem", {}};
        EXPECT_EQ(frond_material_preset("stem", &organ.material), FROND_OK);
        organ.material.young = YOUNG;
        organ.material.yield_strain = 0;
        organ.material.strength = 0;
        def.organs = &organ;
        def.organ_count = 1;
        def.scale = 1;
        def.up = {0, 1, 0};
        def.rest = FROND_REST_WITHOUT_GRAVITY;
        def.capsule_height = 0.06;
        def.cage_size = 0.06;
        const frond_stem stem = {-1, {0, 0, 0}, {0, LENGTH, 0}, RADIUS, RADIUS};
        EXPECT_EQ(frond_model_from_stems(&stem, 1, &def, &model), FROND_OK) << frond_last_error();
        frond_plant_def plant_def = frond_default_plant_def();
        plant_def.mechanics = mechanics;
        plant_def.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
        plant_def.mass_damping = 20;
        EXPECT_EQ(frond_plant_create(world, model, &plant_def, &plant), FROND_OK) << frond_last_error();
    }
    Stem(const Stem&) = delete;
    Stem& operator=(const Stem&) = delete;
    ~Stem() {
        frond_world_destroy(world);
        frond_model_destroy(model);
    }
    std::vector<double> strains() const {
        std::vector<double> out(size_t(frond_plant_get_capsule_count(plant)));
        EXPECT_EQ(frond_plant_get_strains(plant, out.data(), int(out.size())), FROND_OK) << frond_last_error();
        return out;
    }
};

class Strains : public ::testing::TestWithParam<frond_mechanics> {};
INSTANTIATE_TEST_SUITE_P(World, Strains, ::testing::Values(FROND_MECHANICS_ROD, FROND_MECHANICS_TET_COROTATIONAL),
                         [](const auto& info) { return std::string(frond_mechanics_name(info.param)); });

// Strain of the outermost fibre at s from the tip, with a transverse force P: P s r / (E I).
TEST_P(Strains, AreThoseOfABeam) {
    Stem stem(GetParam());
    for (const double strain : stem.strains()) EXPECT_LT(strain, 1e-6);
    frond_grab grab;
    ASSERT_EQ(frond_grab_create(stem.plant, {0, LENGTH, 0}, 5, &grab), FROND_OK);
    ASSERT_EQ(frond_grab_move(grab, {0.02, LENGTH, 0}), FROND_OK);
    for (int i = 0; i < 240; i++) ASSERT_EQ(frond_world_step(stem.world, 1.0 / 60), FROND_OK);
    frond_vec3 force;
    ASSERT_EQ(frond_grab_get(grab, nullptr, nullptr, &force), FROND_OK);
    ASSERT_GT(force.x, 0.01);
    std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(stem.plant)));
    ASSERT_EQ(frond_plant_get_capsules(stem.plant, capsules.data(), int(capsules.size())), FROND_OK);
    const std::vector<double> strains = stem.strains();
    const double stiffness = YOUNG * M_PI * std::pow(RADIUS, 4) / 4;
    double mean = 0;
    int count = 0;
    for (size_t i = 2; i + 3 < strains.size(); i++) {  // the foot is held, the tip is hardly bent
        const double from_tip = LENGTH - 0.5 * (capsules[i].begin.y + capsules[i].end.y);
        const double known = force.x * from_tip * RADIUS / stiffness;
        if (GetParam() == FROND_MECHANICS_ROD) {
            EXPECT_NEAR(strains[i] / known, 1, 0.08) << i;
        }
        mean += strains[i] / known;
        count++;
    }
    // Cells of a cage, which are as long as capsules, average the strain over these.
    EXPECT_NEAR(mean / count, 1, GetParam() == FROND_MECHANICS_ROD ? 0.06 : 0.2);
}

TEST(StrainsOfNothing, AreRefused) {
    SmallWorld small;
    const int count = frond_plant_get_capsule_count(small.plant);
    std::vector<double> out(size_t(count), 7);
    EXPECT_EQ(frond_plant_get_strains({}, out.data(), count), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_plant_get_strains(small.plant, out.data(), count + 1), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_get_strains(small.plant, nullptr, count), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(out[0], 7);
}

// Both integrators continue from the plant's current state; one that damps calms it.
TEST(SetIntegrator, GoesOnFromTheSameMotion) {
    Stem stem(FROND_MECHANICS_ROD);
    EXPECT_EQ(frond_plant_set_integrator(stem.plant, frond_integrator(99)), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_set_integrator({}, FROND_INTEGRATOR_BDF2), FROND_RESULT_BAD_HANDLE);
    frond_grab grab;
    ASSERT_EQ(frond_grab_create(stem.plant, {0, LENGTH, 0}, 5, &grab), FROND_OK);
    ASSERT_EQ(frond_grab_move(grab, {0.1, LENGTH, 0}), FROND_OK);
    for (int i = 0; i < 60; i++) ASSERT_EQ(frond_world_step(stem.world, 1.0 / 60), FROND_OK);
    frond_vec3 before, after;
    for (int integrator = 0; integrator < FROND_INTEGRATOR_SYMPLECTIC_EULER; integrator++) {
        ASSERT_EQ(frond_plant_get_tip(stem.plant, &before), FROND_OK);
        ASSERT_EQ(frond_plant_set_integrator(stem.plant, frond_integrator(integrator)), FROND_OK);
        ASSERT_EQ(frond_plant_get_tip(stem.plant, &after), FROND_OK);
        EXPECT_EQ(before.x, after.x);
        ASSERT_EQ(frond_world_step(stem.world, 1.0 / 60), FROND_OK);
        ASSERT_EQ(frond_plant_get_tip(stem.plant, &after), FROND_OK);
        EXPECT_NEAR(before.x, after.x, 0.002) << frond_integrator_name(frond_integrator(integrator));
        frond_report report;
        ASSERT_EQ(frond_world_get_report(stem.world, &report), FROND_OK);
        EXPECT_EQ(report.trouble, 0u) << frond_integrator_name(frond_integrator(integrator));
    }
}

}  // namespace strains_tests
