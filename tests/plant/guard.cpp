// Guards: states that a plant cannot have reached are detected and recovered from; reachable ones are left alone.
#include "plant/guard.hpp"

#include <gtest/gtest.h>

#include <random>

#include "plant/pins.hpp"
#include "support/materials.hpp"
#include "support/model_def.hpp"

namespace frond::test {
namespace guard_tests {

constexpr double H = 1.0 / 60;

std::shared_ptr<const Model> stem_model() {
    static const std::shared_ptr<const Model> model = [] {
        const frond_stem stem = {-1, {0, 0, 0}, {0, 0.6, 0}, 0.012, 0.01};
        frond_material material = plain_material(800, 5e7, 0.3, 1e-3);
        material.yield_strain = 0.02;
        const frond_organ_material organ = {"stem", material};
        frond_model_def def = model_def();
        def.cage_size = 0.08;
        def.organs = &organ;
        def.organ_count = 1;
        return build_from_stems(&stem, 1, def);
    }();
    return model;
}

std::unique_ptr<Plant> stem(frond_mechanics which) {
    frond_plant_def def = plant_def(which);
    def.integrator = FROND_INTEGRATOR_BDF2;
    return create_plant(stem_model(), def);
}

Surroundings earth() {
    Surroundings surroundings;
    surroundings.gravity = {0, -GRAVITY, 0};
    return surroundings;
}

// Returns the largest distance of a node from its modelled position, in sizes of the plant.
double away(const Plant& plant) {
    const VecX& x = plant.state.motion.x;
    double most = 0;
    for (int i = 0; i < x.size() / 3; i += plant.follow ? 2 : 1)
        most = std::max(most, (point(x, i) - point(elements_of(*plant.system).modelled, i)).norm());
    return most / double(plant.size);
}

// Puts every free node of the cage at a random position, by the function that hosts call.
void scramble(Plant& plant, double far) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-far, far);
    std::vector<double> places;
    for (int i = 0; i < node_count_of(plant); i++) {
        const Vec3 p = node_place(plant, i);
        for (int axis = 0; axis < 3; axis++) places.push_back(p[axis] + (p.y() > 0.05 ? number(random) : 0));
    }
    set_state(plant, places.data(), nullptr);
}

// Bends the plant as far as a hand does, without tearing it.
void bend(Plant& plant) {
    std::vector<double> places;
    for (int i = 0; i < node_count_of(plant); i++) {
        const Vec3 p = node_place(plant, i);
        const double aside = p.y() > 0.05 ? 0.4 * (p.y() - 0.05) * (p.y() - 0.05) : 0;
        places.insert(places.end(), {p.x() + aside, p.y(), p.z()});
    }
    set_state(plant, places.data(), nullptr);
}

struct EveryShape : testing::TestWithParam<frond_mechanics> {};
INSTANTIATE_TEST_SUITE_P(Guard, EveryShape,
                         testing::Values(FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_TET_NEOHOOKEAN,
                                         FROND_MECHANICS_ROD),
                         [](const auto& info) { return std::string(mechanics(info.param, 1).name); });

TEST_P(EveryShape, ScrambledComesBackWithinTwoSecondsAndKeepsNoSet) {
    const auto plant = stem(GetParam());
    scramble(*plant, 0.4);
    EXPECT_GT(away(*plant), 0.3);
    uint32_t trouble = 0;
    for (int i = 0; i < 120; i++) {
        step_plant(*plant, earth(), H);
        trouble |= plant->trouble;
    }
    EXPECT_TRUE(trouble & FROND_TROUBLE_RETRIED);
    EXPECT_LT(away(*plant), 0.02);
    EXPECT_EQ(plant->report.inverted, 0);
    EXPECT_TRUE(plastic_of(*plant).empty());
    for (int i = 0; i < 120; i++) step_plant(*plant, earth(), H);
    EXPECT_LE(plant->state.recovers_for, 0);
}

