// Points of plants bonded to bodies: they are carried, weigh on each other and conserve momentum.
#include <cmath>
#include <vector>

#include "frond/frond_bullet.hpp"
#include "support/stems.hpp"

namespace bond_tests {

frond_rigid add_body(frond_world world, double mass, frond_vec3 place, frond_vec3 velocity = {0, 0, 0}) {
    frond_rigid_def def = frond_default_rigid_def();
    def.size = {0.03, 0.03, 0.03};
    def.shape = FROND_SHAPE_BOX;
    def.mass = mass;
    def.state.position = place;
    def.state.velocity = velocity;
    frond_rigid body = {};
    EXPECT_EQ(frond_rigid_create(world, &def, &body), FROND_OK) << frond_last_error();
    return body;
}
frond_vec3 place_of(frond_rigid body) {
    frond_rigid_state state = {};
    EXPECT_EQ(frond_rigid_get_state(body, &state), FROND_OK);
    return state.position;
}
frond_vec3 held_by(frond_bond bond) {
    frond_vec3 point = {};
    EXPECT_EQ(frond_bond_get(bond, &point, nullptr), FROND_OK) << frond_last_error();
    return point;
}
double distance(const frond_vec3& a, const frond_vec3& b) {
    return std::hypot(a.x - b.x, std::hypot(a.y - b.y, a.z - b.z));
}
void step(frond_world world, int count) {
    for (int i = 0; i < count; i++) ASSERT_EQ(frond_world_step(world, 1.0 / 60), FROND_OK) << frond_last_error();
}

struct EveryBond : testing::TestWithParam<frond_mechanics> {
    frond_plant_def def(double root_height = 0) const {
        frond_plant_def def = frond_default_plant_def();
        def.mechanics = GetParam();
        def.root_height = root_height;
        return def;
    }
};
INSTANTIATE_TEST_SUITE_P(Bond, EveryBond, testing::Values(FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_ROD),
                         [](const auto& info) { return std::string(frond_mechanics_name(info.param)); });

// A weight hangs on a tip: the bond carries it and does not stretch.
TEST_P(EveryBond, BearsAWeight) {
    constexpr double MASS = 0.05;
    SmallWorld small(def(), 1e9);
    const frond_rigid weight = add_body(small.world, MASS, {0.25, 0.4, 0});
    frond_bond bond = {};
    ASSERT_EQ(frond_bond_create(small.plant, {0.2, 0.45, 0}, weight, &bond), FROND_OK) << frond_last_error();
    ASSERT_EQ(frond_plant_set_effects(small.plant, FROND_EFFECT_DEFAULT & ~uint32_t(FROND_EFFECT_RIGID_CONTACT)),
              FROND_OK);
    const frond_vec3 before = held_by(bond);
    const double apart = distance(before, place_of(weight));
    step(small.world, 300);
    // It keeps swinging: on average the force is its weight.
    constexpr int STEPS = 600;
    double mean = 0, height = 0;
    for (int i = 0; i < STEPS; i++) {
        step(small.world, 1);
        frond_vec3 force = {};
        ASSERT_EQ(frond_bond_get(bond, nullptr, &force), FROND_OK);
        mean += force.y / STEPS;
        height += held_by(bond).y / STEPS;
        EXPECT_NEAR(distance(held_by(bond), place_of(weight)), apart, 1e-3);
    }
    EXPECT_NEAR(mean, -MASS * 9.81, 0.02 * MASS * 9.81);
    EXPECT_LT(height, before.y - 1e-4);
    frond_bond_destroy(bond);
    step(small.world, 30);
    EXPECT_LT(place_of(weight).y, before.y - 0.3);
}

// A pot that is carried takes the plant along, which stands in it as before.
TEST_P(EveryBond, CarriesAPlant) {
    SmallWorld small(def(-1), 1e9);
    const frond_rigid pot = add_body(small.world, 0, {0, -0.03, 0});
    const frond_vec3 feet[] = {{0.02, 0, 0}, {-0.02, 0, 0}, {0, 0, 0.02}, {0, 0, -0.02}};
    for (const frond_vec3& foot : feet) {
        frond_bond bond = {};
        ASSERT_EQ(frond_bond_create(small.plant, foot, pot, &bond), FROND_OK) << frond_last_error();
    }
    ASSERT_EQ(frond_plant_set_effects(small.plant, FROND_EFFECT_DEFAULT & ~uint32_t(FROND_EFFECT_RIGID_CONTACT)),
              FROND_OK);
    step(small.world, 60);
    frond_vec3 before = {}, after = {};
    ASSERT_EQ(frond_plant_get_tip(small.plant, &before), FROND_OK);
    EXPECT_GT(before.y, 0.55);
    for (int i = 0; i < 120; i++) {
        frond_rigid_state state;
        ASSERT_EQ(frond_rigid_get_state(pot, &state), FROND_OK);
        state.position.x += 0.005;
        ASSERT_EQ(frond_rigid_set_state(pot, &state), FROND_OK);
        step(small.world, 1);
    }
    step(small.world, 240);
    ASSERT_EQ(frond_plant_get_tip(small.plant, &after), FROND_OK);
    EXPECT_NEAR(after.x - before.x, 0.6, 0.02);
    EXPECT_NEAR(after.y, before.y, 0.02);
}

// A body is bonded to a free plant while it flies.
TEST_P(EveryBond, KeepsMomentum) {
    constexpr double MASS = 0.2;
    SmallWorld small(def(-1), 1e8);
    ASSERT_EQ(frond_world_set_gravity(small.world, {0, 0, 0}), FROND_OK);
    ASSERT_EQ(frond_plant_set_effects(
                  small.plant, FROND_EFFECT_DEFAULT & ~uint32_t(FROND_EFFECT_RIGID_CONTACT | FROND_EFFECT_DAMPING)),
              FROND_OK);
    const frond_rigid body = add_body(small.world, MASS, {0.05, 0.6, 0}, {1, 0, 0.5});
    frond_bond bond = {};
    ASSERT_EQ(frond_bond_create(small.plant, {0.01, 0.6, 0}, body, &bond), FROND_OK) << frond_last_error();
    step(small.world, 60);
    frond_vec3 momentum = {};
    frond_rigid_state state = {};
    ASSERT_EQ(frond_plant_get_momentum(small.plant, &momentum), FROND_OK);
    ASSERT_EQ(frond_rigid_get_state(body, &state), FROND_OK);
    EXPECT_GT(momentum.x, 0.01);
    EXPECT_NEAR(momentum.x + MASS * state.velocity.x, MASS, 1e-6);
    EXPECT_NEAR(momentum.y + MASS * state.velocity.y, 0, 1e-6);
    EXPECT_NEAR(momentum.z + MASS * state.velocity.z, 0.5 * MASS, 1e-6);
}

// The roots of a corn plant are organs of their own, which begin beside its stem.
TEST(Bond, HoldsAllOrgansOfOneBody) {
    const frond_world_def world_def = frond_default_world_def();
    frond_world world = {};
    ASSERT_EQ(frond_world_create(&world_def, &world), FROND_OK);
    const frond_model_def model_def = frond_default_model_def();
    frond_model model = {};
    ASSERT_EQ(frond_model_load(FROND_SOURCE_DIR "/models/corn/corn.obj", &model_def, &model), FROND_OK);
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = FROND_MECHANICS_ROD;
    def.root_height = -1;
    def.effects &= ~uint32_t(FROND_EFFECT_RIGID_CONTACT);
    frond_plant plant = {};
    ASSERT_EQ(frond_plant_create(world, model, &def, &plant), FROND_OK) << frond_last_error();
    const frond_rigid hand = add_body(world, 0, {0, 0.3, 0});
    for (const frond_vec3& place : {frond_vec3{0, 0.2, 0}, frond_vec3{0.02, 0.3, 0}, frond_vec3{-0.02, 0.4, 0}}) {
        frond_bond bond = {};
        ASSERT_EQ(frond_bond_create(plant, place, hand, &bond), FROND_OK) << frond_last_error();
    }
    const int count = frond_plant_get_capsule_count(plant);
    std::vector<frond_capsule> before(static_cast<size_t>(count)), after = before;
    ASSERT_EQ(frond_plant_get_capsules(plant, before.data(), count), FROND_OK);
    step(world, 60);
    ASSERT_EQ(frond_plant_get_capsules(plant, after.data(), count), FROND_OK);
    double sunk = 0;
    for (size_t i = 0; i < before.size(); i++)
        if (before[i].begin.y < 0.05) sunk = std::max(sunk, before[i].begin.y - after[i].begin.y);
    EXPECT_LT(sunk, 0.02);
    frond_world_destroy(world);
    frond_model_destroy(model);
}

// A heavy body that falls on a bond, wherever it is bonded, draws a cage out no more than its rods.
TEST(Bond, DrawsOutACageAsItsRods) {
    constexpr int STEPS = 30, EVERY = 9;     // capsules
    constexpr double MASS = 5, MORE = 0.07;  // [kg], of a capsule's length [-]
    const frond_model_def model_def = frond_default_model_def();
    frond_model sunflower = {};
    ASSERT_EQ(frond_model_load(FROND_SOURCE_DIR "/models/sunflower/sunflower.obj", &model_def, &sunflower), FROND_OK);
    const auto capsules_of = [](frond_plant plant) {
        std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plant)));
        EXPECT_EQ(frond_plant_get_capsules(plant, capsules.data(), int(capsules.size())), FROND_OK);
        return capsules;
    };
    // Returns the largest length of a capsule over its own, of the plant that a body hangs on at the end of one.
    const auto drawn = [&](frond_mechanics mechanics, size_t at) {
        const frond_world_def world_def = frond_default_world_def();
        frond_world world = {};
        EXPECT_EQ(frond_world_create(&world_def, &world), FROND_OK);
        frond_plant_def def = frond_default_plant_def();
        def.mechanics = mechanics;
        def.effects = FROND_EFFECT_DEFAULT & ~uint32_t(FROND_EFFECT_RIGID_CONTACT);
        frond_plant plant = {};
        EXPECT_EQ(frond_plant_create(world, sunflower, &def, &plant), FROND_OK) << frond_last_error();
        const std::vector<frond_capsule> before = capsules_of(plant);
        frond_bond bond = {};
        const frond_rigid body = add_body(world, MASS, before[at].end);
        EXPECT_EQ(frond_bond_create(plant, before[at].end, body, &bond), FROND_OK) << frond_last_error();
        step(world, STEPS);
        const std::vector<frond_capsule> after = capsules_of(plant);
        double most = 0;
        for (size_t i = 0; i < before.size(); i++)
            most = std::fmax(most, distance(after[i].begin, after[i].end) / distance(before[i].begin, before[i].end));
        frond_world_destroy(world);
        return most;
    };
    for (size_t at = 0; at < 120; at += EVERY) {
        const double rods = drawn(FROND_MECHANICS_ROD, at);
        for (const frond_mechanics cage : {FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_TET_NEOHOOKEAN})
            EXPECT_LT(drawn(cage, at), rods + MORE) << frond_mechanics_name(cage) << " at capsule " << at;
    }
    frond_model_destroy(sunflower);
}

