// Batched plants move exactly as each alone does, to the last bit, in lanes of any width, whatever happens to one of
// them.
#include "batch/plants.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>

#include "core/lanes.hpp"
#include "modelling/build.hpp"
#include "plant/pins.hpp"
#include "plant/plant_step.hpp"
#include "support/materials.hpp"
#include "support/model_def.hpp"
#include "support/soups.hpp"

namespace frond::test {
namespace batch_tests {

constexpr double H = 1.0 / 60;

// Returns a stem with branches whose organs damp differently, or a blade.
std::shared_ptr<const Model> model_of(bool is_blade) {
    frond_model_def def = model_def();
    def.capsule_height = 0.08;
    def.cage_size = 0.1;
    Material material = plain_material(900, 2e7, 0.3, 0.02);
    if (is_blade) {
        Surface surface;
        add_sheet(surface, 2, 20, [](double s, double t) { return Vec3(0.1 * t * t, 0.6 * t, 0.06 * (s - 0.5)); });
        surface.parts[0].name = "blade";
        const frond_organ_material organ = {"blade", material};
        def.organs = &organ;
        def.organ_count = 1;
        return build_from_surface(std::move(surface), def);
    }
    const frond_stem stems[] = {
        {-1, {0, 0, 0}, {0, 0.4, 0}, 0.008, 0.006},       {0, {0, 0.4, 0}, {0.02, 0.8, 0}, 0.006, 0.003},
        {0, {0, 0.4, 0}, {0.3, 0.6, 0.1}, 0.004, 0.002},  {1, {0.02, 0.8, 0}, {-0.2, 0.95, 0.05}, 0.003, 0.002},
        {0, {0, 0.4, 0}, {-0.1, 0.6, 0.2}, 0.004, 0.002}, {0, {0, 0.4, 0}, {-0.1, 0.6, -0.2}, 0.004, 0.002}};
    const frond_organ_material organ = {"stem_1", material};
    def.organs = &organ;
    def.organ_count = 1;
    return build_from_stems(stems, 6, def);
}

struct Width {
    const int before = most_lanes();
    explicit Width(int most) { most_lanes() = std::min(before, most); }
    ~Width() { most_lanes() = before; }
};

// Plants of a model at several positions, with several rotations, in gusts.
struct Field {
    std::vector<std::unique_ptr<Plant>> plants;
    std::unique_ptr<Wind> wind;
    Surroundings surroundings;
    int batched = 0, alone = 0;  // plants stepped; those stepped alone assemble in a workspace of their own

    Field(const std::shared_ptr<const Model>& model, int count, double speed,
          frond_mechanics which = FROND_MECHANICS_ROD) {
        for (int i = 0; i < count; i++) {
            frond_plant_def def = plant_def(which);
            def.position = {1.3 * i, 0, 0.7 * i * i};
            const double angle = 0.3 + 0.8 * i;
            def.rotation = {0.1 * i, std::sin(angle), 0, std::cos(angle)};
            def.mass_damping = 0.1;
            def.stiffness_damping = 0.001;
            def.material_damping = 1;
            plants.push_back(create_plant(model, def));
        }
        surroundings.gravity = Vec3(0, -9.81, 0);
        if (speed == 0) return;
        frond_wind_def def = {};
        def.velocity = {speed, 0, 0.3 * speed};
        def.turbulence = 0.3;
        def.length_scale = 10;
        def.seed = 5;
        def.profile = FROND_WIND_PROFILE_LOG;
        def.reference_height = 2;
        def.roughness = 0.01;
        def.density = 1.2;
        wind = make_wind(def);
        surroundings.wind = wind.get();
    }
    void step(bool side_by_side) {
        if (wind) pass_time(*wind, H);
        surroundings.time += H;
        std::vector<Plant*> together;
        for (const auto& plant : plants) {
            if (side_by_side && may_be_batched(*plant, surroundings, H) &&
                (together.empty() || go_alike(*together[0], *plant)))
                together.push_back(plant.get());
            else
                solve_plant(*plant, surroundings, H);
        }
        const size_t most = size_t(most_in_batch());
        for (size_t i = 0; i < together.size(); i += most)
            solve_batch(together.data() + i, int(std::min(most, together.size() - i)), surroundings, H);
        for (const auto& plant : plants) {
            const bool is_alone = plant->step.workspace && plant->report.ms_assembly > 0;
            ++(is_alone ? alone : batched);
            accept_step(*plant, surroundings, H);
            clear_user_force(*plant);
        }
    }
};

// Disturbs single plants as hosts do.
void disturb(Field& field, int step) {
    Plant& third = *field.plants[2];
    if (step == 60) pin_node(third, node_count_of(third) - 1);
    if (step == 90) unpin_node(third, node_count_of(third) - 1);
    if (step == 95) {
        pin_node(third, node_count_of(third) - 2);
        unpin_node(third, node_count_of(third) - 2);
    }
    if (step >= 100 && step < 110) {
        forces_of(*field.plants[0]).on_nodes = VecX::Constant(3 * node_count_of(*field.plants[0]), 0.02);
        field.plants[0]->input.has_user_force = true;
    }
    if (step == 120) {
        const VecX x = 1.01 * cage_places(*field.plants[1]);
        std::vector<double> world;
        for (int i = 0; i < node_count_of(*field.plants[1]); i++)
            for (int c = 0; c < 3; c++) world.push_back(field.plants[1]->to_world(point(x, i))[c]);
        set_state(*field.plants[1], world.data(), nullptr);
    }
}

// Compares bits, so that zeros must have the same sign.
bool are_same_bits(const VecX& a, const VecX& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), size_t(a.size()) * sizeof(double)) == 0;
}

