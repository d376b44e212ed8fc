// Attachments: what a constant force gives to arms that turn is the derivative of how it is distributed.
#include "mechanics/attachment.hpp"

#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "support/meshes.hpp"

namespace frond::test {
namespace attachment_tests {

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
