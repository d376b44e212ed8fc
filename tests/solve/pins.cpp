// Pinned nodes: exactly at their targets at the end of every step, and pulling the rest along.
#include <gtest/gtest.h>

#include "support/rig.hpp"

namespace frond::test {
namespace pins_tests {

struct EveryPin : EveryCombination {
    const double H = time_step();
};
INSTANTIATE_TEST_SUITE_P(Pins, EveryPin, testing::ValuesIn(every_combination()), combination_name);

TEST_P(EveryPin, HoldsPinsExactly) {
    Rig rig(box_model(1, 4, 1, {0.1, 0.4, 0.1}, {900, 1e6, 0.3}), settings(), mass());
    rig.pin_below(1, 0);
    rig.loads.gravity = {5, -9.81, 0};
    const VecX start = rig.motion.x;
    rig.steps(is_explicit() ? 2500 : 50, H);
    double moved = 0;
    for (int i = 0; i < rig.node_count(); ++i) {
        if (!rig.motion.pinned[size_t(i)]) {
            moved = std::max(moved, (point(rig.motion.x, i) - point(start, i)).norm());
            continue;
        }
        EXPECT_EQ(Vec3(point(rig.motion.x, i)), Vec3(point(start, i)));
        EXPECT_EQ(Vec3(point(rig.motion.v, i)), Vec3(Vec3::Zero()));
    }
    EXPECT_GT(moved, 1e-4);
}

TEST_P(EveryPin, MovesPinsToTheirTargetWithTheVelocityThatTakes) {
    for (int newton : {1, 4}) {
        Rig rig(box_model(1, 4, 1, {0.1, 0.4, 0.1}, {900, 1e6, 0.3}), settings(), mass());
        rig.settings.newton_iterations = newton;
        rig.pin_below(1, 0);
        for (int n = 1; n <= 20; ++n) {
            const VecX before = rig.motion.x;
            for (int i = 0; i < rig.node_count(); ++i) point(rig.motion.pin_target, i).x() += 0.003 * n / 20;
            ASSERT_TRUE(rig.step(H).ok);
            for (int i = 0; i < rig.node_count(); ++i) {
                if (!rig.motion.pinned[size_t(i)]) continue;
                EXPECT_EQ(Vec3(point(rig.motion.x, i)), Vec3(point(rig.motion.pin_target, i)));
                // The velocity over the step; of methods that go on from it that at its end, as their history tells:
                // generalized-alpha's rates are a little apart in time.
                const bool is_alpha = rig.settings.integrator == FROND_INTEGRATOR_GENERALIZED_ALPHA;
                const bool looks_back = (rig.settings.integrator == FROND_INTEGRATOR_BDF2 && n > 1) || is_alpha;
                const Vec3 mean = (point(rig.motion.x, i) - point(before, i)) / H;
                const Vec3 velocity = looks_back ? Vec3(mean + 0.5 * Vec3(0.003 / 20 / H, 0, 0)) : mean;
                EXPECT_NEAR((point(rig.motion.v, i) - velocity).norm(), 0, is_alpha ? 0.05 * 0.003 / 20 / H : 1e-12);
            }
        }
        // The free end follows, given enough time.
        if (!is_explicit()) {
            EXPECT_GT(point(rig.motion.x, rig.corner_count() - 1).x(), 0.1 + 0.01);
        }
    }
}

TEST_P(EveryPin, PushesFreeNodesInTheVeryStepInWhichAPinMoves) {
    if (is_explicit()) GTEST_SKIP() << "forces follow a step later";
    // All nodes but one are pinned and moved alike: the free one, held by stiff tets, follows at once.
    Rig rig(box_model(1, 1, 1, {0.1, 0.1, 0.1}, {1, 1e7, 0.3}), settings(), mass());
    rig.motion.pinned.assign(rig.motion.pinned.size(), 1);
    rig.motion.pinned[7] = 0;
    for (int i = 0; i < rig.node_count(); ++i) point(rig.motion.pin_target, i).y() += 0.01;
    ASSERT_TRUE(rig.step(H).ok);
    EXPECT_NEAR(point(rig.motion.x, 7).y(), 0.11, 1e-5);
}

TEST_P(EveryPin, LetsGoAndTakesHoldAnyTime) {
    Rig rig(box_model(1, 1, 3, {0.1, 0.1, 0.3}, {900, 1e6, 0.3}), settings(), mass());
    rig.loads.gravity = {0, -10, 0};
    rig.motion.pinned.assign(rig.motion.pinned.size(), 1);
    rig.steps(5, H);
    EXPECT_EQ(rig.motion.x, elements_of(*rig.system).modelled);
    rig.motion.pinned.assign(rig.motion.pinned.size(), 0);
    rig.steps(10, H);
    EXPECT_NEAR(point(rig.motion.v, 0).y(), -10 * 10 * H, 1e-8);
    rig.motion.pinned[3] = 1;
    point(rig.motion.pin_target, 3) = point(rig.motion.x, 3);
    const Vec3 place = point(rig.motion.x, 3);
    rig.steps(5, H);
    EXPECT_EQ(Vec3(point(rig.motion.x, 3)), place);
}

}  // namespace pins_tests

}  // namespace frond::test
