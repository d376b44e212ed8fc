// Guards: states that a plant cannot have reached are detected and recovered from; reachable ones are left alone.
#include <gtest/gtest.h>

#include <random>

#include "plant/pins.hpp"
#include "plant/plant_step.hpp"
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

// Returns the largest distance of a cage node from its modelled position, in sizes of the plant.
double away(const Plant& plant, const Vec3& foot = Vec3::Zero()) {
    double most = 0;
    for (int i = 0; i < node_count_of(plant); i++)
        most = std::max(most, (node_place(plant, i) - foot - point(plant.nodes->modelled, i)).norm());
    return most / double(plant.size);
}

double total_energy(const Plant& plant) {
    const frond_energy energy = energy_of(plant, {0, -GRAVITY, 0});
    return energy.kinetic + energy.elastic + energy.gravity;
}

// Puts the cage's nodes elsewhere, by the function that hosts call.
template <class Place>
void put(Plant& plant, const Place& place) {
    std::vector<double> places;
    for (int i = 0; i < node_count_of(plant); i++) {
        const Vec3 p = place(Vec3(node_place(plant, i)));
        places.insert(places.end(), p.data(), p.data() + 3);
    }
    set_state(plant, places.data(), nullptr);
}

// Puts every free node at a random place.
void scramble(Plant& plant, double far, unsigned seed = 7) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-far, far);
    put(plant, [&](Vec3 p) {
        const bool is_free = p.y() > 0.05;
        for (int axis = 0; axis < 3; axis++) p[axis] += is_free ? number(random) : 0;
        return p;
    });
}

// Steps the plant for some seconds; returns all that was in trouble.
uint32_t live(Plant& plant, double seconds, const Surroundings& surroundings = earth()) {
    uint32_t trouble = 0;
    for (int i = 0; i < seconds / H; i++) {
        step_plant(plant, surroundings, H);
        trouble |= plant.trouble;
    }
    return trouble;
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
    EXPECT_TRUE(live(*plant, 2) & FROND_TROUBLE_RETRIED);
    EXPECT_LT(away(*plant), 0.02);
    EXPECT_EQ(plant->report.inverted, 0);
    EXPECT_TRUE(plastic_of(*plant).empty());
    live(*plant, 2);
    EXPECT_EQ(live(*plant, 1), 0u);
}

// Bent as far as a hand bends it, none of the guards acts.
TEST_P(EveryShape, FarBentIsLeftAlone) {
    const auto plant = stem(GetParam());
    Surroundings surroundings = earth();
    for (int i = 0; i < 60; i++) {
        surroundings.gravity = i < 30 ? Vec3(std::min(1.0, i / 10.0) * 5 * GRAVITY, -GRAVITY, 0) : Vec3(0, -GRAVITY, 0);
        step_plant(*plant, surroundings, H);
        EXPECT_EQ(plant->trouble & (FROND_TROUBLE_RETRIED | FROND_TROUBLE_REWOUND), 0u) << i;
        if (i == 29) {
            EXPECT_GT(away(*plant), 0.1);
        }
    }
}

// A law of all states, reachable or not: weight alone gives a plant no energy.
TEST_P(EveryShape, NoStepGainsEnergyAndAllComeBack) {
    for (unsigned seed = 1; seed <= 6; seed++) {
        const auto plant = stem(GetParam());
        scramble(*plant, 0.05 * seed, seed);
        const double first = total_energy(*plant);
        double before = total_energy(*plant);
        for (int i = 0; i < 60; i++) {
            step_plant(*plant, earth(), H);
            const double now = total_energy(*plant);
            EXPECT_LE(now - before, 1e-6 + 1e-8 * first) << seed << ' ' << i;
            before = now;
        }
        live(*plant, 2);
        EXPECT_LT(away(*plant), 0.001) << seed;
        EXPECT_EQ(plant->trouble, 0u) << seed;
    }
}

