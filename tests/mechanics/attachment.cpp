// Points that hang on nodes.
#include "mechanics/attachment.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/meshes.hpp"

namespace frond::test {
namespace attachment_tests {

// A point on one node, or between two, each with an arm that turns with its node.
Attachment hold(const std::vector<int>& nodes, Dice& dice) {
    Attachment out;
    out.turns = true;
    for (const int node : nodes) {
        out.node[size_t(out.count)] = node;
        out.weight[size_t(out.count)] = 1.0 / double(nodes.size());
        out.arm[size_t(out.count++)] = dice.vector(3, 0.1);
    }
    return out;
}

// Rotations are found once for points that follow each other on a node.
TEST(Attachments, OfAListAreWhereEachIsByItself) {
    Dice dice(3);
    const VecX x = dice.vector(3 * 8, 1.5);  // four nodes: a position and a rotation vector each
    std::vector<Attachment> list;
    for (const auto& nodes : std::vector<std::vector<int>>{{0}, {0}, {0, 2}, {2, 0}, {2}, {4, 2}, {4, 6}, {0}})
        list.push_back(hold(nodes, dice));
    std::vector<Vec3> places;
    attachment_places(list, x, Mat3::Identity(), Vec3::Zero(), places);
    ASSERT_EQ(places.size(), list.size());
    for (size_t i = 0; i < list.size(); ++i) EXPECT_EQ(places[i], attachment_place(list[i], x)) << i;
}

}  // namespace attachment_tests
}  // namespace frond::test