const VecX& before(const Plant& plant) {
    return plant.step.x_good.size() > 0 ? plant.step.x_good : plant.state.motion.history.x_prev;
}

void expect_same(const Plant& a, const Plant& b) {
    ASSERT_EQ(a.state.motion.x, b.state.motion.x);
    ASSERT_EQ(a.state.motion.v, b.state.motion.v);
    ASSERT_TRUE(are_same_bits(a.state.motion.x, b.state.motion.x));
    ASSERT_TRUE(are_same_bits(a.state.motion.v, b.state.motion.v));
    ASSERT_EQ(before(a), before(b));
    ASSERT_EQ(air_force(a), air_force(b));
    ASSERT_EQ(a.trouble, b.trouble);
    ASSERT_EQ(a.state.stretched, b.state.stretched);
    ASSERT_EQ(a.step.is_off_course, b.step.is_off_course);
    ASSERT_EQ(plastic_of(a), plastic_of(b));
    ASSERT_NEAR(a.report.residual, b.report.residual, 1e-12);
}

// (mechanics, blade, wind [m/s], lanes)
struct BatchedPlants : testing::TestWithParam<std::tuple<frond_mechanics, bool, double, int>> {};
INSTANTIATE_TEST_SUITE_P(Plants, BatchedPlants,
                         testing::Combine(testing::Values(FROND_MECHANICS_ROD, FROND_MECHANICS_TET_COROTATIONAL,
                                                          FROND_MECHANICS_TET_LINEAR),
                                          testing::Bool(), testing::Values(0.0, 3.0, 25.0), testing::Values(2, 4, 8)));

TEST_P(BatchedPlants, GoAsAlone) {
    const auto [which, is_blade, speed, lanes] = GetParam();
    const Width width(lanes);
    const int steps = which == FROND_MECHANICS_ROD ? 240 : 150;
    const auto model = model_of(is_blade);
    Field together(model, 11, speed, which), apart(model, 11, speed, which);
    for (int step = 0; step < steps; ++step) {
        for (Field* field : {&together, &apart}) disturb(*field, step);
        together.step(true);
        apart.step(false);
        for (size_t i = 0; i < together.plants.size(); i++) {
            expect_same(*together.plants[i], *apart.plants[i]);
            if (HasFatalFailure()) FAIL() << "plant " << i << " in step " << step;
        }
    }
    // A gale takes most chains out of batches, and stems with cages too; the two left over by batches of four step
    // alone.
    const bool is_calm = which == FROND_MECHANICS_ROD ? speed <= 10 : is_blade;
    EXPECT_GT(together.batched, is_calm ? steps * (lanes == 2 ? 9 : 8) : 40);
    EXPECT_GT(together.alone, 11);
    EXPECT_EQ(apart.batched, 0);
}

// Returns a blade of 0.3 mm, whose cage is too soft in tension.
std::shared_ptr<const Model> thin_blade() {
    Surface surface;
    add_sheet(surface, 2, 30, [](double s, double t) { return Vec3(0, 0.6 * t, (s - 0.5) * 0.05); });
    surface.parts[0].name = "blade";
    const frond_organ_material organ = {"blade", plain_material(900, 2e9, 0.3, 3e-4)};
    frond_model_def def = model_def();
    def.cage_size = 0.05;
    def.rest = FROND_REST_WITHOUT_GRAVITY;
    def.organs = &organ;
    def.organ_count = 1;
    return build_from_surface(std::move(surface), def);
}

// In a wind a blade's fibres stay taut for long.
TEST(PlantBatch, HaveTautFibresAsAlone) {
    const auto model = thin_blade();
    Field together(model, 8, 5, FROND_MECHANICS_TET_COROTATIONAL), apart(model, 8, 5, FROND_MECHANICS_TET_COROTATIONAL);
    int taut = 0, batched_taut = 0;
    for (int step = 0; step < 150; ++step) {
        std::vector<size_t> with_fibres;
        for (size_t i = 0; i < together.plants.size(); i++)
            if (together.plants[i]->state.stretched > 0) with_fibres.push_back(i);
        together.step(true);
        apart.step(false);
        taut += int(with_fibres.size());
        for (const size_t i : with_fibres) batched_taut += together.plants[i]->report.ms_assembly == 0;
        for (size_t i = 0; i < together.plants.size(); i++) expect_same(*together.plants[i], *apart.plants[i]);
        if (HasFatalFailure()) FAIL() << "step " << step;
    }
    EXPECT_GT(taut, 300);
    EXPECT_GT(batched_taut, taut / 8);
    std::printf("%d of %d plants with taut fibres in batches\n", batched_taut, taut);
}

