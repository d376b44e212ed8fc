// Factors of trees of pairs of nodes against dense algebra and against the solver for all patterns.
#include "solve/tree_factor.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mechanics/mechanics.hpp"
#include "solve/direct.hpp"
#include "support/dense.hpp"
#include "support/meshes.hpp"

namespace frond::test {
namespace {

// Pairs under earlier ones, chosen at random, some of them roots; a pair of nodes may be without a block.
BlockPattern random_tree(int pairs, Dice& dice) {
    std::vector<Tet> elements;
    for (int i = 0; i < pairs; ++i) {
        const int parent = i > 0 ? int(dice.uniform(0, i - 1e-9)) : 0, kind = int(dice.uniform(0, 7));
        if (kind != 0) elements.push_back({2 * i, 2 * i + 1, 2 * i, 2 * i + 1});
        if (i == 0 || kind == 1) continue;
        if (kind == 2)
            elements.push_back({2 * i + 1, 2 * parent, 2 * i + 1, 2 * parent});
        else
            elements.push_back({2 * i, 2 * i + 1, 2 * parent, 2 * parent + 1});
    }
    return make_block_pattern(2 * pairs, elements);
}

BlockMatrix random_matrix(const BlockPattern& pattern, Dice& dice, double shift) {
    BlockMatrix A;
    A.set_pattern(pattern);
    for (double& value : A.values) value = dice.uniform(-1, 1);
    for (int j = 0; j < pattern.node_count; ++j) {
        auto own = A.block(pattern.start[size_t(j)]);
        own = Mat3(own + own.transpose());
        own.diagonal().array() += shift;
    }
    return A;
}

TEST(TreeFactor, SolvesAsDenseAlgebraDoes) {
    for (uint64_t seed = 1; seed < 30; ++seed) {
        Dice dice(seed);
        const BlockPattern pattern = random_tree(1 + int(seed), dice);
        const std::optional<TreePlan> plan = make_tree_plan(pattern);
        ASSERT_TRUE(plan);
        // One factor for several matrices.
        TreeFactor factor;
        for (int round = 0; round < 3; ++round) {
            const BlockMatrix A = random_matrix(pattern, dice, 40);
            ASSERT_TRUE(factorize(*plan, A, factor));
            const VecX b = dice.vector(3 * pattern.node_count, 1);
            VecX x;
            solve(*plan, factor, b, x);
            EXPECT_LT((dense(A) * x - b).norm(), 1e-13 * b.norm()) << seed;
        }
    }
}

TEST(TreeFactor, HalvesOfASolveAreThoseOfTheWhole) {
    Dice dice(7);
    const BlockPattern pattern = random_tree(25, dice);
    const std::optional<TreePlan> plan = make_tree_plan(pattern);
    const BlockMatrix A = random_matrix(pattern, dice, 40);
    const Eigen::MatrixXd inverse = dense(A).inverse();
    TreeFactor factor;
    ASSERT_TRUE(plan && factorize(*plan, A, factor));
    const auto push = [&] {
        std::vector<NodeBlock> blocks;
        for (int k = 0; k < 3; ++k)
            blocks.push_back({int(dice.uniform(0, pattern.node_count - 1e-9)), Mat3(dice.rotation())});
        return blocks;
    };
    for (int round = 0; round < 20; ++round) {
        const std::vector<NodeBlock> at = push(), by = push();
        Answer first, second;
        half_solve(*plan, factor, at, first);
        half_solve(*plan, factor, by, second);
        EXPECT_TRUE(std::is_sorted(first.rows.begin(), first.rows.end()));
        EXPECT_LT(second.rows.back(), 3 * pattern.node_count);
        Eigen::Matrix3Xd spread;
        std::vector<Mat3> blocks(1, Mat3::Zero());
        add_answers({&first}, second, spread, blocks);
        Mat3 expected = Mat3::Zero();
        for (const NodeBlock& a : at)
            for (const NodeBlock& b : by)
                expected += a.block.transpose() * inverse.block<3, 3>(3 * a.node, 3 * b.node) * b.block;
        EXPECT_LT((blocks[0] - expected).norm(), 1e-13 * expected.norm() + 1e-15);
    }
}

TEST(TreeFactor, SaysSoWhenTheMatrixIsNotPositive) {
    Dice dice(3);
    const BlockPattern pattern = random_tree(9, dice);
    TreeFactor factor;
    const std::optional<TreePlan> plan = make_tree_plan(pattern);
    ASSERT_TRUE(plan);
    EXPECT_FALSE(factorize(*plan, random_matrix(pattern, dice, -1), factor));
    BlockMatrix A = random_matrix(pattern, dice, 40);
    EXPECT_TRUE(factorize(*plan, A, factor));
    A.values[30] = std::nan("");
    EXPECT_FALSE(factorize(*plan, A, factor));
}

TEST(TreeFactor, IsForTreesOnly) {
    EXPECT_FALSE(make_tree_plan(make_block_pattern(0, std::vector<Tet>{})));
    EXPECT_FALSE(make_tree_plan(make_block_pattern(3, std::vector<Tet>{{0, 1, 2, 2}})));
    // A ring of three pairs.
    const std::vector<Tet> ring = {{0, 1, 2, 3}, {2, 3, 4, 5}, {0, 1, 4, 5}};
    EXPECT_FALSE(make_tree_plan(make_block_pattern(6, ring)));
    EXPECT_TRUE(make_tree_plan(make_block_pattern(6, std::vector<Tet>(ring.begin(), ring.begin() + 2))));
    EXPECT_FALSE(make_direct_plan(make_tet_elements(tree_model(6, 5, 3)).pattern).tree);
}

}  // namespace
}  // namespace frond::test
