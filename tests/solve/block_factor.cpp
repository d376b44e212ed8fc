// Frond's own factors, of trees of node pairs and of any pattern, compared with dense algebra.
#include "solve/block_factor.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/lanes.hpp"
#include "mechanics/mechanics.hpp"
#include "support/dense.hpp"
#include "support/meshes.hpp"

namespace frond::test {
namespace block_factor_tests {

// Returns a random tree of pairs, each under an earlier one, some of them roots; a pair of nodes may lack its block.
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

// Returns chains, trees, clouds or unconnected nodes.
BlockPattern random_graph(int nodes, Dice& dice) {
    std::vector<Tet> elements;
    const double reach = dice.uniform(0, 1) < 0.5 ? 6 : nodes;
    const int count = int(dice.uniform(0, 2) * nodes);
    for (int e = 0; e < count; ++e) {
        Tet tet;
        const double from = dice.uniform(0, nodes - 1e-9);
        for (int& node : tet) node = std::min(int(from + dice.uniform(0, reach)), nodes - 1);
        elements.push_back(tet);
    }
    return make_block_pattern(nodes, elements);
}

BlockPattern random_pattern(uint64_t seed, Dice& dice) {
    return seed % 2 ? random_tree(1 + int(seed), dice) : random_graph(1 + int(seed) * 3, dice);
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

struct Factored {
    BlockPlan plan;
    BlockFactor factor;
    explicit Factored(const BlockPattern& pattern) : plan(make_block_plan(pattern)) { factor.plan = &plan; }
};

// Returns the numbers of several matrices or vectors interleaved, one lane for each.
template <class Numbers>
NumbersInLines side_by_side(const std::vector<Numbers>& from) {
    NumbersInLines out(from.size() * size_t(from[0].size()));
    size_t i = 0;
    for (double& value : out) {
        value = from[i % from.size()].data()[i / from.size()];
        ++i;
    }
    return out;
}

// Compares lanes with single factors; one of the matrices is not positive definite.
void expect_lanes_as_alone(const BlockPattern& pattern, size_t lanes, Dice& dice) {
    Factored shared(pattern);
    const size_t wrong = size_t(dice.uniform(0, double(lanes) - 1e-9));
    std::vector<NumbersInLines> matrices;
    std::vector<VecX> right_sides, solutions(lanes);
    for (size_t lane = 0; lane < lanes; ++lane) {
        Factored own(pattern);
        const BlockMatrix A = random_matrix(pattern, dice, lane == wrong ? -60 : 60);
        matrices.push_back(A.values);
        right_sides.push_back(dice.vector(3 * pattern.node_count, 1));
        ASSERT_EQ(factorize(own.factor, A), lane != wrong);
        if (lane != wrong) solve(own.factor, right_sides[lane], solutions[lane]);
    }
    BlockMatrix A;
    A.pattern = &pattern;
    A.values = side_by_side(matrices);
    EXPECT_EQ(factorize_lanes(shared.factor, A), 1u << wrong);
    NumbersInLines x = side_by_side(right_sides);
    solve(shared.factor, x.data());
    for (size_t lane = 0; lane < lanes; ++lane) {
        if (lane == wrong) continue;
        const Eigen::Map<const VecX, 0, Eigen::InnerStride<>> found(x.data() + lane, solutions[lane].size(),
                                                                    Eigen::InnerStride<>(Eigen::Index(lanes)));
        ASSERT_EQ(VecX(found), solutions[lane]) << lane << " of " << lanes;
        if (shared.plan.tree) continue;
        Factored own(pattern);
        std::vector<FrontFactor*> out(lanes);
        out[lane] = &own.factor.fronts;
        take_apart(shared.factor.fronts, out.data());
        VecX x_own;
        solve(own.factor, right_sides[lane], x_own);
        ASSERT_EQ(x_own, solutions[lane]) << lane << " of " << lanes;
    }
}

TEST(BlockFactor, IsInLanesAsAlone) {
    for (uint64_t seed = 1; seed < 60; ++seed) {
        Dice dice(seed);
        const BlockPattern pattern = random_pattern(seed, dice);
        for (size_t lanes = 2; lanes <= size_t(most_lanes()); lanes *= 2) expect_lanes_as_alone(pattern, lanes, dice);
        if (HasFatalFailure()) FAIL() << seed;
    }
}

TEST(BlockFactor, SolvesAsDenseAlgebraDoes) {
    for (uint64_t seed = 1; seed < 60; ++seed) {
        Dice dice(seed);
        const BlockPattern pattern = random_pattern(seed, dice);
        Factored own(pattern);
        EXPECT_EQ(own.plan.tree.has_value(), seed % 2 == 1);
        // One factor is reused for several matrices.
        for (int round = 0; round < 3; ++round) {
            const BlockMatrix A = random_matrix(pattern, dice, 60);
            ASSERT_TRUE(factorize(own.factor, A));
            const VecX b = dice.vector(3 * pattern.node_count, 1);
            VecX x;
            solve(own.factor, b, x);
            EXPECT_LT((dense(A) * x - b).norm(), 1e-13 * b.norm()) << seed;
        }
    }
}

TEST(BlockFactor, HalvesOfASolveAreThoseOfTheWhole) {
    for (uint64_t seed = 11; seed < 31; ++seed) {
        Dice dice(seed);
        const BlockPattern pattern = random_pattern(seed, dice);
        const BlockMatrix A = random_matrix(pattern, dice, 60);
        const Eigen::MatrixXd inverse = inverse_of(dense(A));
        Factored own(pattern);
        ASSERT_TRUE(factorize(own.factor, A));
        const auto push = [&] {
            std::vector<NodeBlock> blocks;
            for (int k = 0; k < 3; ++k)
                blocks.push_back({int(dice.uniform(0, pattern.node_count - 1e-9)), Mat3(dice.rotation())});
            return blocks;
        };
        for (int round = 0; round < 5; ++round) {
            const std::vector<NodeBlock> at = push(), by = push();
            NodeCompliance first, second;
            half_solve(own.factor, at, first);
            half_solve(own.factor, by, second);
            EXPECT_TRUE(std::is_sorted(first.rows.begin(), first.rows.end()));
            EXPECT_LT(second.rows.back(), 3 * pattern.node_count);
            Columns3 spread;
            std::vector<Mat3> blocks(1, Mat3::Zero());
            add_compliances({&first}, second, spread, blocks);
            Mat3 expected = Mat3::Zero();
            for (const NodeBlock& a : at)
                for (const NodeBlock& b : by)
                    expected += a.block.transpose() * inverse.block<3, 3>(3 * a.node, 3 * b.node) * b.block;
            EXPECT_LT((blocks[0] - expected).norm(), 1e-13 * expected.norm() + 1e-15);
        }
    }
}

TEST(BlockFactor, SaysSoWhenTheMatrixIsNotPositive) {
    for (uint64_t seed = 8; seed < 12; ++seed) {
        Dice dice(seed);
        const BlockPattern pattern = random_pattern(seed, dice);
        Factored own(pattern);
        EXPECT_FALSE(factorize(own.factor, random_matrix(pattern, dice, -1)));
        BlockMatrix A = random_matrix(pattern, dice, 60);
        EXPECT_TRUE(factorize(own.factor, A));
        A.values[28] = std::nan("");
        EXPECT_FALSE(factorize(own.factor, A));
        A = random_matrix(pattern, dice, INFINITY);
        EXPECT_FALSE(factorize(own.factor, A));
    }
}

// A chain of a hundred thousand nodes is deeper than any call stack, and a single front of all nodes is as wide as the
// matrix.
TEST(BlockFactor, TakesTheLongestAndTheWidest) {
    std::vector<Tet> chain;
    for (int i = 0; i + 3 < 100000; ++i) chain.push_back({i, i + 1, i + 2, i + 3});
    std::vector<Tet> cloud;
    for (int i = 0; i < 120; ++i)
        for (int j = 0; j < i; ++j) cloud.push_back({i, j, i, j});
    for (const BlockPattern& pattern : {make_block_pattern(100000, chain), make_block_pattern(120, cloud)}) {
        Dice dice(5);
        const BlockMatrix A = random_matrix(pattern, dice, 400);
        Factored own(pattern);
        ASSERT_TRUE(factorize(own.factor, A));
        const VecX b = dice.vector(3 * pattern.node_count, 1);
        VecX x, product;
        solve(own.factor, b, x);
        A.multiply(x, product);
        EXPECT_LT((product - b).norm(), 1e-13 * b.norm());
    }
}

}  // namespace block_factor_tests

}  // namespace frond::test
