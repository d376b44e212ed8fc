// One-sided rows: each row found pulls or is inactive, for random matrices including nearly singular ones; a matrix
// that is not positive definite is reported.
#include "solve/one_sided.hpp"

#include <gtest/gtest.h>

#include <random>

namespace frond {
namespace one_sided_tests {

class RandomRows : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(OneSided, RandomRows, testing::Values(1, 2, 5, 20, 80));

TEST_P(RandomRows, PullOrHaveNothingToDo) {
    const int count = GetParam();
    std::mt19937 random(unsigned(count) * 7);
    std::normal_distribution<double> normal;
    for (int round = 0; round < 50; round++) {
        // Fewer degrees of freedom than rows, apart from a small diagonal term.
        const Eigen::MatrixXd J = Eigen::MatrixXd::NullaryExpr(count, 1 + count / 2, [&] { return normal(random); });
        const Eigen::MatrixXd W = J * J.transpose() + 1e-6 * Eigen::MatrixXd::Identity(count, count);
        const VecX b = VecX::NullaryExpr(count, [&] { return normal(random); });
        VecX p;
        ASSERT_TRUE(solve_one_sided(W, b, p)) << round;
        const VecX rest = W * p - b;
        const double scale = b.cwiseAbs().maxCoeff();
        EXPECT_GE(p.minCoeff(), 0);
        EXPECT_GE(rest.minCoeff(), -1e-6 * scale);
        for (int i = 0; i < count; i++) EXPECT_LE(p[i] > 0 ? std::abs(rest[i]) : 0, 1e-6 * scale) << round << " " << i;
    }
}

TEST(OneSided, NothingToPullIsNoPull) {
    VecX p;
    EXPECT_TRUE(solve_one_sided(Eigen::MatrixXd(0, 0), VecX(0), p));
    EXPECT_EQ(p.size(), 0);
    EXPECT_TRUE(solve_one_sided(Eigen::MatrixXd::Identity(2, 2), Eigen::Vector2d(-1, -2), p));
    EXPECT_EQ(p, VecX::Zero(2));
}

TEST(OneSided, WhatCannotBeSolvedIsToldAndPullsNothing) {
    VecX p;
    EXPECT_FALSE(solve_one_sided(-Eigen::MatrixXd::Identity(3, 3), VecX::Ones(3), p));
    EXPECT_EQ(p, VecX::Zero(3));
    EXPECT_FALSE(solve_one_sided(Eigen::MatrixXd::Identity(3, 3), VecX::Constant(3, NAN), p));
    EXPECT_EQ(p, VecX::Zero(3));
}

}  // namespace one_sided_tests

}  // namespace frond