TEST(Bond, LetsGoWhenEitherSideIsGone) {
    SmallWorld small;
    const frond_rigid body = add_body(small.world, 0, {0, 0.63, 0});
    frond_bond bond = {}, other = {};
    ASSERT_EQ(frond_bond_create(small.plant, {0, 0.6, 0}, body, &bond), FROND_OK);
    step(small.world, 5);
    frond_rigid_destroy(body);
    step(small.world, 5);
    frond_vec3 force = {1, 1, 1};
    EXPECT_EQ(frond_bond_get(bond, nullptr, &force), FROND_OK);
    EXPECT_EQ(force.x, 0);
    EXPECT_EQ(force.y, 0);
    const frond_rigid second = add_body(small.world, 1, {0, 0.63, 0});
    ASSERT_EQ(frond_bond_create(small.plant, {0, 0.6, 0}, second, &other), FROND_OK);
    frond_plant_destroy(small.plant);
    EXPECT_FALSE(frond_bond_is_valid(bond));
    EXPECT_FALSE(frond_bond_is_valid(other));
    EXPECT_EQ(frond_bond_get(other, nullptr, nullptr), FROND_RESULT_BAD_HANDLE);
    frond_bond_destroy(other);
    step(small.world, 2);
}

TEST(Bond, RefusesWhatCannotBe) {
    SmallWorld small, elsewhere;
    const frond_rigid body = add_body(small.world, 1, {0, 0.63, 0}), far = add_body(elsewhere.world, 1, {0, 0.63, 0});
    frond_bond bond = {};
    EXPECT_EQ(frond_bond_create(small.plant, {0, NAN, 0}, body, &bond), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_bond_create(small.plant, {0, 0, 0}, far, &bond), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_bond_create(small.plant, {0, 0, 0}, body, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_bond_create({}, {0, 0, 0}, body, &bond), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_bond_create(small.plant, {0, 0, 0}, {}, &bond), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(bond.id, 0u);
    EXPECT_EQ(frond_bond_get(bond, nullptr, nullptr), FROND_RESULT_BAD_HANDLE);
    // The same holds in a host's world.
    EXPECT_EQ(frond::bond(small.plant, btVector3(0, 0, 0), nullptr, &bond), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond::bond(small.plant, btVector3(0, 0, 0), frond::bullet_object(small.plant), &bond),
              FROND_RESULT_BAD_ARGUMENT);
    auto* object = const_cast<btCollisionObject*>(static_cast<const btCollisionObject*>(frond_rigid_get_body(body)));
    EXPECT_EQ(frond::bond(small.plant, btVector3(0, 0, 0), object, &bond), FROND_OK) << frond_last_error();
    EXPECT_TRUE(frond_bond_is_valid(bond));
}

}  // namespace bond_tests
