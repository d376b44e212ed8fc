// Snapshots: a restored world repeats its motion, to the bit; bytes that are not from such a world change nothing.
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

#include "frond/frond_snapshot.h"
#include "support/stems.hpp"

namespace snapshot_tests {

constexpr double H = 1.0 / 60;

// Plants of all mechanics, some overlapping, in gusts; a ball flies among them onto the ground, a box falls beside
// them, and a plant is bonded to a fixed box.
struct Garden {
    frond_world world = {};
    frond_model model = {};
    std::vector<frond_plant> plants;
    std::vector<frond_rigid> rigids;
    frond_grab grab = {};
    frond_bond bond = {};

    explicit Garden(int count = 6, double spacing = 0.12) {
        const frond_world_def def = frond_default_world_def();
        EXPECT_EQ(frond_world_create(&def, &world), FROND_OK);
        model = make_small_model(0, FROND_REST_STANDS_AS_MODELLED);
        for (int i = 0; i < count; i++) {
            frond_plant_def plant_def = frond_default_plant_def();
            plant_def.mechanics = frond_mechanics(i % FROND_MECHANICS_COUNT);
            plant_def.position = {spacing * (i % 3), 0, 0.3 * (i / 3)};
            plant_def.tuning.max_substeps = i == 1 ? 4 : 1;
            plants.emplace_back();
            EXPECT_EQ(frond_plant_create(world, model, &plant_def, &plants.back()), FROND_OK) << frond_last_error();
        }
        add(FROND_SHAPE_PLANE, {0, 0, 0}, 0, {});
        add(FROND_SHAPE_SPHERE, {-0.5, 0.4, 0}, 0.4, {4, 1, 0});
        add(FROND_SHAPE_BOX, {1, 0.6, 1}, 2, {0, -1, 0});
        add(FROND_SHAPE_BOX, {0.3, 0.5, 0.7}, 0, {});
        EXPECT_EQ(frond_grab_create(plants[0], {0, 0.6, 0}, 20, &grab), FROND_OK);
        EXPECT_EQ(frond_bond_create(plants.back(), {0.2, 0.45, 0.3}, rigids.back(), &bond), FROND_OK);
        frond_wind_def wind = frond_default_wind_def();
        wind.velocity = {6, 0, 0};
        EXPECT_EQ(frond_world_set_wind(world, &wind), FROND_OK);
    }
    ~Garden() {
        frond_world_destroy(world);
        frond_model_destroy(model);
    }
    void add(frond_shape shape, frond_vec3 place, double mass, frond_vec3 velocity) {
        frond_rigid_def def = frond_default_rigid_def();
        def.shape = shape;
        def.mass = mass;
        def.state.position = place;
        def.state.velocity = velocity;
        rigids.emplace_back();
        EXPECT_EQ(frond_rigid_create(world, &def, &rigids.back()), FROND_OK);
    }
    uint64_t hash() const {
        uint64_t value = 0;
        EXPECT_EQ(frond_world_get_state_hash(world, &value), FROND_OK);
        for (frond_rigid rigid : rigids) {
            frond_rigid_state state;
            EXPECT_EQ(frond_rigid_get_state(rigid, &state), FROND_OK);
            for (double number :
                 {state.position.x, state.position.y, state.position.z, state.velocity.y, state.angular_velocity.x}) {
                uint64_t bits;
                std::memcpy(&bits, &number, sizeof bits);
                value = value * 31 + bits;
            }
        }
        return value;
    }
    // Steps, and returns the hash after each step.
    std::vector<uint64_t> run(int steps, bool pull = true) {
        std::vector<uint64_t> hashes;
        for (int i = 0; i < steps; i++) {
            if (pull) {
                EXPECT_EQ(frond_grab_move(grab, {0.1 + 0.002 * i, 0.55, 0}), FROND_OK);
            }
            EXPECT_EQ(frond_world_step(world, H), FROND_OK) << frond_last_error();
            hashes.push_back(hash());
        }
        return hashes;
    }
    std::vector<char> save() const {
        std::vector<char> bytes(frond_world_get_snapshot_size(world));
        EXPECT_GT(bytes.size(), 0u) << frond_last_error();
        EXPECT_EQ(frond_world_save(world, bytes.data(), bytes.size()), FROND_OK) << frond_last_error();
        return bytes;
    }
    frond_result restore(const std::vector<char>& bytes) const {
        return frond_world_restore(world, bytes.data(), bytes.size());
    }
};

TEST(Snapshot, AfterGoingBackStepsGiveTheSameBits) {
    Garden garden;
    garden.run(5);
    frond_report report = {};
    ASSERT_EQ(frond_world_get_report(garden.world, &report), FROND_OK);
    EXPECT_GT(report.plant_contact_count, 0);
    const std::vector<char> bytes = garden.save();
    const uint64_t before = garden.hash();
    int contacts = 0;
    std::vector<uint64_t> first;
    for (int i = 0; i < 60; i++) {
        first.push_back(garden.run(1).front());
        ASSERT_EQ(frond_world_get_report(garden.world, &report), FROND_OK);
        contacts += report.contact_count;
    }
    EXPECT_GT(contacts, 0);
    ASSERT_EQ(garden.restore(bytes), FROND_OK) << frond_last_error();
    EXPECT_EQ(garden.hash(), before);
    for (int i = 0; i < 60; i++) ASSERT_EQ(garden.run(1).front(), first[size_t(i)]) << "step " << i;
}

TEST(Snapshot, FitsAnotherWorldThatWasMadeTheSameWay) {
    Garden one, other;
    one.run(30);
    const std::vector<char> bytes = one.save();
    other.run(7);
    ASSERT_EQ(other.restore(bytes), FROND_OK) << frond_last_error();
    EXPECT_EQ(one.run(60), other.run(60));
}

// A kinematic body that was not there in the last substep has come from nowhere, and does not sweep what is between.
TEST(Snapshot, KnowsWhichBodiesWereThere) {
    Garden one(1), other(1);
    const auto push = [](Garden& garden, double x) {
        frond_rigid_state state = {};
        EXPECT_EQ(frond_rigid_get_state(garden.rigids.back(), &state), FROND_OK);
        state.position = {x, 0.2, 0};
        EXPECT_EQ(frond_rigid_set_state(garden.rigids.back(), &state), FROND_OK);
        return garden.run(1, false).front();
    };
    for (Garden* garden : {&one, &other}) garden->add(FROND_SHAPE_SPHERE, {-0.4, 0.2, 0}, 0, {});
    push(one, -0.3);
    push(one, -0.25);
    const std::vector<char> bytes = one.save();
    ASSERT_EQ(other.restore(bytes), FROND_OK) << frond_last_error();
    for (const double x : {-0.05, 0.1}) EXPECT_EQ(push(one, x), push(other, x)) << x;
}

TEST(Snapshot, HoldsAPinThatWasLetGoSince) {
    Garden garden(4);
    const frond_plant rod = garden.plants[3];  // holds one node by a spring
    const int node = frond_plant_get_node_count(rod) - 1;
    ASSERT_EQ(frond_plant_pin(rod, node), FROND_OK);
    garden.run(10);
    const std::vector<char> bytes = garden.save();
    const std::vector<uint64_t> pinned = garden.run(30);
    ASSERT_EQ(garden.restore(bytes), FROND_OK) << frond_last_error();
    ASSERT_EQ(frond_plant_unpin(rod, node), FROND_OK);
    EXPECT_NE(garden.run(30), pinned);
    ASSERT_EQ(garden.restore(bytes), FROND_OK) << frond_last_error();
    EXPECT_EQ(garden.run(30), pinned);
}

// Velocity changes over so short a time exceed all possible rates.
TEST(Snapshot, IsTakenBackAfterAStepOfNextToNoTime) {
    Garden garden(2);
    garden.run(30);
    ASSERT_EQ(frond_world_step(garden.world, 1e-30), FROND_OK);
    ASSERT_EQ(garden.restore(garden.save()), FROND_OK) << frond_last_error();
}

TEST(Snapshot, SavingTwiceGivesTheSameBytes) {
    Garden garden;
    garden.run(20);
    garden.save();
    EXPECT_EQ(garden.save(), garden.save());
}

TEST(Snapshot, WhatSleptSleepsAgain) {
    Garden garden(3, 0.4);  // apart: plants that lean on each other creep for long
    ASSERT_EQ(frond_world_set_wind(garden.world, nullptr), FROND_OK);
    frond_grab_destroy(garden.grab);
    int sleeping = 0;
    for (int i = 0; i < 3000 && sleeping == 0; i++) {
        garden.run(1, false);
        for (frond_plant plant : garden.plants) sleeping += !frond_plant_is_awake(plant);
    }
    ASSERT_GT(sleeping, 0);
    const std::vector<char> bytes = garden.save();
    const std::vector<uint64_t> first = garden.run(30, false);
    for (frond_plant plant : garden.plants) ASSERT_EQ(frond_plant_wake(plant), FROND_OK);
    ASSERT_EQ(garden.restore(bytes), FROND_OK) << frond_last_error();
    for (frond_plant plant : garden.plants) sleeping -= !frond_plant_is_awake(plant);
    EXPECT_EQ(sleeping, 0);
    EXPECT_EQ(garden.run(30, false), first);
}

TEST(Snapshot, GoesBackOverOtherMechanicsAndDetail) {
    Garden garden;
    ASSERT_EQ(frond_world_set_viewer(garden.world, {0, 1, 40}), FROND_OK);
    garden.run(30);
    const std::vector<char> bytes = garden.save();
    const std::vector<uint64_t> first = garden.run(20);
    ASSERT_EQ(frond_plant_set_mechanics(garden.plants[2], FROND_MECHANICS_TET_LINEAR), FROND_OK);
    ASSERT_EQ(frond_world_set_viewer(garden.world, {0, 1, 1}), FROND_OK);
    garden.run(20);
    ASSERT_EQ(frond_world_set_viewer(garden.world, {0, 1, 40}), FROND_OK);
    ASSERT_EQ(garden.restore(bytes), FROND_OK) << frond_last_error();
    EXPECT_EQ(garden.run(20), first);
}

// What touched at the time of the other mechanics is of points that no longer move the plant.
TEST(Snapshot, IsTakenRightAfterAChangeOfMechanics) {
    for (frond_mechanics becomes : {FROND_MECHANICS_ROD, FROND_MECHANICS_TET_COROTATIONAL}) {
        Garden garden;
        garden.run(5);
        frond_report report = {};
        ASSERT_EQ(frond_world_get_report(garden.world, &report), FROND_OK);
        ASSERT_GT(report.plant_contact_count, 0);
        for (frond_plant plant : garden.plants) ASSERT_EQ(frond_plant_set_mechanics(plant, becomes), FROND_OK);
        const std::vector<char> bytes = garden.save();
        const std::vector<uint64_t> first = garden.run(20);
        ASSERT_EQ(garden.restore(bytes), FROND_OK) << frond_last_error();
        EXPECT_EQ(garden.run(20), first);
    }
}

TEST(Snapshot, GoesBackToWhatWasBentForGood) {
    Garden garden(1);
    for (int i = 0; i < 60; i++) {
        ASSERT_EQ(frond_grab_move(garden.grab, {0.55, 0.2, 0}), FROND_OK);
        garden.run(1, false);
    }
    ASSERT_GT(frond_plant_get_plastic_count(garden.plants[0]), 0);
    const std::vector<char> bytes = garden.save();
    const std::vector<uint64_t> first = garden.run(20);
    ASSERT_EQ(frond_plant_set_plastic(garden.plants[0], nullptr, 0), FROND_OK);
    ASSERT_EQ(garden.restore(bytes), FROND_OK) << frond_last_error();
    EXPECT_EQ(garden.run(20), first);
}

TEST(Snapshot, GoesBackWithWhatBrokeOff) {
    Garden garden(2);
    garden.run(5);
    ASSERT_EQ(frond_plant_break(garden.plants[0], frond_plant_get_capsule_count(garden.plants[0]) - 2), FROND_OK)
        << frond_last_error();
    garden.run(10);
    const std::vector<char> bytes = garden.save();
    const std::vector<uint64_t> first = garden.run(30);
    ASSERT_EQ(garden.restore(bytes), FROND_OK) << frond_last_error();
    EXPECT_EQ(garden.run(30), first);
    ASSERT_EQ(frond_plant_reset(garden.plants[0]), FROND_OK);
    EXPECT_EQ(garden.restore(bytes), FROND_RESULT_BAD_ARGUMENT);
}

// A plant that is broken may have gone over to any mechanics, or away to where it sways as modes, by itself.
TEST(Snapshot, GoesBackToTheMechanicsOfWhatIsBroken) {
    for (int which = 0; which < FROND_MECHANICS_COUNT; which++)
        for (const int pause : {0, 5}) {
            Garden garden(FROND_MECHANICS_COUNT);
            frond_plant plant = garden.plants[size_t(which)];
            garden.run(5);
            ASSERT_EQ(frond_plant_break(plant, frond_plant_get_capsule_count(plant) - 2), FROND_OK)
                << frond_last_error();
            garden.run(pause);
            const std::vector<char> bytes = garden.save();
            const std::vector<uint64_t> first = garden.run(20);
            for (int other = 0; other < FROND_MECHANICS_COUNT; other++) {
                ASSERT_EQ(frond_plant_set_mechanics(plant, frond_mechanics(other)), FROND_OK) << frond_last_error();
                garden.run(4);
                ASSERT_EQ(garden.restore(bytes), FROND_OK) << frond_last_error();
                EXPECT_EQ(garden.run(20), first) << which << " to " << other;
            }
            ASSERT_EQ(frond_world_set_viewer(garden.world, {0, 1, 400}), FROND_OK);
            garden.run(10);
            const std::vector<char> afar = garden.save();
            const std::vector<uint64_t> second = garden.run(20);
            ASSERT_EQ(frond_world_set_viewer(garden.world, {0, 1, 1}), FROND_OK);
            garden.run(5);
            ASSERT_EQ(frond_world_set_viewer(garden.world, {0, 1, 400}), FROND_OK);
            ASSERT_EQ(garden.restore(afar), FROND_OK) << frond_last_error();
            EXPECT_EQ(garden.run(20), second) << which << " from afar";
        }
}

TEST(Snapshot, MakesWholeWhatBrokeSince) {
    Garden garden(3);
    garden.run(5);
    const std::vector<char> bytes = garden.save();
    const std::vector<uint64_t> first = garden.run(20);
    ASSERT_EQ(garden.restore(bytes), FROND_OK) << frond_last_error();
    for (const int plant : {0, 2}) {
        const frond_plant broken = garden.plants[size_t(plant)];
        ASSERT_EQ(frond_plant_break(broken, frond_plant_get_capsule_count(broken) - 2), FROND_OK) << frond_last_error();
        garden.run(7);
    }
    ASSERT_EQ(garden.restore(bytes), FROND_OK) << frond_last_error();
    EXPECT_EQ(frond_plant_get_fragment_count(garden.plants[0]), 0);
    EXPECT_EQ(garden.run(20), first);

    // What was made since the plant broke would change its place among Bullet's objects.
    ASSERT_EQ(frond_plant_break(garden.plants[0], frond_plant_get_capsule_count(garden.plants[0]) - 2), FROND_OK);
    garden.add(FROND_SHAPE_BOX, {2, 0.5, 0}, 0, {});
    EXPECT_EQ(garden.restore(bytes), FROND_RESULT_BAD_ARGUMENT);
}

TEST(Snapshot, JoinsOnlyWhatBrokeSince) {
    for (int which = 0; which < FROND_MECHANICS_COUNT; which++) {
        Garden garden(FROND_MECHANICS_COUNT);
        frond_plant plant = garden.plants[size_t(which)];
        const int capsules = frond_plant_get_capsule_count(plant);
        garden.run(5);
        ASSERT_EQ(frond_plant_break(plant, capsules - 2), FROND_OK) << frond_last_error();
        garden.run(5);
        const std::vector<char> bytes = garden.save();
        const std::vector<uint64_t> first = garden.run(20);
        ASSERT_EQ(frond_plant_break(plant, capsules - 4), FROND_OK) << frond_last_error();
        garden.run(7);
        ASSERT_EQ(frond_plant_break(plant, 1), FROND_OK) << frond_last_error();
        garden.run(7);
        ASSERT_EQ(garden.restore(bytes), FROND_OK) << which << ": " << frond_last_error();
        EXPECT_EQ(frond_plant_get_fragment_count(plant), 1);
        EXPECT_EQ(garden.run(20), first) << which;
    }
}

// For every kind of wrong bytes: a code, a text, and an unchanged world.
struct Refused : testing::Test {
    Garden garden{2};
    std::vector<char> bytes;
    uint64_t before = 0;
    void SetUp() override {
        garden.run(10);
        bytes = garden.save();
        garden.run(3);
        before = garden.hash();
    }
    void refuse(const std::vector<char>& wrong, frond_result code, const char* word) {
        EXPECT_EQ(garden.restore(wrong), code);
        EXPECT_NE(std::strstr(frond_last_error(), word), nullptr) << frond_last_error();
        EXPECT_EQ(garden.hash(), before);
    }
};

TEST_F(Refused, WhenCutOff) {
    for (size_t size : {size_t(1), size_t(20), bytes.size() / 2, bytes.size() - 1})
        refuse(std::vector<char>(bytes.begin(), bytes.begin() + long(size)), FROND_RESULT_FILE_FORMAT,
               "pass all of it");
    bytes.push_back(0);
    refuse(bytes, FROND_RESULT_FILE_FORMAT, "no more");
}

TEST_F(Refused, WhenDamaged) {
    std::mt19937 random(1);
    for (int i = 0; i < 200; i++) {
        std::vector<char> wrong = bytes;
        wrong[random() % wrong.size()] ^= char(1 << random() % 8);
        EXPECT_EQ(garden.restore(wrong), FROND_RESULT_FILE_FORMAT) << i;
    }
    EXPECT_EQ(garden.hash(), before);
}

TEST_F(Refused, WhenOfAnotherVersion) {
    bytes[8] ^= 1;
    refuse(bytes, FROND_RESULT_FILE_FORMAT, "another version");
}

TEST_F(Refused, WhenNoSnapshotAtAll) {
    refuse(std::vector<char>(1000, 'x'), FROND_RESULT_FILE_FORMAT, "not a snapshot");
    EXPECT_EQ(frond_world_restore(garden.world, nullptr, 10), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_world_restore({}, bytes.data(), bytes.size()), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_world_save(garden.world, bytes.data(), 3), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_world_get_snapshot_size({}), 0u);
}

TEST_F(Refused, WhenOfAnotherWorld) {
    Garden more(3);
    refuse(more.save(), FROND_RESULT_BAD_ARGUMENT, "same ones");
    frond_plant_destroy(garden.plants.back());
    garden.plants.pop_back();
    before = garden.hash();
    refuse(bytes, FROND_RESULT_BAD_ARGUMENT, "plants");
}

TEST_F(Refused, WhenPlantsHaveOtherSettings) {
    frond_plant_destroy(garden.plants[1]);
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = FROND_MECHANICS_TET_COROTATIONAL;
    def.position = {5, 0, 0};
    ASSERT_EQ(frond_plant_create(garden.world, garden.model, &def, &garden.plants[1]), FROND_OK);
    ASSERT_EQ(frond_bond_create(garden.plants[1], {5, 0.3, 0}, garden.rigids.back(), &garden.bond), FROND_OK);
    before = garden.hash();
    refuse(bytes, FROND_RESULT_BAD_ARGUMENT, "another model, place or setting");
}

}  // namespace snapshot_tests