// Bent as far as a hand bends it, none of the guards acts.
TEST_P(EveryShape, FarBentIsLeftAlone) {
    const auto plant = stem(GetParam());
    Surroundings surroundings = earth();
    for (int i = 0; i < 60; i++) {
        surroundings.gravity = i < 30 ? Vec3(std::min(1.0, i / 10.0) * 5 * GRAVITY, -GRAVITY, 0) : Vec3(0, -GRAVITY, 0);
        step_plant(*plant, surroundings, H);
        EXPECT_EQ(plant->trouble & (FROND_TROUBLE_RETRIED | FROND_TROUBLE_REWOUND), 0u) << i;
        EXPECT_EQ(plant->state.recovers_for, 0);
        if (i == 29) {
            EXPECT_GT(away(*plant), 0.1);
        }
    }
}

TEST_P(EveryShape, EnergyOutOfNothingIsTold) {
    const auto plant = stem(GetParam());
    step_plant(*plant, earth(), H);
    plant->step.x_good = plant->state.motion.x;
    plant->step.v_good = plant->state.motion.v;
    take_workspace(*plant);         // as within a step
    constexpr double LONG = 2 * H;  // always asked for its energy
    EXPECT_TRUE(keeps_course(*plant, LONG));
    plant->state.motion.v.setConstant(3);
    EXPECT_FALSE(keeps_course(*plant, LONG));
    plant->state.motion.v = plant->step.v_good;
    for (int i = 0; i < plant->state.motion.x.size() / 3; i += plant->follow ? 2 : 1)
        point(plant->state.motion.x, i) *= 1.2;
    EXPECT_FALSE(keeps_course(*plant, LONG));
}

// Simulates steps whose searches all failed at the current position.
TEST_P(EveryShape, StartsFromItsModelledShapeWhereSearchesFindNoWayUnlessItIsPulled) {
    for (const bool is_pulled : {true, false}) {
        const auto plant = stem(GetParam());
        step_plant(*plant, earth(), H);
        bend(*plant);
        plant->state.motion.v.setZero();
        plant->step.x_good = plant->state.motion.x;
        plant->step.v_good = plant->state.motion.v;
        forces_of(*plant) = {};
        plant->input.has_user_force = is_pulled;
        uint32_t trouble = 0;
        for (double time = 0; time < plant->rest_time; time += H) {
            plant->trouble = FROND_TROUBLE_RETRIED;
            plant->report.converged = plant->step.is_off_course = false;
            watch_recovery(*plant, H);
            trouble |= plant->trouble;
        }
        EXPECT_EQ(bool(trouble & FROND_TROUBLE_REWOUND), !is_pulled);
        if (is_pulled)
            EXPECT_GT(away(*plant), 0.15);
        else
            EXPECT_LT(away(*plant), 0.02);
    }
}

// On the ground this happens at once, as bodies would collide with the rest of the old shape that is still visible.
TEST_P(EveryShape, FadesFromThereUnlessSomethingTouchesIt) {
    for (const bool is_touched : {true, false}) {
        const auto plant = stem(GetParam());
        step_plant(*plant, earth(), H);
        scramble(*plant, 0.4);
        plant->state.is_touched = is_touched;
        ASSERT_TRUE(start_from_modelled(*plant));
        EXPECT_EQ(is_over(plant->state.blend_out), is_touched);
    }
}

// What a host reads between steps is kept, and may be far from where a step has brought the plant before it starts
// anew.
TEST_P(EveryShape, FadesAlikeWhetherItsPlacesAreReadOrNot) {
    const auto read = stem(GetParam()), unread = stem(GetParam());
    for (Plant* plant : {read.get(), unread.get()}) {
        scramble(*plant, 0.4);
        if (plant == read.get()) cage_places(*plant);
        plant->state.motion.x *= 1.5;  // as within a step
        ASSERT_TRUE(start_from_modelled(*plant));
        ASSERT_FALSE(is_over(plant->state.blend_out));
    }
    EXPECT_EQ(read->state.blend_out.offset, unread->state.blend_out.offset);
}

