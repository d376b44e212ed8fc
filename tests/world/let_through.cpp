// A car-sized kinematic box that drives through corn, and a walker that walks over it: the plants are pushed by no more
// than they bear, let the car through before a step gets expensive, and stand as before afterwards.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "frond/frond_snapshot.h"
#include "support/stand.hpp"

namespace let_through_tests {

using frond::test::capsule_lengths;
using frond::test::most_drawn_out;
using frond::test::must;
using frond::test::Stand;

constexpr double H = 1.0 / 60, SPEED = 20, FAR_OFF = 4;  // [s], [m/s], [m]

// Returns what a body is led by, at its first place.
frond_rigid_def led_def(frond_shape shape, frond_vec3 size, frond_vec3 position) {
    frond_rigid_def def = frond_default_rigid_def();
    def.shape = shape;
    def.size = size;
    def.mass = 0;
    def.state.position = position;
    return def;
}

struct Crash : Stand {
    frond_rigid box = {};
    frond_rigid_state at = {};
    uint32_t trouble = 0;
    int most_contacts = 0;
    double most_drawn = 0;                     // length of a capsule over its first one [-]
    std::vector<std::vector<double>> lengths;  // of each plant's capsules, as modelled [m]

    explicit Crash(int count, bool yields = true) {
        load_corn();
        frond_plant_def of_all = plant_def();
        if (!yields) of_all.effects &= ~FROND_EFFECT_PLASTICITY;
        for (int i = 0; i < count; i++) add(of_all, {0.6 * i, 0, i % 2 * 0.5}, 0.7 * i);
        const frond_rigid_def def = led_def(FROND_SHAPE_BOX, {2.25, 0.75, 0.9}, {-FAR_OFF, 0.9, 0});
        at = def.state;
        must(frond_rigid_create(world, &def, &box));
        for (const frond_plant plant : plants) lengths.push_back(capsule_lengths(plant));
    }
    void drive(double speed) {
        at.position.x += speed * H;
        must(frond_rigid_set_state(box, &at));
        steps(1);
        trouble |= report().trouble;
        int contacts = 0;
        for (const frond_plant plant : plants) contacts += frond_plant_get_contact_count(plant);
        most_contacts = std::max(most_contacts, contacts);
        for (size_t i = 0; i < plants.size(); i++)
            most_drawn = std::max(most_drawn, most_drawn_out(plants[i], lengths[i]));
    }
    // Returns whether the box, not another plant, touches a plant.
    bool is_touched(frond_plant plant) const {
        std::vector<frond_contact> contacts(size_t(frond_plant_get_contact_count(plant)));
        must(frond_plant_get_contacts(plant, contacts.data(), int(contacts.size())));
        return std::any_of(contacts.begin(), contacts.end(),
                           [](const frond_contact& contact) { return !frond_plant_is_valid(contact.other); });
    }
    uint64_t hash() const {
        uint64_t hash = 0;
        must(frond_world_get_state_hash(world, &hash));
        return hash;
    }
    double tip(size_t plant) const {
        frond_vec3 tip = {};
        must(frond_plant_get_tip(plants[plant], &tip));
        return tip.y;
    }
};

// Corn that does not yield stands as before; other corn stays bent, but stands.
TEST(LetThrough, ACarDrivesThroughCornThatStandsAfterwards) {
    struct Case {
        double speed;  // [m/s]
        bool yields;
        double lower;  // share of its height [-]
    };
    for (const Case& drive : {Case{0.5 * SPEED, false, 0.005}, {SPEED, false, 0.005}, {SPEED, true, 0.15}}) {
        Crash crash(4, drive.yields);
        std::vector<double> tips;
        for (size_t i = 0; i < crash.plants.size(); i++) tips.push_back(crash.tip(i));
        while (crash.at.position.x < FAR_OFF + 2) crash.drive(drive.speed);
        const uint32_t expected = FROND_TROUBLE_PASSED | (drive.speed == SPEED ? FROND_TROUBLE_CROWDED : 0);
        EXPECT_EQ(crash.trouble & expected, expected);
        std::printf("at most %d contacts, capsules of %.3f their length\n", crash.most_contacts, crash.most_drawn);
        EXPECT_LT(crash.most_contacts, 900);
        EXPECT_LT(crash.most_drawn, 4) << drive.speed;
        crash.steps(240);
        for (size_t i = 0; i < tips.size(); i++) EXPECT_NEAR(crash.tip(i) / tips[i], 1, drive.lower) << i;
    }
}

// A stem that a car drives over slides along the car's lower edge.
struct DrivenOver : testing::TestWithParam<frond_mechanics> {};
INSTANTIATE_TEST_SUITE_P(LetThrough, DrivenOver, testing::Values(FROND_MECHANICS_ROD, FROND_MECHANICS_TET_COROTATIONAL),
                         [](const auto& info) { return std::string(frond_mechanics_name(info.param)); });

TEST_P(DrivenOver, AStemKeepsItsLength) {
    for (const double young : {1e8, 1e9})
        for (const double speed : {1.0, 4.0, 10.0, 20.0}) {
            Stand stand;
            stand.make_stems({{-1, {0, 0, 0}, {0, 1.2, 0}, 0.01, 0.006}}, young);
            frond_plant_def plant_def = stand.plant_def();
            plant_def.mechanics = GetParam();
            const frond_plant plant = stand.add(plant_def, {0, 0, 0});
            const std::vector<double> lengths = capsule_lengths(plant);
            frond_rigid_def def = led_def(FROND_SHAPE_BOX, {1, 0.75, 0.9}, {-1.1, 0.9, 0});
            frond_rigid box = {};
            must(frond_rigid_create(stand.world, &def, &box));
            double drawn = 0, deep = 0;
            while (def.state.position.x < 1.6) {
                def.state.position.x += speed * H;
                must(frond_rigid_set_state(box, &def.state));
                stand.steps(1);
                drawn = std::max(drawn, most_drawn_out(plant, lengths));
                std::vector<frond_capsule> capsules(lengths.size());
                must(frond_plant_get_capsules(plant, capsules.data(), int(capsules.size())));
                for (const frond_capsule& c : capsules) {
                    const double in_front = def.size.x - std::abs(c.end.x - def.state.position.x),
                                 above = def.size.y - std::abs(c.end.y - def.state.position.y);
                    deep = std::max(deep, std::min(in_front, above));
                }
            }
            EXPECT_LT(deep, 0.01) << speed << " m/s, " << young << " Pa";
            EXPECT_LT(drawn, speed < 15 ? 1.06 : 1.5) << speed << " m/s, " << young << " Pa";
        }
}

TEST(LetThrough, WhatHasPassedIsTouchedAgain) {
    Crash crash(4);
    while (crash.at.position.x < FAR_OFF + 2) crash.drive(SPEED);
    crash.steps(60);
    int touched = 0;
    while (crash.at.position.x > FAR_OFF + 0.25) {
        crash.drive(-1);
        touched += crash.is_touched(crash.plants.back());
    }
    EXPECT_GT(touched, 10);
}

// Plants fall asleep in a car that is parked there; when it has left and comes back, they touch it.
TEST(LetThrough, IsForgottenInSleep) {
    Crash crash(3);
    while (crash.at.position.x < 1) crash.drive(SPEED);
    for (int i = 0; i < 60; i++) crash.drive(0);
    for (int i = 0; i < 3600 && crash.report().awake_count > 0; i++) crash.steps(1);
    ASSERT_EQ(crash.report().awake_count, 0);
    while (crash.at.position.x < FAR_OFF + 2) crash.drive(SPEED);
    crash.steps(60);
    int touched = 0;
    while (crash.at.position.x > FAR_OFF + 0.25) {
        crash.drive(-1);
        touched += crash.is_touched(crash.plants.back());
    }
    EXPECT_GT(touched, 10);
}

TEST(LetThrough, IsKeptBySnapshots) {
    Crash crash(4);
    while (!(crash.trouble & FROND_TROUBLE_CROWDED)) {
        ASSERT_LT(crash.at.position.x, FAR_OFF + 2);
        crash.drive(SPEED);
    }
    for (int i = 0; i < 2; i++) crash.drive(SPEED);
    std::vector<char> bytes(frond_world_get_snapshot_size(crash.world));
    must(frond_world_save(crash.world, bytes.data(), bytes.size()));
    const frond_rigid_state there = crash.at;
    for (int i = 0; i < 10; i++) crash.drive(SPEED);
    const uint64_t hash = crash.hash();
    must(frond_world_restore(crash.world, bytes.data(), bytes.size()));
    crash.at = there;
    for (int i = 0; i < 10; i++) crash.drive(SPEED);
    EXPECT_EQ(crash.hash(), hash);
}

// A walker's round end comes over the foot of corn, which cannot give way there: what else touches the plant is not
// pushed by as much in answer, its cage is not drawn out (8.5 times by any force), and it stands as before afterwards.
struct Walk {
    frond_mechanics mechanics;
    double aside;  // [m]
};
struct WalkedOver : testing::TestWithParam<Walk> {};
std::string walk_name(const testing::TestParamInfo<Walk>& info) {
    return std::string(frond_mechanics_name(info.param.mechanics)) + "_by_" +
           std::to_string(int(1000 * info.param.aside)) + "mm";
}
INSTANTIATE_TEST_SUITE_P(LetThrough, WalkedOver,
                         testing::Values(Walk{FROND_MECHANICS_ROD, 0}, Walk{FROND_MECHANICS_ROD, 0.03},
                                         Walk{FROND_MECHANICS_ROD, 0.08}, Walk{FROND_MECHANICS_TET_COROTATIONAL, 0},
                                         Walk{FROND_MECHANICS_TET_COROTATIONAL, 0.05}),
                         walk_name);

TEST_P(WalkedOver, TakesNoMoreThanItBearsAtItsFoot) {
    constexpr double WALKS = 1.3, MOST = 60;  // [m/s], [N s]
    Stand stand;
    stand.load_corn();
    frond_plant_def plant_def = stand.plant_def();
    plant_def.mechanics = GetParam().mechanics;
    plant_def.effects &= ~FROND_EFFECT_PLASTICITY;
    stand.add(plant_def, {0, 0, 0}, 0.7);
    const frond_plant plant = stand.plants[0];
    const std::vector<double> lengths = capsule_lengths(plant);
    frond_vec3 tip = {}, after = {};
    must(frond_plant_get_tip(plant, &tip));
    frond_rigid_def def = led_def(FROND_SHAPE_CAPSULE, {0.25, 0.65, 0}, {-1, 0.9, GetParam().aside});
    frond_rigid walker = {};
    must(frond_rigid_create(stand.world, &def, &walker));
    double most = 0, drawn = 0;
    while (def.state.position.x < 2) {
        def.state.position.x += WALKS * H;
        must(frond_rigid_set_state(walker, &def.state));
        stand.steps(1);
        std::vector<frond_contact> contacts(size_t(frond_plant_get_contact_count(plant)));
        must(frond_plant_get_contacts(plant, contacts.data(), int(contacts.size())));
        for (const frond_contact& c : contacts)
            most = std::max(most, std::hypot(c.impulse.x, c.impulse.y, c.impulse.z));
        drawn = std::max(drawn, most_drawn_out(plant, lengths));
    }
    std::printf("at most %.3g N s in a contact, capsules of %.3f their length\n", most, drawn);
    EXPECT_GT(most, 0);
    EXPECT_LT(most, MOST);
    EXPECT_LT(drawn, GetParam().mechanics == FROND_MECHANICS_ROD ? 1.02 : 1.6);
    stand.steps(300);
    must(frond_plant_get_tip(plant, &after));
    EXPECT_NEAR(std::hypot(after.x - tip.x, after.y - tip.y, after.z - tip.z), 0, 0.05);
}

// A car with a weight of its own drives through a sunflower: what is heavy pushes by no more than what is led.
TEST(LetThrough, AHeavyCarDrawsNothingOut) {
    Stand stand;
    const std::string file = std::string(FROND_SOURCE_DIR) + "/models/sunflower/sunflower.obj";
    frond_model_def model_def = frond_default_model_def();
    must(frond_model_load(file.c_str(), &model_def, &stand.model));
    const frond_plant plant = stand.add(stand.plant_def(), {0, 0, 0});
    const std::vector<double> lengths = capsule_lengths(plant);
    frond_rigid_def def = frond_default_rigid_def();
    def.shape = FROND_SHAPE_PLANE;
    frond_rigid ground = {}, car = {};
    must(frond_rigid_create(stand.world, &def, &ground));
    def.shape = FROND_SHAPE_BOX;
    def.size = {2, 0.7, 0.9};
    def.mass = 1200;
    def.friction = 0.2;
    def.state.position = {-4, 0.72, 0};
    def.state.velocity = {SPEED, 0, 0};
    must(frond_rigid_create(stand.world, &def, &car));
    double drawn = 0;
    for (int i = 0; i < 30; i++) {
        stand.steps(1);
        drawn = std::max(drawn, most_drawn_out(plant, lengths));
    }
    std::printf("capsules of %.3f their length\n", drawn);
    EXPECT_LT(drawn, 1.5);
}

}  // namespace let_through_tests
