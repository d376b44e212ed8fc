// Springs: implicit, in equilibrium with gravity, and acting only on the nodes of their tet.
#include <gtest/gtest.h>

#include "support/rig.hpp"

namespace frond::test {
namespace springs_tests {

struct EverySpring : EveryCombination {
    const double H = time_step();
};
INSTANTIATE_TEST_SUITE_P(Springs, EverySpring, testing::ValuesIn(every_combination()), combination_name);

TEST_P(EverySpring, HangsFromASpringByItsWeight) {
    if (is_explicit()) GTEST_SKIP() << "a million steps";
    Rig rig(single_tet_model(0.1, {900, 1e6, 0.3}), settings(), mass());
    rig.settings.mass_damping = 5;
    rig.loads.gravity = {0, -9.81, 0};
    const std::array<double, 4> middle = {0.25, 0.25, 0.25, 0.25};
    const Vec3 target(0.3, 0.4, 0.5);
    const double stiffness = 10;
    rig.loads.springs.push_back(tet_spring(*rig.system, 0, middle, target, stiffness));
    rig.steps(1200, H);
    const Vec3 held = attachment_place(rig.loads.springs[0].attachment, rig.motion.x);
    const Vec3 expected = target + rig.mass() * rig.loads.gravity / stiffness;
    EXPECT_NEAR((held - expected).norm(), 0, 1e-7);
}

TEST_P(EverySpring, PullsAPinnedBodyUntilElasticForceBalancesTheSpring) {
    if (is_explicit()) GTEST_SKIP() << "a million steps";
    Rig rig(box_model(1, 4, 1, {0.1, 0.4, 0.1}, {900, 1e5, 0.3}), settings(), mass());
    rig.settings.newton_iterations = 10;
    rig.settings.spectral_radius = 0;  // comes to rest fastest
    rig.pin_below(1, 0);
    const int tet = int(rig.model->cage.tets.size()) - 1;
    const Spring spring = tet_spring(*rig.system, tet, {0.1, 0.2, 0.3, 0.4}, {0.3, 0.3, 0.1}, 50);
    rig.loads.springs.push_back(spring);
    rig.steps(60, 1.0);
    EXPECT_LT(rig.motion.v.cwiseAbs().maxCoeff(), 1e-9);

    // At rest the elastic force of each free node balances its share of the spring's force.
    VecX f = VecX::Zero(rig.motion.x.size());
    rig.row().add_force(elements_of(*rig.system), rig.motion.x, f);
    Vec3 held = Vec3::Zero();
    const Attachment& attachment = spring.attachment;
    for (size_t a = 0; a < size_t(attachment.count); ++a)
        held += attachment.weight[a] * point(rig.motion.x, attachment.node[a]);
    const Vec3 pull = spring.stiffness * (spring.target - held);
    EXPECT_GT(pull.norm(), 0.5);
    for (size_t a = 0; a < size_t(attachment.count); ++a) point(f, attachment.node[a]) += attachment.weight[a] * pull;
    for (int i = 0; i < rig.node_count(); ++i)
        EXPECT_NEAR(rig.motion.pinned[size_t(i)] ? 0 : point(f, i).norm(), 0, 1e-6 * pull.norm()) << i;
}

TEST_P(EverySpring, StaysStableHoweverStiff) {
    if (is_explicit()) GTEST_SKIP() << "it does not";
    Rig rig(tree_model(6, 3, 3, {900, 1e7, 0.3}), settings(), mass());
    rig.settings.tolerance = 1e-8;
    rig.settings.spectral_radius = 0;
    rig.pin_below(1, 0);
    const Tet& corners = rig.model->cage.tets[60];
    const Vec3 start = point(rig.motion.x, corners[0]);
    // A single corner inverts a quadratic tet sooner.
    const double pull = GetParam().order == 1 ? 0.01 : 0.003;
    rig.loads.springs.push_back(tet_spring(*rig.system, 60, {1, 0, 0, 0}, start + Vec3(pull, 0, 0), 1e9));
    rig.steps(60, H);
    EXPECT_NEAR((point(rig.motion.x, corners[0]) - rig.loads.springs[0].target).norm(), 0, 1e-5);
}

}  // namespace springs_tests

}  // namespace frond::test
