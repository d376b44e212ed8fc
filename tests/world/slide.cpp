// A block slides down a straight stem, over the joints of its capsules, as down an inclined plane.
#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace slide_tests
}  // namespace frond::test
