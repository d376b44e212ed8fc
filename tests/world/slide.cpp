// A block slides down a straight stem, over the joints of its capsules, as down an inclined plane.
#include <gtest/gtest.h>

#include <cmath>

#include "frond/frond_robot.h"
#include "support/stand.hpp"

namespace frond::test {
namespace slide_tests {

struct Slide {
    double friction, h, capsule_height;
};
struct SlidingBlock : testing::TestWithParam<Slide> {};
INSTANTIATE_TEST_SUITE_P(EveryWay, SlidingBlock,
                         testing::Values(Slide{0, 1.0 / 60, 0}, Slide{0, 1.0 / 240, 0}, Slide{0, 1.0 / 60, 0.2},
                                         Slide{0, 1.0 / 240, 0.2}, Slide{0.3, 1.0 / 60, 0}, Slide{0.3, 1.0 / 240, 0},
                                         Slide{0.3, 1.0 / 60, 0.2}, Slide{0.3, 1.0 / 240, 0.2}));

TEST_P(SlidingBlock, IsAcceleratedAsOnAnInclinedPlane) {
    constexpr double ANGLE = 0.5236, RADIUS = 0.02, LENGTH = 3, HALF = 0.03, FROM = 2.6, G = 9.81;
    const double sine = std::sin(ANGLE), cosine = std::cos(ANGLE);
    const Slide& slide = GetParam();

    // A stem that nothing bends: all of it is pinned.
    Stand stand;
    stand.h = slide.h;
    frond_model_def def = frond_default_model_def();
    frond_organ_material organ = {"stem", {}};
    must(frond_material_preset("stem", &organ.material));
    organ.material.friction = 1;
    def.organs = &organ;
    def.organ_count = 1;
    def.scale = 1;
    def.up = {0, 1, 0};
    def.rest = FROND_REST_WITHOUT_GRAVITY;
    def.capsule_height = slide.capsule_height;
    const frond_stem stem = {-1, {0, 0, 0}, {LENGTH * cosine, LENGTH * sine, 0}, RADIUS, RADIUS};
    must(frond_model_from_stems(&stem, 1, &def, &stand.model));
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

// A block without friction that something leads along a stem, and that presses on it, pushes it across only: how far
// the stem is bent there decides how the push leans.
TEST(LedBlock, DoesNotCatchOnJoints) {
    constexpr double RADIUS = 0.02, HALF = 0.03, PRESSED = 0.005, SPEED = 0.1, FROM = 0.25, TO = 0.75;
    for (const double h : {1.0 / 60, 1.0 / 240}) {
        Stand stand;
        stand.h = h;
        frond_model_def def = frond_default_model_def();
        frond_organ_material organ = {"stem", {}};
        must(frond_material_preset("stem", &organ.material));
        organ.material.young = 1e9;
        def.organs = &organ;
        def.organ_count = 1;
        def.scale = 1;
        def.up = {0, 1, 0};
        def.rest = FROND_REST_WITHOUT_GRAVITY;
        def.capsule_height = 0.05;
        const frond_stem stem = {-1, {0, 0, 0}, {1, 0, 0}, RADIUS, RADIUS};
        must(frond_model_from_stems(&stem, 1, &def, &stand.model));
        frond_plant_def plant_def = stand.plant_def();
        plant_def.mechanics = FROND_MECHANICS_ROD;
        const frond_plant plant = stand.add(plant_def, {0, 0, 0});

        frond_rigid_def block = frond_default_rigid_def();
        block.shape = FROND_SHAPE_BOX;
        block.size = {0.06, HALF, 0.06};
        block.mass = 0;
        block.friction = 0;
        block.state.position = {FROM, RADIUS + HALF + PRESSED, 0};
        frond_rigid rigid = {};
        must(frond_rigid_create(stand.world, &block, &rigid));
        frond_rigid_state state = block.state;
        const auto lead = [&] {
            must(frond_rigid_set_state(rigid, &state));
            stand.steps(1);
        };
        for (double way = 0; way < 2 * PRESSED; way += 0.02 * h, state.position.y -= 0.02 * h) lead();

        double across = 0, most_along = 0;
        int steps = 0;
        for (; state.position.x < TO; state.position.x += SPEED * h, steps++) {
            lead();
            frond_vec3 force = {}, moment = {};
            must(frond_plant_get_root_force(plant, {0, 0, 0}, &force, &moment));
            across += std::abs(force.y);
            most_along = std::max(most_along, std::abs(force.x));
        }
        EXPECT_GT(across / steps, 10);
        EXPECT_LT(most_along, 0.3 * across / steps) << h;
    }
}

}  // namespace slide_tests
}  // namespace frond::test
