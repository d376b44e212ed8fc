// A step that fails leaves the motion unchanged, to the bit, and the next one continues.
#include <gtest/gtest.h>

#include <functional>

#include "core/error.hpp"
#include "support/rig.hpp"

namespace frond::test {
namespace failure_tests {

constexpr double H = 1.0 / 60;

struct Misuse {
    const char* name;
    std::function<void(Rig& rig, double& h)> spoil;
};
std::vector<Misuse> misuses() {
    const double nan = std::nan(""), inf = HUGE_VAL;
    return {
        {"force", [=](Rig& r, double&) { r.loads.force[5] = nan; }},
        {"infinite_force", [=](Rig& r, double&) { r.loads.force[5] = inf; }},
        {"gravity", [=](Rig& r, double&) { r.loads.gravity.y() = nan; }},
        {"huge_force", [](Rig& r, double&) { r.loads.force.setConstant(1e300); }},
        {"huge_velocity", [](Rig& r, double&) { r.motion.v.setConstant(1e200), r.motion.v[0] = -1e307; }},
        {"position", [=](Rig& r, double&) { r.motion.x[0] = nan; }},
        {"velocity", [=](Rig& r, double&) { r.motion.v[3] = inf; }},
        {"pin", [=](Rig& r, double&) { r.motion.pin_target[1] = nan; }},
        {"zero_time", [](Rig&, double& h) { h = 0; }},
        {"negative_time", [](Rig&, double& h) { h = -1; }},
        {"time", [=](Rig&, double& h) { h = nan; }},
        {"endless_time", [=](Rig&, double& h) { h = inf; }},
        {"damping", [=](Rig& r, double&) { r.settings.mass_damping = nan; }},
        {"negative_damping", [](Rig& r, double&) { r.settings.stiffness_damping = -1; }},
        {"integrator", [](Rig& r, double&) { r.settings.integrator = FROND_INTEGRATOR_COUNT; }},
        {"linear_solver", [](Rig& r, double&) { r.settings.linear_solver = FROND_LINEAR_SOLVER_COUNT; }},
        {"spring_tet",
         [](Rig& r, double&) {
             r.loads.springs.push_back(tet_spring(*r.system, 0, {1, 0, 0, 0}, Vec3::Zero(), 1));
             r.loads.springs.back().attachment.node[0] = 9999;
         }},
        {"spring_weight",
         [=](Rig& r, double&) {
             r.loads.springs.push_back(tet_spring(*r.system, 0, {nan, 0, 0, 0}, Vec3::Zero(), 1));
         }},
        {"spring_stiffness",
         [](Rig& r, double&) {
             r.loads.springs.push_back(tet_spring(*r.system, 0, {1, 0, 0, 0}, Vec3::Zero(), -1));
         }},
        {"short_force", [](Rig& r, double&) { r.loads.force.resize(3); }},
        {"short_velocity", [](Rig& r, double&) { r.motion.v.resize(3), r.motion.v.setZero(); }},
        {"short_pins", [](Rig& r, double&) { r.motion.pinned.resize(2); }},
    };
}

TEST(Failure, LeavesTheMotionUnchanged) {
    for (int solver = 0; solver < FROND_LINEAR_SOLVER_COUNT; ++solver)
        for (int newton : {1, 4})
            for (const Misuse& misuse : misuses()) {
                Rig rig(box_model(1, 3, 1, {0.1, 0.3, 0.1}), plain_settings());
                rig.settings.linear_solver = frond_linear_solver(solver);
                rig.settings.newton_iterations = newton;
                rig.pin_below(1, 0);
                rig.loads.gravity = {0, -9.81, 0};
                rig.steps(3, H);
                const Motion good = rig.motion;
                const Vec3 gravity = rig.loads.gravity;  // the only load
                const RigSettings settings = rig.settings;
                double h = H;
                misuse.spoil(rig, h);
                const VecX x = rig.motion.x, v = rig.motion.v;
                EXPECT_FALSE(rig.step(h).ok) << misuse.name;
                ASSERT_EQ(std::memcmp(rig.motion.x.data(), x.data(), sizeof(double) * size_t(x.size())), 0);
                ASSERT_EQ(std::memcmp(rig.motion.v.data(), v.data(), sizeof(double) * size_t(v.size())), 0);

                // After the fault is removed, the same workspace continues as if nothing had happened.
                rig.motion = good;
                rig.loads = {};
                rig.loads.gravity = gravity;
                rig.settings = settings;
                ASSERT_TRUE(rig.step(H).ok) << misuse.name;
                Rig twin(box_model(1, 3, 1, {0.1, 0.3, 0.1}), settings);
                twin.motion = good;
                twin.loads.gravity = gravity;
                ASSERT_TRUE(twin.step(H).ok);
                EXPECT_EQ(rig.motion.x, twin.motion.x) << misuse.name;
            }
}

TEST(Failure, ANodeWithoutTetsDoesNotStopTheOthers) {
    Model model = box_model(1, 2, 1, {0.1, 0.2, 0.1});
    model.cage.nodes.push_back({1, 1, 1});
    Rig rig(model, plain_settings());
    rig.loads.gravity = {0, -9.81, 0};
    rig.steps(10, H);
    EXPECT_LT(point(rig.motion.x, 0).y(), -0.1);
    EXPECT_EQ(Vec3(point(rig.motion.x, rig.node_count() - 1)), Vec3(1, 1, 1));
}

TEST(Failure, ASystemNeedsSoundInput) {
    EXPECT_THROW(make_system(nullptr, FROND_MECHANICS_TET_LINEAR, FROND_MASS_LUMPED), Error);
    EXPECT_THROW(make_system(shared_box(1, 1, 1, {1, 1, 1}), FROND_MECHANICS_TET_LINEAR, FROND_MASS_COUNT), Error);
    EXPECT_THROW(make_workspace(nullptr), Error);
}

TEST(Failure, CollapsedToAPointComesBack) {
    Rig rig(box_model(2, 2, 2, {0.1, 0.1, 0.1}, {900, 1e5, 0.3}), plain_settings());
    rig.settings.mass_damping = 2;
    rig.settings.stiffness_damping = 0.01;
    rig.motion.x.setZero();
    rig.steps(600, H);
    // A tet with all nodes in one point is in equilibrium, though an unstable one.
    Dice dice(1);
    rig.motion.x += dice.vector(rig.motion.x.size(), 1e-4);
    rig.steps(1200, H);
    EXPECT_LT(rig.elastic_energy(), 1e-9);
}

}  // namespace failure_tests

}  // namespace frond::test
