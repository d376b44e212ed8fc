// Guides: rotations that are held in part.
#include <gtest/gtest.h>

#include <random>

#include "mechanics/rotation.hpp"
#include "solve/guides.hpp"

namespace frond {
namespace guides_tests {

struct Guides : testing::Test {
    std::mt19937 random{7};
    Vec3 vector(double size) {
        std::uniform_real_distribution<double> number(-size, size);
        const double x = number(random), y = number(random);
        return {x, y, number(random)};
    }
    Guide guide(bool is_hinge) { return {1, is_hinge, vector(1).normalized(), vector(1)}; }
    // Returns the rotation vector from where it was made.
    static Vec3 since(const Guide& guide, const Vec3& turn) {
        return rotation_vector<double>(
            Mat3(rotation_of<double>(turn) * rotation_of<double>(guide.made_at).transpose()));
    }
};

TEST_F(Guides, AHingeLeavesTurnsAboutItsAxisAndAForkThoseAcrossIt) {
    for (int i = 0; i < 200; i++) {
        const Guide hinge = guide(true), fork = guide(false);
        const Vec3 about = since(hinge, guided(hinge, vector(1.5)));
        EXPECT_NEAR(about.cross(hinge.axis).norm(), 0, 1e-12);
        EXPECT_NEAR(since(fork, guided(fork, vector(1.5))).dot(fork.axis), 0, 1e-12);
    }
}

TEST_F(Guides, WhatIsAllowedStays) {
    for (int i = 0; i < 200; i++) {
        const Guide any = guide(i % 2 == 0);
        const Vec3 turn = guided(any, vector(1.5));
        EXPECT_NEAR((guided(any, turn) - turn).norm(), 0, 1e-12);
    }
}

// Beyond half a turn vectors go on, since steps are differences.
TEST_F(Guides, AVectorBeyondHalfATurnIsNotWoundBack) {
    const Guide hinge = {1, true, {0, 0, 1}, {0, 0, 0}};
    const Vec3 turn = guided(hinge, {0.01, 0, 3.5});
    EXPECT_NEAR(turn.z(), 3.5, 1e-3);
    EXPECT_EQ(Vec3(turn.cross(hinge.axis)), Vec3(0, 0, 0));
}

TEST_F(Guides, WhatIsHeldIsAcrossTheWayThatIsAllowed) {
    constexpr double SMALL = 1e-5;
    for (int i = 0; i < 200; i++) {
        const Guide any = guide(i % 2 == 0);
        const Vec3 turn = guided(any, vector(1.5)), way = guided(any, turn + SMALL * vector(1)) - turn;
        const Mat3 held = held_part(any, turn);
        EXPECT_NEAR((held * way).norm(), 0, 1e-8);
        EXPECT_NEAR((held * held - held).norm(), 0, 1e-12);
        EXPECT_NEAR(held.trace(), any.is_hinge ? 2 : 1, 1e-12);
    }
}

}  // namespace guides_tests
}  // namespace frond
