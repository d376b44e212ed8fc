// Impulses between bodies in contact: known solutions, and the conditions that every solution has to satisfy.
#include "solve/impulses.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/coupling.hpp"
#include "support/meshes.hpp"

namespace frond::test {
namespace impulses_tests {

std::vector<std::vector<Coupling>> alone(double inverse_mass) {
    return {{{0, inverse_mass * Mat3::Identity()}}};
}
Touch touch_of(const Vec3& velocity, double friction, double bias_velocity = 0) {
    return {Vec3::UnitY(), velocity, bias_velocity, friction};
}

TEST(Impulses, StopABallThatFallsAndLetOneGoThatRises) {
    std::vector<Vec3> impulses;
    EXPECT_TRUE(find_impulses({touch_of({0, -3, 0}, 0)}, coupling_table(alone(0.5)), {}, impulses).converged);
    EXPECT_NEAR((impulses[0] - Vec3(0, 6, 0)).norm(), 0, 1e-9);
    impulses.clear();
    find_impulses({touch_of({0, 1, 0}, 0.5)}, coupling_table(alone(0.5)), {}, impulses);
    EXPECT_EQ(impulses[0].norm(), 0);
}

TEST(Impulses, LetBodiesComeNearerAsFarAsThereIsRoom) {
    std::vector<Vec3> impulses;
    find_impulses({touch_of({0, -3, 0}, 0, -1)}, coupling_table(alone(1)), {}, impulses);
    EXPECT_NEAR(impulses[0].y(), 2, 1e-9);
}

TEST(Impulses, PushNoMoreThanTheyMay) {
    Touch weak = touch_of({0, -3, 0}, 0.5);
    weak.most_push = 2;
    weak.velocity.x() = 4;
    std::vector<Vec3> impulses = {Vec3(0, 9, 0)};
    EXPECT_TRUE(find_impulses({weak}, coupling_table(alone(1)), {}, impulses).converged);
    EXPECT_NEAR((impulses[0] - Vec3(-1, 2, 0)).norm(), 0, 1e-9);
}

TEST(Impulses, HoldByFrictionUpToItsLimitAndAgainstTheSliding) {
    std::vector<Vec3> impulses;
    find_impulses({touch_of({0.4, -1, -0.3}, 0.6)}, coupling_table(alone(1)), {}, impulses);
    EXPECT_NEAR((impulses[0] - Vec3(-0.4, 1, 0.3)).norm(), 0, 1e-9);
    impulses.clear();
    find_impulses({touch_of({4, -1, -3}, 0.6)}, coupling_table(alone(1)), {}, impulses);
    EXPECT_NEAR((impulses[0] - Vec3(-0.48, 1, 0.36)).norm(), 0, 1e-9);
}

TEST(Impulses, ShareTheLoadOfAPlateOnFourPoints) {
    // Mass 2, a square with corners at 1 m, inertia 1 about both axes.
    std::vector<Touch> touches;
    std::vector<std::vector<Coupling>> coupling(4);
    const Vec3 corners[] = {{1, 0, 1}, {1, 0, -1}, {-1, 0, 1}, {-1, 0, -1}};
    for (int i = 0; i < 4; i++) {
        touches.push_back(touch_of({0, -1, 0}, 0));
        for (int j = 0; j < 4; j++) {
            Mat3 block = 0.5 * Mat3::Identity();
            block(1, 1) += corners[i].x() * corners[j].x() + corners[i].z() * corners[j].z();
            coupling[size_t(i)].push_back({j, block});
        }
    }
    std::vector<Vec3> impulses;
    EXPECT_TRUE(find_impulses(touches, coupling_table(coupling), {}, impulses).converged);
    double sum = 0;
    for (const Vec3& impulse : impulses) sum += impulse.y();
    EXPECT_NEAR(sum, 2, 1e-5);
}

// Random coupled contacts: bodies separate, or push and separate no faster than they must; friction is within its cone
// and, if they slide, opposes it.
TEST(Impulses, MeetTheConditionsOfContactAndFriction) {
    Dice dice(3);
    for (int repeat = 0; repeat < 50; repeat++) {
        const int count = 6;
        Eigen::MatrixXd root(3 * count, 3 * count);
        for (int i = 0; i < root.size(); i++) root.data()[i] = dice.uniform(-1, 1);
        const Eigen::MatrixXd W = root * root.transpose() + 2 * Eigen::MatrixXd::Identity(3 * count, 3 * count);
        std::vector<Touch> touches;
        std::vector<std::vector<Coupling>> coupling(count);
        for (int i = 0; i < count; i++) {
            const Vec3 normal = dice.rotation().col(0);
            touches.push_back({normal, dice.vector(3, 2), dice.uniform(-1, 0.2), 0.4});
            for (int j = 0; j < count; j++) coupling[size_t(i)].push_back({j, W.block<3, 3>(3 * i, 3 * j)});
        }
        std::vector<Vec3> impulses;
        const ImpulseReport report = find_impulses(touches, coupling_table(coupling), {2000, 1e-10}, impulses);
        ASSERT_TRUE(report.converged) << repeat;
        for (int i = 0; i < count; i++) {
            const Touch& touch = touches[size_t(i)];
            Vec3 velocity = touch.velocity;
            for (int j = 0; j < count; j++) velocity += W.block<3, 3>(3 * i, 3 * j) * impulses[size_t(j)];
            const double push = impulses[size_t(i)].dot(touch.normal), part = velocity.dot(touch.normal);
            EXPECT_GE(push, 0);
            EXPECT_GT(part, touch.bias_velocity - 1e-6);
            EXPECT_NEAR(push * (part - touch.bias_velocity), 0, 1e-6);
            const Vec3 hold = impulses[size_t(i)] - push * touch.normal, sliding = velocity - part * touch.normal;
            EXPECT_LE(hold.norm(), 0.4 * push + 1e-9);
            if (hold.norm() < 0.4 * push - 1e-6) {
                EXPECT_NEAR(sliding.norm(), 0, 1e-6);
            } else {
                EXPECT_NEAR((hold.norm() * sliding + sliding.norm() * hold).norm(), 0, 1e-5);
            }
        }
    }
}

TEST(Impulses, NothingThatIsNailedDownIsPushed) {
    std::vector<Vec3> impulses;
    find_impulses({touch_of({1, -1, 0}, 0.5)}, coupling_table({{}}), {}, impulses);
    EXPECT_EQ(impulses[0].norm(), 0);
}

}  // namespace impulses_tests

}  // namespace frond::test