TEST_P(EveryShape, StartsWithoutSetsThatKeepItFromItsModelledShape) {
    const auto plant = stem(GetParam());
    step_plant(*plant, earth(), H);
    scramble(*plant, 0.4);
    const Mechanics& row = mechanics(plant->which, 1);
    plant->state.own_elements = row.copy(elements_of(*plant->system));
    for (int i = 0; i < 200; i++) row.flow(*plant->state.own_elements, plant->state.motion.x, H);
    ASSERT_FALSE(plastic_of(*plant).empty());
    ASSERT_TRUE(start_from_modelled(*plant));
    EXPECT_TRUE(plastic_of(*plant).empty());
}

TEST_P(EveryShape, GoesAlongWithAFootThatIsPutElsewhere) {
    const auto plant = stem(GetParam());
    const Vec3 way(7, 1, -2);
    for (int i = 0; i < node_count_of(*plant); i++)
        if (plant->input.pinned[size_t(i)]) move_pin(*plant, i, point(plant->input.pin_target, i) + way);
    step_plant(*plant, earth(), H);
    for (int i = 0; i < plant->state.motion.x.size() / 3; i += plant->follow ? 2 : 1)
        EXPECT_LT((point(plant->state.motion.x, i) - point(elements_of(*plant->system).modelled, i) - way).norm(),
                  0.02);
}

// Under a pull of 1e5 times its weight searches end where their work is done, and the plant comes back from there.
TEST_P(EveryShape, StepsThatNothingBearsTakeLimitedWork) {
    constexpr int MOST =
        1300;  // of a step: three searches and what the last iteration of each takes [force evaluations]
    const auto plant = stem(GetParam());
    Surroundings surroundings;
    surroundings.gravity = {0, -1e5 * GRAVITY, 1e5 * GRAVITY};
    int most = 0;
    for (int i = 0; i < 30; i++) {
        step_plant(*plant, surroundings, H);
        most = std::max(most, plant->report.work);
    }
    EXPECT_LE(most, MOST);
    for (int i = 0; i < 240; i++) step_plant(*plant, earth(), H);
    EXPECT_LT(away(*plant), 0.02);
}

// Mirrored beside its foot, with inverted cells: no step recovers from that.
TEST(Guard, WhatIsCaughtInsideOutStartsFromTheModelledShape) {
    const auto plant = stem(FROND_MECHANICS_TET_COROTATIONAL);
    VecX& x = plant->state.motion.x;
    for (int i = 0; i < x.size() / 3; i++)
        if (!plant->state.motion.pinned[size_t(i)]) point(x, i).x() *= -1;
    plant->state.motion.v.setZero();
    plant->report.inverted = 1;
    ASSERT_TRUE(start_from_modelled(*plant));
    EXPECT_LT(away(*plant), 1e-12);
    EXPECT_FALSE(start_from_modelled(*plant));  // a second start gains nothing
}

TEST(Guard, WhatIsHeldBentDoesNotStartFromTheModelledShape) {
    const auto plant = stem(FROND_MECHANICS_TET_COROTATIONAL);
    int top = 0;
    for (int i = 0; i < node_count_of(*plant); i++)
        if (node_place(*plant, i).y() > node_place(*plant, top).y()) top = i;
    pin_node(*plant, top);
    for (int i = 0; i < 240; i++) {
        move_pin(*plant, top,
                 plant->nodes->modelled.segment<3>(3 * top) + Vec3(0.15 * std::min(1.0, i / 120.0), -0.05, 0));
        step_plant(*plant, earth(), H);
    }
    EXPECT_GT(away(*plant), 0.15);
    EXPECT_FALSE(start_from_modelled(*plant));
}

}  // namespace guard_tests

}  // namespace frond::test
