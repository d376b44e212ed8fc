// Compliance to impulses at a few nodes: as by whole solves, with and without a factor, and zero for held nodes.
#include "solve/node_compliance.hpp"

#include "support/rig.hpp"

namespace frond::test {
namespace node_compliance_tests {

// Computes C' A^-1 B by whole solves.
Mat3 by_whole_solves(Rig& rig, const std::vector<NodeBlock>& at, const std::vector<NodeBlock>& by) {
    Mat3 block = Mat3::Zero();
    for (int axis = 0; axis < 3; ++axis) {
        VecX impulse = VecX::Zero(rig.motion.v.size()), dv;
        for (const NodeBlock& push : by) point(impulse, push.node) += push.block.col(axis);
        EXPECT_TRUE(respond(*rig.workspace, rig.settings, impulse, dv));
        for (const NodeBlock& push : at) block.col(axis) += push.block.transpose() * point(dv, push.node);
    }
    return block;
}

TEST(NodeCompliance, IsThatOfWholeSolvesForEverySolverAndIntegrator) {
    const Model model = tree_model(6, 4, 3);
    Dice dice(1);
    for (int solver = 0; solver < FROND_LINEAR_SOLVER_COUNT; ++solver)
        for (const frond_integrator integrator :
             {FROND_INTEGRATOR_IMPLICIT_EULER, FROND_INTEGRATOR_BDF2, FROND_INTEGRATOR_SYMPLECTIC_EULER}) {
            RigSettings settings = plain_settings(FROND_MECHANICS_TET_COROTATIONAL, frond_linear_solver(solver));
            settings.integrator = integrator;
            Rig rig(model, settings);
            rig.pin_below(1, 0.05);
            rig.steps(2, integrator == FROND_INTEGRATOR_SYMPLECTIC_EULER ? 1e-6 : 1.0 / 60);

            // Impulses on one node, on four, on one given twice, and on a held one only.
            std::vector<std::vector<NodeBlock>> pushes(4);
            const auto any_node = [&] {
                int node = 0;
                do node = int(dice.uniform(0, rig.node_count() - 1e-9));
                while (rig.motion.pinned[size_t(node)]);
                return node;
            };
            const auto random_block = [&] { return Mat3(dice.rotation() * dice.uniform(0.1, 1)); };
            int held = 0;
            while (!rig.motion.pinned[size_t(held)]) ++held;
            pushes[0] = {{any_node(), random_block()}};
            for (int k = 0; k < 4; ++k) pushes[1].push_back({any_node(), random_block()});
            const int twice = any_node();
            pushes[2] = {{twice, random_block()}, {twice, random_block()}};
            pushes[3] = {{held, random_block()}};
            std::vector<NodeCompliance> compliances(pushes.size());
            std::vector<const NodeCompliance*> pointers;
            for (size_t i = 0; i < pushes.size(); ++i) {
                ASSERT_TRUE(make_compliance(*rig.workspace, rig.settings, pushes[i], compliances[i]));
                pointers.push_back(&compliances[i]);
            }
            Columns3 spread;
            for (size_t j = 0; j < pushes.size(); ++j) {
                std::vector<Mat3> blocks(pushes.size(), Mat3::Zero());
                add_compliances(pointers, compliances[j], spread, blocks);
                for (size_t i = 0; i < pushes.size(); ++i) {
                    const Mat3 expected =
                        i == 3 || j == 3 ? Mat3(Mat3::Zero()) : by_whole_solves(rig, pushes[i], pushes[j]);
                    const double largest = by_whole_solves(rig, pushes[0], pushes[0]).norm();
                    EXPECT_LT((blocks[i] - expected).norm(), 1e-7 * std::max(largest, expected.norm()))
                        << solver << " " << integrator << " " << i << " " << j;
                }
            }
        }
}

}  // namespace node_compliance_tests

}  // namespace frond::test
