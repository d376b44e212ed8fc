// On a processor with narrower lanes all results are the same, to the last bit.
#include "core/lanes.hpp"

#include <gtest/gtest.h>

#include "support/rig.hpp"

namespace frond::test {
namespace lanes_tests {

struct Narrow {
    const int before = most_lanes();
    explicit Narrow(bool narrow) { most_lanes() = narrow ? 2 : before; }
    ~Narrow() { most_lanes() = before; }
};

struct EveryBody : testing::TestWithParam<std::tuple<int, int>> {};
INSTANTIATE_TEST_SUITE_P(Lanes, EveryBody, testing::Combine(testing::Range(0, TET_MECHANICS), testing::Values(1, 2)));

TEST_P(EveryBody, MovesAlikeInLanesOfAnyWidth) {
    const auto [which, order] = GetParam();
    VecX ends[2];
    for (bool narrow : {false, true}) {
        const Narrow width(narrow);
        RigSettings settings = plain_settings(frond_mechanics(which));
        settings.order = order;
        settings.newton_iterations = 2;  // tests the exact stiffness too
        Rig rig(tree_model(8, 6, 4, {900, 1e7, 0.3}), settings);
        rig.pin_below(1, 0);
        rig.loads.gravity = {2, -9.81, 1};
        rig.steps(10, 1.0 / 60);
        EXPECT_GT((rig.motion.x - elements_of(*rig.system).rest_positions).cwiseAbs().maxCoeff(), 1e-3);
        ends[narrow] = rig.motion.x;
    }
    EXPECT_EQ(ends[0], ends[1]);
}

}  // namespace lanes_tests

}  // namespace frond::test
