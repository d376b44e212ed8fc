// Chains of the caller's stems.
#include <gtest/gtest.h>

#include "support/model_def.hpp"

namespace frond::test {
namespace stems_tests {

// A hair before the end: the stem's last capsule still ends where the stem does, with all of its surface on it.
TEST(Stems, EndWhereTheyEndAlsoIfAnotherOneGrowsOutJustBefore) {
    const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 1, 0}, 0.01, 0.01},
                                {0, {0, 1 - 5e-7, 0}, {0.3, 1.2, 0}, 0.005, 0.005}};
    const auto model = build_from_stems(stems, 2, model_def());
    for (const double along : model->chain.vertex_along) {
        EXPECT_GE(along, 0);
        EXPECT_LE(along, 1);
    }
    double highest = 0;
    for (const ChainNode& node : model->chain.nodes)
        if (std::abs(node.position.x()) < 1e-9) highest = std::max(highest, node.position.y());
    EXPECT_NEAR(highest, 1, 1e-12);
}

}  // namespace stems_tests
}  // namespace frond::test
