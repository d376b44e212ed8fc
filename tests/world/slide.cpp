// A block slides down a straight stem, over the joints of its capsules, as down an inclined plane, and one that is led
// along a stem rubs on it as the law of friction says.
#include <gtest/gtest.h>

#include <cmath>

#include "support/stand.hpp"
#include "support/stems.hpp"

namespace frond::test {
namespace slide_tests {

constexpr double RADIUS = 0.02;  // of stems [m]

// Returns a stem from the origin, on which bodies have their own friction; without a modulus of its own it has that of
// the preset.
frond_model make_stem(const frond_vec3& end, double capsule_height, double young = 0) {
    frond_material material = {};
    must(frond_material_preset("stem", &material));
    if (young > 0) material.young = young;
    material.friction = 1;
    const frond_stem stem = {-1, {0, 0, 0}, end, RADIUS, RADIUS};
    return make_stems_of(&stem, 1, &material, FROND_REST_WITHOUT_GRAVITY, capsule_height);
}

struct Slide {
    double friction, h, capsule_height;
};
struct SlidingBlock : testing::TestWithParam<Slide> {};
INSTANTIATE_TEST_SUITE_P(EveryWay, SlidingBlock,
                         testing::Values(Slide{0, 1.0 / 60, 0}, Slide{0, 1.0 / 240, 0}, Slide{0, 1.0 / 60, 0.2},
                                         Slide{0, 1.0 / 240, 0.2}, Slide{0.3, 1.0 / 60, 0}, Slide{0.3, 1.0 / 240, 0},
                                         Slide{0.3, 1.0 / 60, 0.2}, Slide{0.3, 1.0 / 240, 0.2}));

TEST_P(SlidingBlock, IsAcceleratedAsOnAnInclinedPlane) {
    constexpr double ANGLE = 0.5236, LENGTH = 3, HALF = 0.03, FROM = 2.6, G = 9.81;
    const double sine = std::sin(ANGLE), cosine = std::cos(ANGLE);
    const Slide& slide = GetParam();

    // A stem that nothing bends: all of it is pinned.
    Stand stand;
    stand.h = slide.h;
    stand.model = make_stem({LENGTH * cosine, LENGTH * sine, 0}, slide.capsule_height);
    frond_plant_def plant_def = stand.plant_def();
    plant_def.mechanics = FROND_MECHANICS_ROD;
    const frond_plant plant = stand.add(plant_def, {0, 0, 0});
    for (int i = 0; i < frond_plant_get_node_count(plant); i++) must(frond_plant_pin(plant, i));

    frond_rigid_def block = frond_default_rigid_def();
    block.shape = FROND_SHAPE_BOX;
    block.size = {0.06, HALF, 0.06};
    block.mass = 0.5;
    block.friction = slide.friction;
    block.state.position = {FROM * cosine - (RADIUS + HALF) * sine, FROM * sine + (RADIUS + HALF) * cosine, 0};
    block.state.rotation = {0, 0, std::sin(ANGLE / 2), std::cos(ANGLE / 2)};
    frond_rigid rigid = {};
    must(frond_rigid_create(stand.world, &block, &rigid));

    // Its speed, once it has come to lie on the stem.
    const auto speed = [&] {
        frond_rigid_state state = {};
        must(frond_rigid_get_state(rigid, &state));
        return -(state.velocity.x * cosine + state.velocity.y * sine);
    };
    const int settled = int(std::lround(0.15 / slide.h)), rest = 3 * settled;
    stand.steps(settled);
    const double before = speed();
    stand.steps(rest);
    const double acceleration = (speed() - before) / (rest * slide.h);
    EXPECT_NEAR(acceleration / (G * (sine - slide.friction * cosine)), 1, 0.01);
}

// Forces of a body on a stem that is bent a little, along and across the capsules that it touches [N].
struct Push {
    double along = 0, across = 0;
};
Push push_on(const Stand& stand, frond_plant plant, double h) {
    std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plant)));
    must(frond_plant_get_capsules(plant, capsules.data(), int(capsules.size())));
    std::vector<frond_contact> contacts(size_t(frond_plant_get_contact_count(plant)));
    must(frond_plant_get_contacts(plant, contacts.data(), int(contacts.size())));
    Push push;
    for (const frond_contact& contact : contacts) {
        const frond_capsule& capsule = capsules[size_t(contact.capsule)];
        const double x = capsule.end.x - capsule.begin.x, y = capsule.end.y - capsule.begin.y;
        const double length = std::hypot(x, y), sign = x > 0 ? 1 : -1, substep = std::min(h, stand.h);
        push.along += sign * (contact.impulse.x * x + contact.impulse.y * y) / (length * substep);
        push.across += sign * (contact.impulse.x * y - contact.impulse.y * x) / (length * substep);
    }
    return push;
}

struct Led {
    frond_mechanics mechanics;
    double friction, h, speed;
};
struct LedBlock : testing::TestWithParam<Led> {};
std::vector<Led> every_lead() {
    std::vector<Led> all;
    for (const frond_mechanics mechanics : {FROND_MECHANICS_ROD, FROND_MECHANICS_TET_COROTATIONAL})
        for (const double friction : {0.0, 0.3, 0.8})
            for (const double h : {1.0 / 30, 1.0 / 60, 1.0 / 240})
                for (const double speed : {0.05, 0.3, -0.3}) all.push_back({mechanics, friction, h, speed});
    return all;
}
INSTANTIATE_TEST_SUITE_P(EveryWay, LedBlock, testing::ValuesIn(every_lead()));

TEST_P(LedBlock, RubsAsTheLawOfFrictionSays) {
    constexpr double HALF = 0.03, PRESSED = 0.005, NEAR = 0.4, FAR = 0.65;
    const Led& led = GetParam();
    Stand stand;
    stand.h = led.h;
    stand.model = make_stem({1, 0, 0}, 0.05, 1e9);
    frond_plant_def plant_def = stand.plant_def();
    plant_def.mechanics = led.mechanics;
    const frond_plant plant = stand.add(plant_def, {0, 0, 0});

    frond_rigid_def block = frond_default_rigid_def();
    block.shape = FROND_SHAPE_BOX;
    block.size = {0.06, HALF, 0.06};
    block.mass = 0;
    block.friction = led.friction;
    block.state.position = {led.speed > 0 ? NEAR : FAR, RADIUS + HALF + PRESSED, 0};
    frond_rigid rigid = {};
    must(frond_rigid_create(stand.world, &block, &rigid));
    frond_rigid_state state = block.state;
    const auto lead = [&](double x, double y) {
        state.position.x += x;
        state.position.y += y;
        must(frond_rigid_set_state(rigid, &state));
        stand.steps(1);
        return push_on(stand, plant, 1.0 / 60);
    };
    constexpr int SETTLING = 60;
    for (int i = 0; i < SETTLING; i++) lead(0, -2 * PRESSED / SETTLING);
    const int steps = int((FAR - NEAR) / (std::abs(led.speed) * led.h));
    Push sum;
    double worst = 0;
    for (int i = 0; i < steps; i++) {
        const Push push = lead(led.speed * led.h, 0);
        const double forwards = led.speed > 0 ? push.along : -push.along;
        sum.along += forwards;
        sum.across += push.across;
        if (i > 1) worst = std::max(worst, std::abs(forwards - led.friction * push.across));
    }
    EXPECT_GT(sum.across / steps, 1);
    EXPECT_NEAR(sum.along / sum.across, led.friction, 0.01);
    EXPECT_LT(worst, 0.15 * sum.across / steps);
}

}  // namespace slide_tests
}  // namespace frond::test
