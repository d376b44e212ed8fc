// The table of responses: overlapping bodies separate, and bodies that only touch gain no energy.
#include <gtest/gtest.h>

#include "solve/position_correction.hpp"
#include "support/coupling.hpp"
#include "support/meshes.hpp"

namespace frond::test {
namespace response_tests {

struct Bodies {
    Eigen::MatrixXd W;
    std::vector<Touch> touches;
    std::vector<std::vector<Coupling>> coupling;
    explicit Bodies(Dice& dice, int count, double depth) {
        // Fewer degrees of freedom than contacts would need, as if several touch one stem.
        Eigen::MatrixXd root(3 * count, count);
        for (int i = 0; i < root.size(); i++) root.data()[i] = dice.uniform(-1, 1);
        W = root * root.transpose();
        for (int i = 0; i < count; i++) {
            Touch touch = {dice.rotation().col(0), dice.vector(3, 2), 0, 0.4};
            touch.depth = depth;
            touch.least_correction = depth > 0 ? 0.1 : 0;
            touches.push_back(touch);
            coupling.emplace_back();
            for (int j = 0; j < count; j++) coupling.back().push_back({j, W.block<3, 3>(3 * i, 3 * j)});
        }
        // Velocities that the bodies' degrees of freedom permit.
        const Eigen::VectorXd motion = Eigen::VectorXd::NullaryExpr(count, [&] { return dice.uniform(-1, 1); });
        const Eigen::VectorXd velocities = root * motion;
        for (int i = 0; i < count; i++) touches[size_t(i)].velocity = velocities.segment<3>(3 * i);
    }
    // Returns the increase of kinetic energy: p.(v + W p / 2).
    double gain(const std::vector<Vec3>& impulses) const {
        Eigen::VectorXd p(W.rows()), v(W.rows());
        for (size_t i = 0; i < touches.size(); i++) {
            p.segment<3>(3 * Eigen::Index(i)) = impulses[i];
            v.segment<3>(3 * Eigen::Index(i)) = touches[i].velocity;
        }
        return p.dot(v + 0.5 * W * p);
    }
};

TEST(Response, NoRowGivesEnergyToBodiesThatOnlyTouch) {
    Dice dice(5);
    for (int row = 0; row < FROND_RESPONSE_COUNT; row++) {
        const ResponseRow& response = response_row(frond_response(row));
        if (!response.find) continue;
        for (const double stiffness : {1.0, 1e3, 1e9})
            for (int repeat = 0; repeat < 50; repeat++) {
                const Bodies bodies(dice, 8, 0);
                ResponseSettings settings;
                settings.stiffness = stiffness;
                settings.h = 1.0 / 60;
                std::vector<Vec3> impulses;
                response.find(bodies.touches, coupling_table(bodies.coupling), settings, impulses);
                ASSERT_EQ(impulses.size(), bodies.touches.size());
                EXPECT_LT(bodies.gain(impulses), 1e-5) << response.name << " " << stiffness;
                for (size_t i = 0; i < bodies.touches.size(); i++) {
                    const double push = impulses[i].dot(bodies.touches[i].normal);
                    EXPECT_GE(push, 0);
                    EXPECT_LE((impulses[i] - push * bodies.touches[i].normal).norm(), 0.4 * push + 1e-9);
                }
            }
    }
}

TEST(Response, PartsTwoBodiesThatOverlapAtRest) {
    Touch touch = {Vec3::UnitY(), Vec3::Zero(), 0, 0.5};
    touch.depth = 0.01;
    touch.least_correction = 0.12;
    const std::vector<std::vector<Coupling>> own = {{{0, 2 * Mat3::Identity()}}};
    ResponseSettings settings;
    settings.h = 1.0 / 60;
    std::vector<Vec3> impulses;
    // Position corrections separate them without giving velocity.
    EXPECT_NEAR(2 * correct_positions({touch}, coupling_table(own), settings.limits)[0].y(), 0.12, 1e-9);
    response_row(FROND_RESPONSE_IMPULSE).find({touch}, coupling_table(own), settings, impulses);
    EXPECT_NEAR(impulses[0].norm(), 0, 1e-12);
    const ResponseRow& penalty = response_row(FROND_RESPONSE_PENALTY);
    penalty.find({touch}, coupling_table(own), settings, impulses);
    EXPECT_NEAR(impulses[0].norm(), 0, 1e-12);
    // Without corrections a spring separates them, no faster than is asked however stiff it is.
    touch.least_correction = Touch::NO_CORRECTION;
    touch.bias_velocity = 0.1;
    settings.stiffness = 1e12;
    EXPECT_TRUE(correct_positions({touch}, coupling_table(own), settings.limits).empty());
    penalty.find({touch}, coupling_table(own), settings, impulses);
    EXPECT_NEAR(2 * impulses[0].y(), 0.1, 1e-6);
    EXPECT_EQ(response_row(FROND_RESPONSE_NONE).find, nullptr);
}

TEST(Response, WhatCannotPartDoesNotPushWithoutEnd) {
    std::vector<Touch> touches(2, Touch{Vec3::UnitY(), Vec3::Zero(), 0, 0});
    for (Touch& touch : touches) touch.depth = 0.01, touch.least_correction = 0.12, touch.most_correction = 0.1;
    const std::vector<std::vector<Coupling>> own = {{{0, 1e-3 * Mat3::Identity()}}, {{1, 2 * Mat3::Identity()}}};
    const std::vector<Vec3> corrections = correct_positions(touches, coupling_table(own), {});
    EXPECT_NEAR(corrections[0].y(), 0.1, 1e-12);
    EXPECT_NEAR(corrections[1].y(), 0.06, 1e-9);
}

TEST(Impulses, OfBodiesThatHaveNothingToDoWithEachOtherAreFoundApart) {
    Dice dice(9);
    const Bodies first(dice, 3, 0), second(dice, 4, 0);
    std::vector<Touch> touches = first.touches;
    touches.insert(touches.end(), second.touches.begin(), second.touches.end());
    std::vector<std::vector<Coupling>> coupling = first.coupling;
    for (std::vector<Coupling> list : second.coupling) {
        for (Coupling& c : list) c.other += 3;
        coupling.push_back(list);
    }
    std::vector<Vec3> together, alone, other;
    find_impulses(touches, coupling_table(coupling), {}, together);
    find_impulses(first.touches, coupling_table(first.coupling), {}, alone);
    find_impulses(second.touches, coupling_table(second.coupling), {}, other);
    alone.insert(alone.end(), other.begin(), other.end());
    EXPECT_EQ(together, alone);
}

}  // namespace response_tests

}  // namespace frond::test
