// Drags: a body approaches the velocity of the drag at any strength and with every integrator; drags remove energy.
#include <gtest/gtest.h>

#include "solve/drags.hpp"
#include "support/rig.hpp"

namespace frond::test {
namespace drags_tests {

struct EveryDrag : EveryCombination {
    const double H = time_step();
    RigSettings undamped() const {
        RigSettings s = settings();
        s.spectral_radius = 0;
        return s;
    }
};
INSTANTIATE_TEST_SUITE_P(Drags, EveryDrag, testing::ValuesIn(every_combination()), combination_name);

const Vec3 WIND(3, -1, 2);

// Adds a drag to every corner of each tet, so that the body is carried along as a whole.
void drag_corners(Rig& rig, double damping) {
    rig.loads.drags.clear();
    const TetElements& elements = tets_of(*rig.system);
    for (size_t t = 0; t < rig.model->cage.tets.size(); ++t)
        for (size_t k = 0; k < 4; ++k) {
            std::array<double, 4> weights = {0, 0, 0, 0};
            weights[k] = 1;
            const Attachment attachment = tet_attachment(place_in_tet(elements.nodes, elements.tets, int(t), weights));
            rig.loads.drags.push_back({attachment, damping * WIND, damping * Mat3::Identity()});
        }
}

TEST_P(EveryDrag, FreeBodyNearsTheSpeedOfTheAirAsTheFormulaSays) {
    Rig rig(single_tet_model(0.1, {900, 1e6, 0.3}), undamped(), mass());
    // Corners and edge nodes of a quadratic tet have different masses.
    const double few_per_cent = GetParam().order == 1 ? 0.05 : 0.15;
    const double times = is_explicit() ? 500 : 30, time = times * H, rate = 1 / time;
    drag_corners(rig, rate * rig.mass() / 4);
    rig.steps(int(times), H);
    const Vec3 mean = rig.momentum() / rig.mass();
    EXPECT_NEAR((mean - (1 - std::exp(-1)) * WIND).norm(), 0, few_per_cent * WIND.norm());
}

TEST_P(EveryDrag, ManyTimesStifferThanTheStepOverthrowsNothing) {
    Rig rig(box_model(1, 2, 1, {0.1, 0.2, 0.1}, {900, 1e5, 0.3}), undamped(), mass());
    drag_corners(rig, 1e6 * rig.mass() / H);
    for (int n = 0; n < 20; ++n) {
        ASSERT_TRUE(rig.step(H).ok);
        // TR-BDF2 includes half of the force at the start.
        EXPECT_LT(rig.motion.v.cwiseAbs().maxCoeff(), 3 * WIND.norm()) << "step " << n;
    }
    // The edge nodes of a quadratic tet have no drag and continue to vibrate.
    if (GetParam().order == 2) return;
    const Vec3 mean = rig.momentum() / rig.mass();
    EXPECT_NEAR((mean - WIND).norm(), 0, 0.01 * WIND.norm());
}

TEST_P(EveryDrag, StillAirTakesEnergyFromASway) {
    RigSettings s = undamped();
    s.newton_iterations = 4;
    const auto energy_after = [&](double damping) {
        Rig rig(box_model(1, 3, 1, {0.1, 0.3, 0.1}, {900, 1e5, 0.3}), s, mass());
        rig.pin_below(1, 0);
        for (int i = 0; i < rig.node_count(); ++i)
            if (!rig.motion.pinned[size_t(i)]) point(rig.motion.v, i).x() = 0.5 * point(rig.motion.x, i).y();
        drag_corners(rig, damping);
        for (Drag& drag : rig.loads.drags) drag.force.setZero();
        rig.steps(is_explicit() ? 2000 : 10, H);
        return rig.elastic_energy() + kinetic_energy(*rig.system, rig.motion.v);
    };
    EXPECT_LT(energy_after(0.02), 0.99 * energy_after(0));
}

TEST(Drags, ForceIsMinusTheGradientOfThePotential) {
    const Rig rig(tree_model(4, 2, 2), plain_settings());
    Dice dice(7);
    std::vector<Drag> drags;
    const TetElements& elements = tets_of(*rig.system);
    for (int t : {3, 17}) {
        const Mat3 R = dice.rotation();
        const Mat3 damping = R * Vec3(1, 2, 0).asDiagonal() * R.transpose();
        drags.push_back({tet_attachment(place_in_tet(elements.nodes, elements.tets, t, {0.1, 0.2, 0.3, 0.4})),
                         Vec3(dice.vector(3, 5)), damping});
    }
    ASSERT_TRUE(drags_are_sound(*rig.system, drags));
    const VecX v = dice.vector(rig.motion.x.size(), 1), dv = dice.vector(rig.motion.x.size(), 1);
    VecX force = VecX::Zero(v.size());
    add_drag_force(drags, rig.motion.x, v, force);
    constexpr double STEP = 1e-6;
    const double slope =
        (drag_potential(drags, rig.motion.x, v + STEP * dv) - drag_potential(drags, rig.motion.x, v - STEP * dv)) /
        (2 * STEP);
    EXPECT_NEAR(slope, -force.dot(dv), 1e-6 * force.norm() * dv.norm());

    // The damping is the derivative of the force, and nowhere exceeds the lumped one.
    BlockMatrix A;
    A.set_pattern(elements.pattern);
    A.set_zero();
    add_drag_damping(drags, rig.motion.x, 1, A);
    VecX change = VecX::Zero(v.size()), product;
    add_drag_force(drags, rig.motion.x, v + dv, change);
    A.multiply(dv, product);
    EXPECT_NEAR((change - force + product).norm(), 0, 1e-9 * product.norm());
    std::vector<Mat3> lumped;
    lump_drags(drags, size_t(rig.node_count()), 1, lumped);
    double most = 0;
    for (int i = 0; i < rig.node_count(); ++i) most += point(dv, i).dot(lumped[size_t(i)] * point(dv, i));
    EXPECT_LE(dv.dot(product), most);
}

TEST(Drags, ThatAreNotSoundAreRefused) {
    Rig rig(single_tet_model(0.1), plain_settings());
    drag_corners(rig, 1);
    EXPECT_TRUE(rig.step(0.01).ok);
    const std::vector<Drag> good = rig.loads.drags;
    rig.loads.drags[0].force.x() = NAN;
    EXPECT_FALSE(rig.step(0.01).ok);
    rig.loads.drags = good;
    rig.loads.drags[1].damping(1, 1) = INFINITY;
    EXPECT_FALSE(rig.step(0.01).ok);
    rig.loads.drags = good;
    rig.loads.drags[2].attachment.node[0] = 99;
    EXPECT_FALSE(rig.step(0.01).ok);
}

}  // namespace drags_tests

}  // namespace frond::test
