// Beams with known solutions: static deflection under refinement and under their weight, the first natural frequency,
// and recovery from any start.
#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "support/rig.hpp"

namespace frond::test {
namespace cantilever_tests {

// Returns the end's deflection of a square beam along z, clamped at z = 0, under a force P; one very long step is
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
    for (int which = 0; which < TET_MECHANICS; ++which) {
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
        // Extrapolated with the observed order, the deflection agrees with the formula.
        const double ratio = (error[0] - error[1]) / (error[1] - error[2]);
        EXPECT_NEAR(error[2] - (error[1] - error[2]) / (ratio - 1), 0, 0.03)
            << error[0] << " " << error[1] << " " << error[2];
    }
}

// A square beam of quadratic tets, one cell across, its cells `aspect` times as long as thick, clamped at z = 0.
struct SlenderBeam {
    static constexpr double A = 0.02, L = 0.8, E = 2e8, NU = 0.3, DENSITY = 900;  // [m], [Pa], [kg/m^3]
    static constexpr double INERTIA = A * A * A * A / 12, SHEAR = E / (2 * (1 + NU)) * 0.85 * A * A;
    Rig rig;
    SlenderBeam(int aspect, frond_mechanics which, int order, frond_mass mass = FROND_MASS_LUMPED)
        : rig(box_model(1, 1, int(std::lround(L / (aspect * A))), {A, A, L}, {DENSITY, E, NU}), settings(which, order),
              mass) {
        rig.pin_below(2, 0);
    }
    static RigSettings settings(frond_mechanics which, int order) {
        RigSettings s = plain_settings(which);
        s.order = order;
        return s;
    }
    // Returns the deflection under a small force on the end, as a share of the formula's with shear (Cowper's factor).
    double deflection() {
        constexpr double P = 1e-3;
        std::vector<int> end;
        for (int i = 0; i < rig.node_count(); ++i)
            if (point(rig.motion.x, i).z() > L * (1 - 1e-9)) end.push_back(i);
        const VecX start = rig.motion.x;
        for (int i : end) point(rig.loads.force, i).y() = P / double(end.size());
        EXPECT_TRUE(rig.step(1e5).ok);
        double sum = 0;
        for (int i : end) sum += (point(rig.motion.x, i) - point(start, i)).y() / double(end.size());
        return sum / (P * L * L * L / (3 * E * INERTIA) + P * L / SHEAR);
    }
    // Returns the first natural frequency, as a share of Euler's and Bernoulli's.
    double frequency() const {
        const Elements& elements = elements_of(*rig.system);
        BlockMatrix matrix;
        matrix.set_pattern(elements.pattern);
        matrix.set_zero();
        rig.row().add_stiffness(elements, rig.motion.x, Tangent::exact, 1, matrix);
        const Eigen::MatrixXd K = dense(matrix);
        const Masses masses = rig.row().masses(elements, rig.masses);
        for (int k = 0; k < elements.pattern.block_count(); ++k)
            matrix.block(k) = masses.slot[size_t(k)] * Mat3::Identity();
        const Eigen::MatrixXd M = dense(matrix);
        std::vector<int> free;
        for (int i = 0; i < 3 * rig.node_count(); ++i)
            if (!rig.motion.pinned[size_t(i / 3)]) free.push_back(i);
        const Modes modes = modes_of(K(free, free), M(free, free));
        const double exact = 1.87510407 * 1.87510407 * std::sqrt(E * INERTIA / (DENSITY * A * A)) / (L * L);
        return std::sqrt(modes.values[0]) / exact;
    }
};

// One cell across suffices: bending is within 5 % if cells are five times as long as thick. The error decreases with
// the number of cells along; most of it comes from the clamp in the first cell.
TEST(Quadratic, BendsInSlenderCells) {
    for (int which = 0; which < TET_MECHANICS; ++which) {
        const auto share = [&](int aspect, int order) {
            return SlenderBeam(aspect, frond_mechanics(which), order).deflection();
        };
        EXPECT_NEAR(share(1, 2), 1, 0.01) << which;
        EXPECT_NEAR(share(2, 2), 1, 0.015) << which;
        EXPECT_NEAR(share(5, 2), 1, 0.03) << which;
        EXPECT_NEAR(share(10, 2), 1, 0.065) << which;
        EXPECT_LT(share(5, 1), 0.05) << "linear tets do not";
    }
}

TEST(Quadratic, HasTheFirstFrequencyOfABeam) {
    for (int mass = 0; mass < FROND_MASS_COUNT; ++mass) {
        const auto share = [&](int aspect) {
            return SlenderBeam(aspect, FROND_MECHANICS_TET_COROTATIONAL, 2, frond_mass(mass)).frequency();
        };
        EXPECT_NEAR(share(5), 1, 0.03) << mass;
        EXPECT_NEAR(share(10), 1, 0.06) << mass;
    }
}

// Returns a beam of 1 m x 0.1 m x 0.1 m, clamped at z = 0, under its own weight.
Rig drooping_beam(int across, int along, frond_mechanics which = FROND_MECHANICS_TET_COROTATIONAL, int order = 1) {
    RigSettings settings = plain_settings(which);
    settings.order = order;
    Rig rig(box_model(across, across, along, {0.1, 0.1, 1}, {800, 1e7, 0.3}), settings);
    rig.pin_below(2, 0);
    rig.loads.gravity = {0, -9.81, 0};
    return rig;
}
double droop(const Rig& rig, int across) {
    const int end = (across + 1) * (across + 1), corners = int(rig.model->cage.nodes.size());
    double sum = 0;
    for (int i = corners - end; i < corners; ++i)
        sum += (rig.model->cage.nodes[size_t(i)].y() - point(rig.motion.x, i).y()) / end;
    return sum;
}
double static_droop(int across, int along, int order = 1) {
    Rig rig = drooping_beam(across, along, FROND_MECHANICS_TET_COROTATIONAL, order);
    rig.settings.newton_iterations = 10;
    rig.steps(6, 100.0);
    return droop(rig, across);
}
void scramble(Rig& rig, uint64_t seed) {
    Dice dice(seed);
    const double length = rig.model->cage.nodes.back().z();
    for (int i = 0; i < rig.node_count(); ++i) {
        if (rig.motion.pinned[size_t(i)]) continue;
        // One by one: compilers are free in the order of arguments.
        const double z = dice.uniform(0, length), y = dice.uniform(0, 0.1), x = dice.uniform(0, 0.1);
        point(rig.motion.x, i) = Vec3(x, y, z);
    }
}

// With 1170 tets the known droop is 0.0931 m; the exact one, without locking of the tets, is 0.1164 m.
TEST(Cantilever, DroopsUnderItsWeightAsOtherPrograms) {
    EXPECT_NEAR(static_droop(3, 26), 0.0931, 0.01 * 0.0931);
}
// The exact droop with one cell across: 50 tets.
TEST(Quadratic, DroopsUnderItsWeightAsABeam) {
    EXPECT_NEAR(static_droop(1, 10, 2), 0.1164, 0.02 * 0.1164);
}

// Uses the default integrator of plants and the paper's own.
TEST(Cantilever, UnfoldsFromBeingScrambled) {
    for (frond_mechanics which : {FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_TET_NEOHOOKEAN})
        for (frond_integrator integrator : {FROND_INTEGRATOR_IMPLICIT_EULER, FROND_INTEGRATOR_BDF2}) {
            Rig rig = drooping_beam(3, 26, which);
            rig.settings.integrator = integrator;
            rig.settings.mass_damping = 0.1;
            rig.settings.stiffness_damping = 0.002;
            scramble(rig, 1);
            EXPECT_GT(rig.step(1.0 / 60).inverted, 300);
            rig.steps(118, 1.0 / 60);
            EXPECT_EQ(rig.step(1.0 / 60).inverted, 0) << which << " " << integrator;
        }
}
TEST(Quadratic, UnfoldsFromBeingScrambled) {
    for (frond_mechanics which : {FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_TET_NEOHOOKEAN})
        for (frond_integrator integrator : {FROND_INTEGRATOR_IMPLICIT_EULER, FROND_INTEGRATOR_BDF2}) {
            Rig rig = drooping_beam(1, 8, which, 2);
            rig.settings.integrator = integrator;
            rig.settings.mass_damping = 0.1;
            rig.settings.stiffness_damping = 0.002;
            scramble(rig, 1);
            EXPECT_GT(rig.step(1.0 / 60).inverted, 10);
            rig.steps(118, 1.0 / 60);
            EXPECT_EQ(rig.step(1.0 / 60).inverted, 0) << which << " " << integrator;
        }
}

// A stout beam, since a slender one may keep a full turn of twist, which is a true equilibrium. Even this one keeps a
// knot now and then.
TEST(Cantilever, ComesToRestAsIfItHadNotBeenScrambled) {
    for (frond_mechanics which : {FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_TET_NEOHOOKEAN})
        for (frond_integrator integrator : {FROND_INTEGRATOR_IMPLICIT_EULER, FROND_INTEGRATOR_BDF2}) {
            int recovered = 0;
            for (uint64_t seed = 1; seed <= 8; ++seed) {
                Rig rig(box_model(2, 2, 4, {0.1, 0.1, 0.2}, {800, 1e5, 0.3}), plain_settings(which));
                rig.settings.integrator = integrator;
                rig.settings.mass_damping = integrator == FROND_INTEGRATOR_BDF2 ? 2 : 0;
                rig.pin_below(2, 0);
                rig.settings.newton_iterations = seed % 2 ? 1 : 4;
                scramble(rig, seed);
                const double before = rig.elastic_energy();
                rig.steps(integrator == FROND_INTEGRATOR_BDF2 ? 600 : 300, 1.0 / 60);
                EXPECT_LT(rig.elastic_energy(), before) << seed << " " << which << " " << integrator;
                recovered += rig.elastic_energy() < 1e-6;
            }
            const bool first =
                which == FROND_MECHANICS_TET_COROTATIONAL && integrator == FROND_INTEGRATOR_IMPLICIT_EULER;
            EXPECT_GE(recovered, first ? 8 : 6) << which << " " << integrator;
        }
}

TEST(Corotational, SwingsFarWithoutSwelling) {
    // A soft beam that its weight bends over keeps its volume within the accuracy of its strain.
    Rig rig(box_model(2, 16, 2, {0.05, 0.8, 0.05}, {900, 4e5, 0.3}), plain_settings());
    rig.settings.stiffness_damping = 0.02;
    rig.pin_below(1, 0);
    rig.loads.gravity = {9.81, -3, 0};
    rig.steps(400, 1.0 / 60);
    const TetElements& elements = tets_of(*rig.system);
    double volume = 0, before = 0;
    for (size_t e = 0; e < elements.tets.size(); ++e) {
        volume += tet_volume(rig.motion.x, elements.tets[e]);
        before += elements.volume[e];
    }
    EXPECT_GT(point(rig.motion.x, rig.node_count() - 1).x(), 0.3);
    EXPECT_NEAR(volume, before, 0.03 * before);
}

}  // namespace cantilever_tests

}  // namespace frond::test
