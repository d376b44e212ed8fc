// A ball that falls on a stem which nothing bends bounces to the square of its restitution times the height.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/stand.hpp"
#include "support/stems.hpp"

namespace frond::test {
namespace restitution_tests {

constexpr double BALL = 0.1, STEM = 0.05;

// Returns how high the ball rises again, over how far it fell.
double bounce(double of_stem, double of_ball, double h) {
    Stand stand;
    stand.h = h;
    frond_material material = {};
    must(frond_material_preset("stem", &material));
    material.restitution = of_stem;
    const frond_stem stem = {-1, {-0.5, 0, 0}, {0.5, 0, 0}, STEM, STEM};
    stand.model = make_stems_of(&stem, 1, &material, FROND_REST_WITHOUT_GRAVITY);
    frond_plant_def plant_def = stand.plant_def();
    plant_def.mechanics = FROND_MECHANICS_ROD;
    const frond_plant plant = stand.add(plant_def, {0, 0, 0});
    for (int i = 0; i < frond_plant_get_node_count(plant); i++) must(frond_plant_pin(plant, i));
    frond_rigid_def ball = frond_default_rigid_def();
    ball.size.x = BALL;
    ball.restitution = of_ball;
    const double rest = STEM + BALL, from = 1;
    ball.state.position = {0.02, rest + from, 0};
    frond_rigid rigid = {};
    must(frond_rigid_create(stand.world, &ball, &rigid));
    double highest = 0;
    bool has_met = false;
    for (double t = 0; t < 1.2; t += h) {
        stand.steps(1);
        frond_rigid_state state = {};
        must(frond_rigid_get_state(rigid, &state));
        has_met |= state.velocity.y > 0;
        if (has_met) highest = std::max(highest, state.position.y - rest);
        if (has_met && state.velocity.y < 0) break;
    }
    return highest / from;
}

TEST(Restitution, GivesTheHeightOfABounce) {
    for (const double e : {0.3, 0.6, 0.9}) {
        EXPECT_NEAR(bounce(1, e, 1.0 / 960), e * e, 0.03) << e;
        EXPECT_NEAR(bounce(e, 1, 1.0 / 960), e * e, 0.03) << e;
        EXPECT_NEAR(bounce(1, e, 1.0 / 60), e * e, 0.15) << e;
    }
}

// Whatever overlap the last step of the fall left: it parts slowly.
TEST(Restitution, OfNoughtIsNoBounce) {
    for (const double h : {1.0 / 60, 1.0 / 240, 1.0 / 960}) {
        EXPECT_LT(bounce(0, 1, h), 1e-3) << h;
        EXPECT_LT(bounce(1, 0, h), 1e-3) << h;
    }
}

TEST(Restitution, IsFromNoughtToOne) {
    Stand stand;
    frond_rigid_def ball = frond_default_rigid_def();
    frond_rigid rigid = {};
    for (const double wrong : {-0.1, 1.1, double(NAN)}) {
        ball.restitution = wrong;
        EXPECT_EQ(frond_rigid_create(stand.world, &ball, &rigid), FROND_RESULT_BAD_ARGUMENT);
    }
}

}  // namespace restitution_tests
}  // namespace frond::test
