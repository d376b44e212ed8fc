// Supports through all that happens to a plant, and calls that ask for what cannot be.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "frond/frond_snapshot.h"
#include "support/supported.hpp"

namespace frond::test {
namespace supports_kept_tests {

constexpr double LENGTH = 1;

frond_plant_def heavy(double mass_damping = 0.1) {
    frond_plant_def def = Supported::bare();
    def.effects |= FROND_EFFECT_GRAVITY;
    def.mass_damping = mass_damping;
    return def;
}
double length_of(const frond_vec3& v) {
    return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}
double distance(const frond_vec3& a, const frond_vec3& b) {
    return length_of({a.x - b.x, a.y - b.y, a.z - b.z});
}

// A stem on a hinge about z that swings, and one in a fork that bends.
struct Pair {
    Supported stem;
    frond_plant other = {};
    explicit Pair(bool is_supported = true) : stem({LENGTH, 0, 0}, 1e8, heavy()) {
        other = stem.add(heavy(), {0, 0, 1});
        if (!is_supported) return;
        stem.support(0, FROND_HELD_TURNS_ACROSS_AXIS);
        for (const int node : {0, stem.tip}) {
            const frond_support fork = {true, FROND_HELD_TURNS_ABOUT_AXIS, {1, 0, 0}};
            must(frond_plant_set_support(other, node, &fork));
        }
    }
    std::vector<uint64_t> run(int count) {
        std::vector<uint64_t> hashes;
        for (int i = 0; i < count; i++) {
            stem.steps(1);
            hashes.push_back(stem.hash());
        }
        return hashes;
    }
    std::vector<char> save() const {
        std::vector<char> bytes(frond_world_get_snapshot_size(stem.world));
        must(frond_world_save(stem.world, bytes.data(), bytes.size()));
        return bytes;
    }
    void restore(const std::vector<char>& bytes) const {
        must(frond_world_restore(stem.world, bytes.data(), bytes.size()));
    }
};

TEST(KeptSupports, ASnapshotKeepsThemAndStepsGiveTheSameBits) {
    Pair pair, fresh(false);
    pair.run(40);
    const std::vector<char> bytes = pair.save();
    const std::vector<uint64_t> first = pair.run(60);
    must(frond_plant_set_support(pair.stem.plant, 0, nullptr));
    pair.run(3);
    pair.restore(bytes);
    EXPECT_EQ(pair.run(60), first);
    fresh.run(7);
    fresh.restore(bytes);
    EXPECT_EQ(fresh.run(60), first);
    EXPECT_EQ(fresh.save(), pair.save());
}

TEST(KeptSupports, ASnapshotFromBeforeThemTakesThemAway) {
    Pair pair(false);
    const std::vector<char> bytes = pair.save();
    const std::vector<uint64_t> first = pair.run(10);
    pair.stem.support(0, FROND_HELD_TURNS_NONE);
    pair.restore(bytes);
    EXPECT_EQ(pair.run(10), first);
    EXPECT_EQ(frond_plant_get_support_force(pair.stem.plant, 0, nullptr, nullptr), FROND_RESULT_BAD_ARGUMENT);
}

TEST(KeptSupports, HoldANodeWhereItsStateIsSet) {
    Supported stem({LENGTH, 0, 0}, 1e9, heavy());
    stem.support(0, FROND_HELD_TURNS_ACROSS_AXIS);
    std::vector<frond_chain_state> states = stem.state();
    // Lifted, and turned by a right angle about y: x becomes -z.
    for (frond_chain_state& state : states) {
        state.position = {0, 2, -state.position.x};
        state.rotation = {0, std::sqrt(0.5), 0, std::sqrt(0.5)};
    }
    must(frond_plant_set_chain_state(stem.plant, states.data(), stem.tip + 1));
    stem.steps(60);
    // Its hinge is along it now, and bears it as a clamp does.
    const frond_chain_state root = stem.state(0), end = stem.state(stem.tip);
    EXPECT_NEAR(distance(root.position, {0, 2, 0}), 0, 1e-12);
    EXPECT_NEAR(distance(end.position, {0, 2, -1}), 0, 0.1);
    const frond_quat& q = root.rotation;
    EXPECT_NEAR(2 * (q.x * q.z - q.w * q.y), -1, 1e-12);
}

TEST(KeptSupports, GoAlongWithAPlantThatIsPutElsewhere) {
    Supported stem({LENGTH, 0, 0}, 1e9, heavy());
    stem.support(0, FROND_HELD_TURNS_ACROSS_AXIS);
    must(frond_plant_set_transform(stem.plant, {3, 1, 0}, {0, std::sqrt(0.5), 0, std::sqrt(0.5)}));
    stem.steps(30);
    const frond_chain_state end = stem.state(stem.tip);
    EXPECT_NEAR(distance(stem.state(0).position, {3, 1, 0}), 0, 1e-12);
    EXPECT_NEAR(end.position.x, 3, 1e-6);  // it swings about x now
    EXPECT_LT(end.position.y, 0.5);
}

TEST(KeptSupports, TakenAwayLeaveTheNodeToTheGroundWhereItIs) {
    frond_plant_def def = heavy(2);
    def.root_height = 0;
    Supported stem({0, LENGTH, 0}, 1e9, def);
    stem.steps(1);
    EXPECT_NEAR(stem.state(0).rotation.z, 0, 1e-9);
    stem.support(0, FROND_HELD_TURNS_NONE);
    stem.under(stem.tip, {1, 0, 0}, 20);
    const frond_chain_state turned = stem.state(0);
    EXPECT_LT(turned.rotation.z, -0.05);
    must(frond_plant_set_support(stem.plant, 0, nullptr));
    stem.steps(60);
    const frond_chain_state root = stem.state(0);
    EXPECT_NEAR(distance(root.position, turned.position), 0, 1e-9);
    EXPECT_NEAR(root.rotation.z, turned.rotation.z, 1e-6);
    must(frond_plant_reset(stem.plant));
    stem.steps(60);
    EXPECT_NEAR(stem.state(0).rotation.z, 0, 1e-9);
}

TEST(KeptSupports, ASupportThatHoldsNothingLetsAPlantFall) {
    frond_plant_def def = heavy(0);
    def.root_height = 0;
    Supported stem({0, LENGTH, 0}, 1e9, def);
    stem.support(0, FROND_HELD_TURNS_NONE, {0, 0, 0}, false);
    stem.steps(30);
    EXPECT_NEAR(stem.state(0).position.y, -0.5 * 9.81 * 0.25, 0.1);
}

TEST(KeptSupports, HoldAPlantThatSleepsAndIsWoken) {
    frond_world_def world_def = frond_default_world_def();
    Supported stem({0, -LENGTH, 0}, 1e9, heavy(2), 20, {}, world_def);
    stem.support(0, FROND_HELD_TURNS_ACROSS_AXIS);
    for (int i = 0; i < 600 && frond_plant_is_awake(stem.plant); i++) stem.steps(1);
    ASSERT_FALSE(frond_plant_is_awake(stem.plant));
    stem.under(stem.tip, {0.2, 0, 0.2}, 60);
    EXPECT_TRUE(frond_plant_is_awake(stem.plant));
    const frond_chain_state root = stem.state(0);
    EXPECT_NEAR(length_of(root.position), 0, 1e-12);
    EXPECT_GT(turn_about(root.rotation, {0, 0, 1}), 0.02);
    EXPECT_NEAR(turn_about(root.rotation, {1, 0, 0}), 0, 1e-6);
}

TEST(KeptSupports, HoldAStemThatABallHits) {
    Supported stem({0, -LENGTH, 0}, 1e8, heavy());
    stem.support(0, FROND_HELD_TURNS_ACROSS_AXIS);
    frond_rigid_def def = frond_default_rigid_def();
    def.mass = 0.2;
    def.size = {0.05, 0, 0};
    def.state.position = {-0.3, -0.6, -0.02};
    def.state.velocity = {4, 0, 0.3};
    frond_rigid ball = {};
    must(frond_rigid_create(stem.world, &def, &ball));
    double farthest = 0;
    for (int i = 0; i < 60; i++) {
        stem.steps(1);
        const frond_chain_state root = stem.state(0);
        EXPECT_NEAR(length_of(root.position), 0, 1e-12) << i;
        EXPECT_NEAR(turn_about(root.rotation, {1, 0, 0}), 0, 1e-6) << i;
        farthest = std::max(farthest, turn_about(root.rotation, {0, 0, 1}));
    }
    EXPECT_GT(farthest, 0.1);
}

TEST(KeptSupports, GoWithWhatBreaksOff) {
    Supported stem({LENGTH, 0, 0}, 1e9, heavy());
    stem.support(0, FROND_HELD_TURNS_ALL);
    stem.support(stem.tip, FROND_HELD_TURNS_NONE);
    stem.steps(2);
    must(frond_plant_break(stem.plant, 10));
    stem.steps(10);
    const frond_support ball = {true, FROND_HELD_TURNS_NONE, {0, 0, 0}};
    EXPECT_EQ(frond_plant_set_support(stem.plant, stem.tip, &ball), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_NE(std::strstr(frond_last_error(), "come off"), nullptr);
    EXPECT_EQ(frond_plant_get_support_force(stem.plant, stem.tip, nullptr, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_get_support_force(stem.plant, 0, nullptr, nullptr), FROND_OK);
}

TEST(KeptSupports, RefuseWhatCannotBeAndChangeNothing) {
    Supported stem({LENGTH, 0, 0}, 1e9, heavy()), untouched({LENGTH, 0, 0}, 1e9, heavy());
    for (Supported* s : {&stem, &untouched}) s->support(0, FROND_HELD_TURNS_ALL);
    constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [&](int node, const frond_support& support, const char* word) {
        EXPECT_EQ(frond_plant_set_support(stem.plant, node, &support), FROND_RESULT_BAD_ARGUMENT);
        EXPECT_NE(std::strstr(frond_last_error(), word), nullptr) << frond_last_error();
    };
    refused(-1, {true, FROND_HELD_TURNS_NONE, {}}, "chain_node");
    refused(stem.tip + 1, {true, FROND_HELD_TURNS_NONE, {}}, "chain_node");
    refused(0, {true, frond_held_turns(FROND_HELD_TURNS_COUNT), {}}, "held_turns");
    refused(0, {true, FROND_HELD_TURNS_ACROSS_AXIS, {0, 0, 0}}, "axis");
    refused(0, {true, FROND_HELD_TURNS_ABOUT_AXIS, {0, NOT_A_NUMBER, 0}}, "axis");
    EXPECT_EQ(frond_plant_set_support({}, 0, nullptr), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_plant_get_support_force({}, 0, nullptr, nullptr), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_plant_get_support_force(stem.plant, 1, nullptr, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_get_support_force(stem.plant, -1, nullptr, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_plant_set_mechanics(stem.plant, FROND_MECHANICS_TET_COROTATIONAL), FROND_RESULT_UNSUPPORTED);
    must(frond_plant_set_support(stem.plant, 5, nullptr));  // it has none
    for (int i = 0; i < 30; i++) {
        stem.steps(1);
        untouched.steps(1);
        ASSERT_EQ(stem.hash(), untouched.hash()) << i;
    }
    frond_plant_def tets = heavy();
    tets.mechanics = FROND_MECHANICS_TET_COROTATIONAL;
    const frond_plant cage = stem.add(tets, {0, 0, 2});
    const frond_support ball = {true, FROND_HELD_TURNS_NONE, {0, 0, 0}};
    EXPECT_EQ(frond_plant_set_support(cage, 0, &ball), FROND_RESULT_UNSUPPORTED);
    frond_plant_destroy(cage);
    EXPECT_EQ(frond_plant_set_support(cage, 0, &ball), FROND_RESULT_BAD_HANDLE);
}

}  // namespace supports_kept_tests
}  // namespace frond::test