// A host's wind field that varies with position.
void field_of_host(const frond_vec3* points, int count, double time, frond_vec3* velocities, void*) {
    for (int i = 0; i < count; i++)
        velocities[i] = {velocities[i].x + std::sin(points[i].z + time), 0.5 * std::sin(points[i].x), velocities[i].z};
}

TEST(PlantBatch, AreBlownByAFieldOfTheHostAsAlone) {
    const auto model = model_of(true);
    Field together(model, 5, 3), apart(model, 5, 3);
    for (Field* field : {&together, &apart}) field->wind->field = field_of_host;
    for (int step = 0; step < 60; ++step) {
        together.step(true);
        apart.step(false);
        for (size_t i = 0; i < together.plants.size(); i++) expect_same(*together.plants[i], *apart.plants[i]);
        if (HasFatalFailure()) FAIL() << "step " << step;
    }
    const int in_batch = most_in_batch() < 5 ? 4 : 5;  // of five plants in four lanes one is left over
    EXPECT_GT(together.batched, in_batch * 50);
}

// Returns a straight stem, as soft as can stand.
std::shared_ptr<const Model> soft_stem() {
    frond_model_def def = model_def();
    def.capsule_height = 0.1;
    def.cage_size = 0.1;
    const frond_stem stem = {-1, {0, 0, 0}, {0, 1, 0}, 0.01, 0.01};
    const frond_organ_material organ = {"stem_0", plain_material(500, 4e7, 0.3, 0.02)};
    def.organs = &organ;
    def.organ_count = 1;
    return build_from_stems(&stem, 1, def);
}

// Returns a shape whose curvature decreases towards its end, which is rotated by `angle` [rad].
VecX rolled_up(const Plant& plant, double angle) {
    VecX x = elements_of(*plant.system).modelled;
    Vec3 before = Vec3::Zero(), place = before;
    double turn_before = 0;
    for (int i = 0; i < x.size() / 3; i += 2) {
        const Vec3 modelled = point(x, i);
        const double turn = angle * (1 - std::pow(1 - modelled.y(), 3)), middle = (turn + turn_before) / 2;
        place += (modelled.y() - before.y()) * Vec3(-std::sin(middle), std::cos(middle), 0);
        point(x, i) = place;
        point(x, i + 1) = Vec3(0, 0, turn);
        before = modelled;
        turn_before = turn;
    }
    return x;
}

TEST(PlantBatch, GoOnPastHalfATurn) {
    constexpr double FROM = M_PI - 0.2, RATE = 8;  // rotation of the end [rad] and its rate [rad/s]
    const auto model = soft_stem();
    Field together(model, 3, 0.1), apart(model, 3, 0.1);
    for (Field* field : {&together, &apart}) {
        field->surroundings.gravity.setZero();
        for (const auto& plant : field->plants) {
            plant->input.effects &= ~uint32_t(FROND_EFFECT_PLASTICITY);
            plant->state.motion.x = rolled_up(*plant, FROM);
            plant->state.motion.v = (rolled_up(*plant, FROM + 1e-4) - rolled_up(*plant, FROM - 1e-4)) * (RATE / 2e-4);
            // The foot is at rest, to the last bit.
            for (int i = 0; i < int(plant->state.motion.pinned.size()); i++) {
                if (!plant->state.motion.pinned[size_t(i)]) continue;
                point(plant->state.motion.x, i) = point(plant->state.motion.pin_target, i);
                point(plant->state.motion.v, i).setZero();
            }
            moved(*plant);
        }
    }
    const auto end = [](const Plant& plant) { return plant.state.motion.x[plant.state.motion.x.size() - 1]; };
    for (int step = 0; step < 3; ++step) {
        together.step(true);
        apart.step(false);
        for (size_t i = 0; i < together.plants.size(); i++) {
            const Plant& plant = *together.plants[i];
            expect_same(plant, *apart.plants[i]);
            if (HasFatalFailure()) FAIL() << "plant " << i << " in step " << step;
            EXPECT_EQ(plant.trouble, 0u) << "plant " << i << " in step " << step;
            EXPECT_EQ(plant.report.work, 0);
            EXPECT_TRUE(step == 0 || plant.state.motion.history.valid);
            // The rotation passes half a turn and goes on.
            EXPECT_EQ(end(plant) < 0, step > 0) << end(plant) << ", plant " << i << " in step " << step;
        }
    }
    EXPECT_EQ(together.alone, 3);  // first steps
}

}  // namespace batch_tests

}  // namespace frond::test