// The host's view of a plant: the places of all its cage nodes.
std::vector<Vec3> seen(const Plant& plant) {
    std::vector<Vec3> places;
    for (int i = 0; i < node_count_of(plant); i++) places.push_back(node_place(plant, i));
    return places;
}

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double most = 0;
    for (size_t i = 0; i < a.size(); i++) most = std::max(most, (a[i] - b[i]).norm());
    return most;
}

// Seen, it fades from where it was; in contact it is there at once, as bodies would collide with the rest of the old
// shape that is still visible. Whether a host reads places between steps makes no difference.
TEST_P(EveryShape, WhatIsFoldedAfterItsRecoveryStartsFromItsModelledShape) {
    constexpr double FADES = 0.01;  // way of a node in the first step of fading, over the plant's size [-]
    int starts = 0;
    for (unsigned seed = 1; seed <= 20; seed++)
        for (const bool is_touched : {false, true}) {
            const auto plant = stem(GetParam()), unread = stem(GetParam());
            for (Plant* each : {plant.get(), unread.get()}) scramble(*each, 0.8, seed);
            for (int i = 0; i < 100; i++) {
                const std::vector<Vec3> before = seen(*plant);
                for (Plant* each : {plant.get(), unread.get()}) {
                    each->state.is_touched = is_touched;  // by the world
                    step_plant(*each, earth(), H);
                }
                if (!(plant->trouble & FROND_TROUBLE_REWOUND)) continue;
                starts++;
                if (is_touched)
                    EXPECT_LT(away(*plant), 1e-12) << seed;
                else
                    EXPECT_LT(farthest(before, seen(*plant)), FADES * double(plant->size)) << seed;
            }
            EXPECT_EQ(seen(*plant), seen(*unread)) << seed;
        }
    // Neo-Hookean tets and rods unfold by themselves.
    if (GetParam() == FROND_MECHANICS_TET_COROTATIONAL) {
        EXPECT_GT(starts, 0);
    }
}

// Sets that a host gives it and that no load can have left. In rods they are a shape as any other.
TEST_P(EveryShape, TetsComeBackFromWildSets) {
    if (mechanics(GetParam(), 1).moves_chain) return;
    const auto plant = stem(GetParam());
    step_plant(*plant, earth(), H);
    scramble(*plant, 0.4);
    const Mechanics& row = mechanics(plant->which, 1);
    const auto wild = row.copy(elements_of(*plant->system));
    for (int i = 0; i < 200; i++) row.flow(*wild, plant->state.motion.x, H);
    set_plastic(*plant, row.get_plastic(*wild));
    ASSERT_FALSE(plastic_of(*plant).empty());
    EXPECT_TRUE(live(*plant, 4) & FROND_TROUBLE_REWOUND);
    EXPECT_TRUE(plastic_of(*plant).empty());
    EXPECT_LT(away(*plant), 0.005);
}

TEST_P(EveryShape, GoesAlongWithAFootThatIsPutElsewhere) {
    const auto plant = stem(GetParam());
    const Vec3 way(7, 1, -2);
    for (int i = 0; i < node_count_of(*plant); i++)
        if (is_pinned(*plant, i)) move_pin(*plant, i, node_place(*plant, i) + way);
    step_plant(*plant, earth(), H);
    EXPECT_LT(away(*plant, way), 0.02);
}

// Under a pull of 1e5 times its weight searches end where their work is done, and the plant comes back from there.
TEST_P(EveryShape, StepsThatNothingBearsTakeLimitedWork) {
    constexpr int MOST = 1300;  // of a step: three searches and the last iteration of each [force evaluations]
    const auto plant = stem(GetParam());
    Surroundings surroundings;
    surroundings.gravity = {0, -1e5 * GRAVITY, 1e5 * GRAVITY};
    int most = 0;
    for (int i = 0; i < 30; i++) {
        step_plant(*plant, surroundings, H);
        most = std::max(most, plant->report.work);
    }
    EXPECT_LE(most, MOST);
    live(*plant, 4);
    EXPECT_LT(away(*plant), 0.02);
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
    EXPECT_EQ(live(*plant, 4) & FROND_TROUBLE_REWOUND, 0u);
    EXPECT_GT(away(*plant), 0.15);
}

}  // namespace guard_tests

}  // namespace frond::test
