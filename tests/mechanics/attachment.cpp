// Points that hang on nodes.

// Attachments: what a constant force gives to arms that turn is the derivative of how it is distributed.
#include "mechanics/attachment.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/dense.hpp"
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

TEST(Attachment, AForceGivesArmsTheStiffnessByWhichItsMomentsChange) {
    Attachment attachment;
    attachment.count = 2;
    attachment.turns = true;
    attachment.node = {0, 2};
    attachment.weight = {0.3, 0.7};
    attachment.arm = {Vec3(0.1, 0.02, -0.05), Vec3(-0.03, 0.2, 0.04)};
    const std::vector<Tet> pairs = {{0, 1, 2, 3}};
    const BlockPattern pattern = make_block_pattern(4, pairs);
    const Vec3 force(3, -20, 7);
    Dice dice(1);
    for (const double turn : {0.0, 1e-3, 0.02, 0.5, 2.9}) {
        const VecX x = dice.vector(12, turn);
        BlockMatrix A;
        A.set_pattern(pattern);
        A.set_zero();
        add_attachment_turning(attachment, x, force, 1, A);
        const Eigen::MatrixXd stiffness = dense(A);
        constexpr double STEP = 1e-5;
        for (int i = 0; i < 12; i++) {
            VecX before = VecX::Zero(12), after = before, moved = x;
            moved[i] = x[i] - STEP;
            add_attachment_force(attachment, moved, force, before);
            moved[i] = x[i] + STEP;
            add_attachment_force(attachment, moved, force, after);
            EXPECT_LT((stiffness.col(i) + (after - before) / (2 * STEP)).norm(), 1e-6) << turn << " " << i;
        }
    }
}

}  // namespace attachment_tests
}  // namespace frond::test
