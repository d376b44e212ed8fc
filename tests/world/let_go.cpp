// A stem that is bent and let go has no speed before the step in which it springs back: what rests in its way is struck
// all the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/referee.hpp"
#include "support/sanitized.hpp"
#include "support/stand.hpp"

namespace let_go_tests {

using frond::test::must;
using frond::test::Stand;

constexpr double TALL = 1, THIN = 0.005, BALL = 0.025, HEIGHT = 0.85, BENT = 0.3;  // [m]

// A stem along y whose tip is drawn aside, towards -x, and a ball in its way back.
struct Sling : Stand {
    std::vector<int> held;
    frond_rigid ball = {};

    Sling(frond_mechanics mechanics, double young, double step) : Stand(frond::test::weightless(step)) {
        constexpr int STEPS = 60;
        h = step;
        make_stems({{-1, {0, 0, 0}, {0, TALL, 0}, THIN, THIN}}, young);
        frond_plant_def plant = plant_def();
        plant.mechanics = mechanics;
        plant.effects &= ~uint32_t(FROND_EFFECT_PLASTICITY);
        add(plant, {0, 0, 0});
        const std::vector<double> from = places(plants[0]);
        for (int i = 0; i < int(from.size() / 3); i++)
            if (from[size_t(3 * i + 1)] > 0.93 * TALL) {
                held.push_back(i);
                must(frond_plant_pin(plants[0], i));
            }
        for (int s = 1; s <= 2 * STEPS; s++) {
            for (const int i : held)
                must(frond_plant_move_pin(plants[0], i,
                                          {from[size_t(3 * i)] - BENT * std::min(s, STEPS) / STEPS,
                                           from[size_t(3 * i + 1)], from[size_t(3 * i + 2)]}));
            steps(1);
        }
    }
    // Returns where the stem's axis is at that height; negative infinity beside the stem [m].
    double stem_at(double height) const {
        std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plants[0])));
        must(frond_plant_get_capsules(plants[0], capsules.data(), int(capsules.size())));
        for (const auto& [begin, end, radius] : capsules)
            if ((begin.y - height) * (end.y - height) <= 0 && std::abs(begin.z) < BALL)
                return begin.x + (height - begin.y) / (end.y - begin.y) * (end.x - begin.x);
        return -INFINITY;
    }
    void put_ball(double gap) {
        frond_rigid_def def = frond_default_rigid_def();
        def.size = {BALL, 0, 0};
        def.mass = 0.065;
        def.state.position = {stem_at(HEIGHT) + THIN + gap + BALL, HEIGHT, 0};
        must(frond_rigid_create(world, &def, &ball));
        steps(2);
    }
    void let_go() {
        for (const int i : held) must(frond_plant_unpin(plants[0], i));
    }
    // Returns the distance of the stem's surface from the ball where its velocity takes it in the next step [m]: the
    // response to contacts of a step moves bodies in the one after it.
    double distance() const {
        constexpr double CORE = 0.005;  // radius of a ball within the ball, which no stem reaches [m]
        const frond_rigid_state state = ball_state();
        const auto vec = [](const frond_vec3& v) { return frond::Vec3(v.x, v.y, v.z); };
        const frond::Vec3 centre = vec(state.position) + h * vec(state.velocity);
        std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plants[0])));
        must(frond_plant_get_capsules(plants[0], capsules.data(), int(capsules.size())));
        const frond::Capsule core = {centre, centre, CORE};
        double least = INFINITY;
        for (const auto& [begin, end, radius] : capsules)
            least = std::min(least, frond::test::referee_distance(core, {vec(begin), vec(end), radius}));
        return least - (BALL - CORE);
    }
    frond_rigid_state ball_state() const {
        frond_rigid_state state = {};
        must(frond_rigid_get_state(ball, &state));
        return state;
    }
};

struct LetGo : testing::TestWithParam<frond_mechanics> {};
INSTANTIATE_TEST_SUITE_P(Plants, LetGo,
                         testing::Values(FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_ROD,
                                         FROND_MECHANICS_SPRING_CHAIN),
                         [](const auto& info) { return std::string(frond_mechanics_name(info.param)); });

// Bodies have moved before a plant steps, so a ball is where it is with the plant before that.
TEST_P(LetGo, StrikesABallInItsWay) {
    const bool is_cage = GetParam() == FROND_MECHANICS_TET_COROTATIONAL;
    const double deep = is_cage ? 0.002 : 0.008;  // of the sum of radii, 0.03; the stem may go 0.1 in a step [m]
    for (const double young : {1e9, 1e10, 5e10})
        for (const double step : {1.0 / 60, 1.0 / 30})
            for (const double gap : {0.005, 0.04, 0.01, 0.02, 0.08}) {
                if ((is_cage || SANITIZED) && gap != 0.04) continue;  // takes longer
                Sling sling(GetParam(), young, step);
                sling.put_ball(gap);
                const double lay = sling.ball_state().position.x;
                sling.let_go();
                for (int i = 0; i < 12; i++) {
                    const frond_rigid_state before = sling.ball_state();
                    const double stem = sling.stem_at(before.position.y);
                    sling.steps(1);
                    const frond_rigid_state now = sling.ball_state();
                    ASSERT_LT(stem, now.position.x)
                        << young << " Pa, 1/" << 1 / step << " s, gap " << gap << " m, step " << i;
                    EXPECT_GT(sling.distance(), -deep)
                        << young << " Pa, 1/" << 1 / step << " s, gap " << gap << " m, step " << i;
                }
                EXPECT_GT(sling.ball_state().position.x, lay) << young << " Pa, 1/" << 1 / step << " s, gap " << gap;
            }
}

}  // namespace let_go_tests
