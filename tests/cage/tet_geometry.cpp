// Volume and weights of a tet, compared with closed forms.
#include "cage/tet_geometry.hpp"

#include <gtest/gtest.h>

namespace frond::test {
namespace tet_geometry_tests {

// Edges of 2, 3 and 4 m along x, y and z, away from the origin.
const std::vector<Vec3> NODES = {{9, 9, 9}, {1, 1, 1}, {3, 1, 1}, {1, 4, 1}, {1, 1, 5}};
const Tet TET = {1, 2, 3, 4};

TEST(TetGeometry, VolumeIsSignedByTheOrderOfTheCorners) {
    VecX x(15);
    for (int i = 0; i < 5; ++i) point(x, i) = NODES[size_t(i)];
    EXPECT_DOUBLE_EQ(tet_volume(NODES[1], NODES[2], NODES[3], NODES[4]), 4);
    EXPECT_DOUBLE_EQ(tet_volume(NODES, TET), 4);
    EXPECT_DOUBLE_EQ(tet_volume(x, TET), 4);
    EXPECT_DOUBLE_EQ(tet_volume(NODES, {1, 3, 2, 4}), -4);
    EXPECT_EQ(tet_volume(NODES, {1, 2, 3, 3}), 0);
}

TEST(TetGeometry, WeightsGiveThePlaceBackInsideAndOutside) {
    for (const std::array<double, 4>& weights :
         {std::array<double, 4>{0.1, 0.2, 0.3, 0.4}, {1, 0, 0, 0}, {0, 0, 0, 1}, {-1, 2, 3, -3}}) {
        Vec3 place = Vec3::Zero();
        for (size_t k = 0; k < 4; ++k) place += weights[k] * NODES[size_t(TET[k])];
        const auto found = tet_weights(NODES, TET, place);
        for (size_t k = 0; k < 4; ++k) EXPECT_NEAR(found[k], weights[k], 1e-14);
    }
}

}  // namespace tet_geometry_tests

}  // namespace frond::test
