// Beams with known answers: static deflection under refinement, and the numerical damping of implicit Euler.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "support/dense.hpp"
#include "support/rig.hpp"

namespace frond::test {
namespace {

// Deflection of the end of a square beam along z, clamped at z = 0, under a force P on its end; one step of ages is
// static.
double tip_deflection(int across, double width, double length, double E, double P, frond_mechanics which) {
    const int along = int(std::lround(across * length / width));
    Rig rig(box_model(across, across, along, {width, width, length}, {1000, E, 0}), plain_settings(which));
    rig.pin_below(2, 0);
    const int end = (across + 1) * (across + 1), first = rig.node_count() - end;
    for (int i = first; i < rig.node_count(); ++i) point(rig.loads.force, i).y() = -P / end;
    const VecX start = rig.motion.x;
    EXPECT_TRUE(rig.step(1e5).ok);
    double sum = 0;
    for (int i = first; i < rig.node_count(); ++i) sum += point(start, i).y() - point(rig.motion.x, i).y();
    return sum / end;
}

TEST(Cantilever, ConvergesToTheBeamFormulaWithTheSquareOfTheCellSize) {
    for (int which = 0; which < FROND_MECHANICS_COUNT; ++which) {
        const double a = 0.1, L = 0.5, E = 1e7, P = 0.1;
        // Bending and shear of a square beam with nu = 0 (shear factor 5/6).
        const double I = a * a * a * a / 12, G = E / 2;
        const double exact = P * L * L * L / (3 * E * I) + P * L / (5.0 / 6 * G * a * a);
        std::array<double, 3> error;
        for (size_t n = 0; n < 3; ++n)
            error[n] = 1 - tip_deflection(2 << n, a, L, E, P, frond_mechanics(which)) / exact;
        EXPECT_GT(error[0], error[1]);
        EXPECT_GT(error[1] / error[2], 2.5) << error[0] << " " << error[1] << " " << error[2];
        EXPECT_LT(error[2], 0.12);
        // Extrapolated with the observed order it meets the formula.
        const double ratio = (error[0] - error[1]) / (error[1] - error[2]);
        EXPECT_NEAR(error[2] - (error[1] - error[2]) / (ratio - 1), 0, 0.03)
            << error[0] << " " << error[1] << " " << error[2];
    }
}

// The first mode of a small beam: implicit Euler's amplitude goes down by 1 / sqrt(1 + z^2) a step and turns by atan z.
TEST(ImplicitEuler, DampsAOneHertzModeAsItsClosedFormSays) {
    for (int mass = 0; mass < FROND_MASS_COUNT; ++mass) {
        Rig rig(box_model(1, 1, 6, {0.1, 0.1, 0.6}, {1000, 1e5, 0.3}), plain_settings(FROND_TET_LINEAR),
                frond_mass(mass));
        rig.pin_below(2, 0);
        const Eigen::Index n = rig.motion.x.size();

        // Dense mass and stiffness of the free nodes, which are the last ones.
        BlockMatrix K;
        K.set_pattern(elements_of(*rig.system).pattern);
        K.set_zero();
        mechanics(FROND_TET_LINEAR).add_stiffness(elements_of(*rig.system), rig.motion.x, Tangent::exact, 1, K);
        Eigen::MatrixXd M(n, n);
        for (Eigen::Index i = 0; i < n; ++i)
            for (Eigen::Index j = 0; j < n; ++j)
                M(i, j) = 0.5 * (kinetic_energy(*rig.system, VecX::Unit(n, i) + VecX::Unit(n, j)) -
                                 kinetic_energy(*rig.system, VecX::Unit(n, i) - VecX::Unit(n, j)));
        const Eigen::Index free = n - 12;
        const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(dense(K).bottomRightCorner(free, free),
                                                                              M.bottomRightCorner(free, free));
        VecX mode = VecX::Zero(n);
        mode.tail(free) = modes.eigenvectors().col(0);
        const double omega = std::sqrt(modes.eigenvalues()[0]);

        // The time step that makes the mode one of 1 Hz at 1/60 s.
        const double z = 2 * M_PI / 60, h = z / omega;
        rig.motion.x += 1e-3 * mode;
        const int steps = 60;
        for (int step = 1; step <= steps; ++step) {
            ASSERT_TRUE(rig.step(h).ok);
            const double q = mode.dot(M * (rig.motion.x - positions_of(*rig.model)));
            const double w = mode.dot(M * rig.motion.v);
            const double amplitude = 1e-3 * std::pow(1 + z * z, -0.5 * step), angle = step * std::atan(z);
            ASSERT_NEAR(q, amplitude * std::cos(angle), 1e-9);
            ASSERT_NEAR(w / omega, -amplitude * std::sin(angle), 1e-9);
        }
        // The damping ratio that this is, read off the last state: 5 % at 1 Hz.
        const double q = mode.dot(M * (rig.motion.x - positions_of(*rig.model))),
                     w = mode.dot(M * rig.motion.v) / omega;
        const double zeta = -std::log(std::hypot(q, w) / 1e-3) / (steps * std::atan(z));
        EXPECT_NEAR(zeta, std::log(1 + z * z) / (2 * std::atan(z)), 1e-6);
        EXPECT_NEAR(zeta, 0.05, 0.005);
    }
}

// 1 m x 0.1 m x 0.1 m, clamped at z = 0, under its own weight.
Rig drooping_beam(int across, int along) {
    Rig rig(box_model(across, across, along, {0.1, 0.1, 1}, {800, 1e7, 0.3}), plain_settings());
    rig.pin_below(2, 0);
    rig.loads.gravity = {0, -9.81, 0};
    return rig;
}
double droop(const Rig& rig, int across) {
    const int end = (across + 1) * (across + 1);
    double sum = 0;
    for (int i = rig.node_count() - end; i < rig.node_count(); ++i)
        sum += (rig.model->cage.nodes[size_t(i)].y() - point(rig.motion.x, i).y()) / end;
    return sum;
}
double static_droop(int across, int along) {
    Rig rig = drooping_beam(across, along);
    rig.settings.newton_iterations = 10;
    rig.steps(6, 100.0);
    return droop(rig, across);
}
void scramble(Rig& rig, uint64_t seed) {
    Dice dice(seed);
    const double length = rig.model->cage.nodes.back().z();
    for (int i = 0; i < rig.node_count(); ++i)
        if (!rig.motion.pinned[size_t(i)])
            point(rig.motion.x, i) = Vec3(dice.uniform(0, 0.1), dice.uniform(0, 0.1), dice.uniform(0, length));
}

// In 1170 tets it is known to droop 0.0931 m; in truth, without the tets' stiffness, 0.1164 m.
TEST(Cantilever, DroopsUnderItsWeightAsOtherPrograms) {
    EXPECT_NEAR(static_droop(3, 26), 0.0931, 0.01 * 0.0931);
}

TEST(Cantilever, UnfoldsFromBeingScrambled) {
    Rig rig = drooping_beam(3, 26);
    scramble(rig, 1);
    EXPECT_GT(rig.step(1.0 / 60).inverted, 300);
    rig.steps(118, 1.0 / 60);
    EXPECT_EQ(rig.step(1.0 / 60).inverted, 0);
}

// A stout one, since a slender beam may keep a full turn of twist, which is a true balance.
TEST(Cantilever, ComesToRestAsIfItHadNotBeenScrambled) {
    for (uint64_t seed = 1; seed <= 8; ++seed) {
        Rig rig(box_model(2, 2, 4, {0.1, 0.1, 0.2}, {800, 1e5, 0.3}), plain_settings());
        rig.pin_below(2, 0);
        rig.settings.newton_iterations = seed % 2 ? 1 : 4;
        scramble(rig, seed);
        rig.steps(300, 1.0 / 60);
        EXPECT_LT(rig.elastic_energy(), 1e-6) << seed;
    }
}

TEST(Corotational, SwingsFarWithoutSwelling) {
    // A soft beam laid over by its weight keeps its volume within the strain that it has.
    Rig rig(box_model(2, 16, 2, {0.05, 0.8, 0.05}, {900, 4e5, 0.3}), plain_settings());
    rig.settings.stiffness_damping = 0.02;
    rig.pin_below(1, 0);
    rig.loads.gravity = {9.81, -3, 0};
    rig.steps(400, 1.0 / 60);
    const TetElements& elements = elements_of(*rig.system);
    double volume = 0, before = 0;
    for (size_t e = 0; e < elements.tets.size(); ++e) {
        const Tet& t = elements.tets[e];
        volume += tet_volume(point(rig.motion.x, t[0]), point(rig.motion.x, t[1]), point(rig.motion.x, t[2]),
                             point(rig.motion.x, t[3]));
        before += elements.volume[e];
    }
    EXPECT_GT(point(rig.motion.x, rig.node_count() - 1).x(), 0.3);
    EXPECT_NEAR(volume, before, 0.03 * before);
}

}  // namespace
}  // namespace frond::test
