// Rods: force is minus the gradient of the energy, stiffness its derivative; rigid motion costs no energy; a tree that
// stands is in equilibrium as modelled.
#include <gtest/gtest.h>

#include <cmath>

#include "mechanics/rod_elements.hpp"
#include "mechanics/rotation.hpp"
#include "support/dense.hpp"
#include "support/meshes.hpp"

namespace frond::test {
namespace rod_tests {

// Returns a forked chain of flat, round and tapered segments in many directions.
Model chain_model(bool stands = false) {
    Model model;
    Organ organ;
    organ.name = organ.kind = "stem";
    organ.material.density = 900;
    organ.material.young = 1e8;
    organ.material.poisson = 0.3;
    model.organs = {organ};
    model.organ_stiffer = {1};
    const std::vector<Vec3> places = {{0, 0, 0}, {0.02, 0.3, 0}, {0.1, 0.55, 0.05}, {-0.2, 0.5, 0.1}, {-0.3, 0.4, 0.3}};
    const std::vector<int> parents = {-1, 0, 1, 1, 3};
    for (size_t i = 0; i < places.size(); ++i) {
        model.chain.nodes.push_back({places[i], 0.01, parents[i], 0, 0, 0.01});
        Section section = {};
        const Vec3 from = parents[i] < 0 ? Vec3(places[i] - 0.1 * Vec3::UnitY()) : places[size_t(parents[i])];
        section.length = (places[i] - from).norm();
        section.axis = (places[i] - from) / section.length;
        section.thin = section.axis.unitOrthogonal();
        section.thickness = 0.01;
        section.area = 2e-4;
        section.inertia_thin = 2e-9;
        section.inertia_wide = i % 2 ? 2e-9 : 5e-8;
        section.taper = i % 3 == 0 ? 0 : 0.25 * double(i) - 0.7;
        finish_section(organ, section);
        model.sections.push_back(section);
        model.chain_mass.push_back(0.05 + 0.01 * double(i));
    }
    model.stands_as_modelled = stands;
    return model;
}

// Returns displaced nodes, rotated by up to `turn`.
VecX deformed(const RodElements& elements, Dice& dice, double shift, double turn) {
    VecX x = elements.modelled;
    for (int i = 0; i < elements.node_count; ++i)
        for (int c = 0; c < 3; ++c) x[3 * i + c] += (i % 2 ? turn : shift) * dice.uniform(-1, 1);
    return x;
}

class EveryRod : public testing::TestWithParam<int> {
protected:
    frond_mechanics which = frond_mechanics(GetParam());
    const Mechanics& row = mechanics(which);
    VecX force(const Elements& elements, const VecX& x) const {
        VecX f = VecX::Zero(x.size());
        row.add_force(elements, x, f);
        return f;
    }
    static constexpr double BACK = 1.0 / 3;  // of bdf2 with steps of one length
    // Returns the forces of a stage that follows steps of h, far more of them by damping than elastic.
    VecX damped_ahead(const Elements& elements, const VecX& x, const VecX& v, double h, const StageBase& base) const {
        VecX f = VecX::Zero(x.size());
        const VecX way = f;
        BlockMatrix A;
        A.set_pattern(elements.pattern);
        A.set_zero();
        row.add_ahead(elements, x, {way.data(), v.data(), 2 * h / 3, 1e6, {}, base}, f, A);
        return f;
    }
    Eigen::MatrixXd stiffness(const Elements& elements, const VecX& x, Tangent tangent) const {
        BlockMatrix K;
        K.set_pattern(elements.pattern);
        K.set_zero();
        row.add_stiffness(elements, x, tangent, 1, K);
        return dense(K);
    }
};
INSTANTIATE_TEST_SUITE_P(Rods, EveryRod, testing::Values(int(FROND_MECHANICS_ROD), int(FROND_MECHANICS_SPRING_CHAIN)),
                         [](const auto& info) {
                             return frond_mechanics(info.param) == FROND_MECHANICS_ROD ? "rod" : "spring_chain";
                         });

TEST_P(EveryRod, ForceIsMinusTheGradientOfEnergy) {
    Dice dice(1);
    const RodElements elements = make_rod_elements(chain_model(true), which);
    for (double turn : {0.01, 0.5, 1.2, 2.5}) {
        const VecX x = deformed(elements, dice, 0.05, turn), f = force(elements, x);
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            constexpr double H = 1e-6;
            VecX left = x, right = x;
            left[i] -= H;
            right[i] += H;
            const double slope = (row.energy(elements, right) - row.energy(elements, left)) / (2 * H);
            EXPECT_NEAR(f[i], -slope, 1e-5 * f.norm()) << "turn " << turn << " at " << i;
        }
    }
}

TEST_P(EveryRod, ExactStiffnessIsTheDerivativeOfForce) {
    Dice dice(2);
    const RodElements elements = make_rod_elements(chain_model(true), which);
    for (double turn : {0.01, 0.5, 1.2, 2.5}) {
        const VecX x = deformed(elements, dice, 0.05, turn);
        const Eigen::MatrixXd K = stiffness(elements, x, Tangent::exact);
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            constexpr double H = 1e-6;
            VecX left = x, right = x;
            left[i] -= H;
            right[i] += H;
            const VecX slope = (force(elements, left) - force(elements, right)) / (2 * H);
            EXPECT_LT((K.col(i) - slope).norm(), 1e-6 * K.norm()) << "turn " << turn << " at " << i;
        }
    }
}

TEST_P(EveryRod, PositiveStiffnessIsNeverNegativeAndExactWithoutLoad) {
    Dice dice(3);
    const RodElements elements = make_rod_elements(chain_model(), which);
    const VecX x = deformed(elements, dice, 0.1, 1.5);
    const VecX values = eigenvalues_of(stiffness(elements, x, Tangent::positive));
    EXPECT_GT(values[0], -1e-9 * values.tail(1)[0]);
    const Eigen::MatrixXd at_rest = stiffness(elements, elements.modelled, Tangent::positive);
    EXPECT_LT((at_rest - stiffness(elements, elements.modelled, Tangent::exact)).norm(), 1e-9 * at_rest.norm());
}

// A plastic bend leaves a segment at rest far from its modelled shape: what counts is how far it turns from there.
// A segment whose arc is as long as at rest stores what bends or twists it from there.
TEST(Rod, BendsFromItsPlasticShapeBeyondHalfATurn) {
    constexpr double REST = 2.5;  // [rad]
    RodElements elements = make_rod_elements(chain_model(), FROND_MECHANICS_ROD);
    elements.segments.resize(1);
    RodSegment& rod = elements.segments[0];
    rod.centre = 0;
    for (int c = 0; c < 3; ++c) {
        give_set(rod, REST / rod.length * Vec3::Unit(c));
        for (double angle = 0.6; angle < 4.45; angle += 0.1) {
            VecX x = elements.modelled;
            const Vec3 axis = rod.frame.col(c);
            const Mat3 half = rotation_of<double>(0.5 * angle * axis);
            point(x, 2 * rod.a + 1).setZero();
            point(x, 2 * rod.b + 1) = rotation_vector<double>(half * half);
            const double square = c == 0 ? 0 : angle * angle,
                         arc = 1 + square / std::sqrt(576 + square * (4 * square - 33.6));
            point(x, 2 * rod.b) = point(x, 2 * rod.a) + half * rod.frame * rod.rest_strain * (rod.length / arc);
            const double off = (angle - REST) / rod.length;
            const double grown = c == 0 ? 1 + rod.warping * off * off : 1;
            EXPECT_NEAR(mechanics(FROND_MECHANICS_ROD).energy(elements, x),
                        0.5 * rod.length * rod.bend[c] * grown * off * off, 1e-9 * rod.bend[c] / rod.length)
                << angle << " rad about " << c;
        }
    }
}

// Also with fewer segments than lanes.
TEST_P(EveryRod, ForceAndStiffnessAheadAreThoseOfTheirParts) {
    Dice dice(7);
    const RodElements elements = make_rod_elements(chain_model(true), which);
    for (double turn : {1e-6, 0.01, 0.5, 1.2, 2.5}) {
        const VecX x = deformed(elements, dice, 0.05, turn);
        VecX way(x.size()), v(x.size());
        for (Eigen::Index i = 0; i < x.size(); ++i) way[i] = dice.uniform(-0.01, 0.01), v[i] = dice.uniform(-1, 1);
        const std::vector<double> apart = {0.001, 0.004, 0.002, 0.003};
        for (const std::vector<double>& each : {std::vector<double>(), apart}) {
            const double step = 0.01, alike = each.empty() ? 0.005 : 0;
            VecX f = VecX::Zero(x.size()), known = f;
            BlockMatrix A, K, D;
            for (BlockMatrix* matrix : {&A, &K, &D}) {
                matrix->set_pattern(elements.pattern);
                matrix->set_zero();
            }
            row.add_ahead(elements, x, {way.data(), v.data(), step, alike, each}, f, A);
            row.add_force_stiffness_and_damping(
                elements, x, each.empty() ? std::vector<double>(elements.segments.size(), alike) : each, known, K, D);
            known -= dense(K) * way + dense(D) * v;
            EXPECT_LT((f - known).norm(), 1e-12 * known.norm()) << "turn " << turn;
            const Eigen::MatrixXd matrix = step * step * dense(K) + step * dense(D);
            EXPECT_LT((dense(A) - matrix).norm(), 1e-12 * matrix.norm()) << "turn " << turn;
        }
    }
}

// Where a stage of bdf2 goes on from two positions, rates are differences of strain: what turns and moves as a whole
// has none, however far; what is strained evenly has those that its velocities have.
TEST_P(EveryRod, WhatTurnsAsAWholeIsNotDampedAhead) {
    Dice dice(8);
    const RodElements elements = make_rod_elements(chain_model(), which);
    const double h = 0.02;
    for (int repeat = 0; repeat < 20; ++repeat) {
        const Mat3 begin = dice.rotation();
        const Vec3 turn = dice.rotation() * Vec3(0.5 * dice.uniform(0, 1), 0, 0);
        const auto turned = [&](double steps) {
            const Mat3 R = rotation_of<double>(Vec3(steps * turn)) * begin;
            VecX x = elements.modelled;
            for (int i = 0; i < elements.node_count; i += 2) {
                point(x, i) = R * point(elements.modelled, i) + steps * Vec3(1, 2, 3);
                point(x, i + 1) = rotation_vector<double>(R);
            }
            return x;
        };
        const VecX before = turned(0), last = turned(1), x = turned(2);
        const VecX v = (1.5 * x - 2 * last + 0.5 * before) / h;
        EXPECT_LT(damped_ahead(elements, x, v, h, {last.data(), before.data(), BACK}).norm(),
                  1e-8 * damped_ahead(elements, x, v, h, {}).norm())
            << repeat;
    }
}

TEST_P(EveryRod, RatesOfStrainAheadAreThoseOfItsVelocities) {
    Dice dice(9);
    const RodElements elements = make_rod_elements(chain_model(), which);
    const VecX x = deformed(elements, dice, 0.01, 0.5);
    VecX v(x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) v[i] = dice.uniform(-1, 1);
    double off[2];
    for (const int k : {0, 1}) {
        const double h = 1e-4 / (k + 1);
        const VecX last = x - h * v, before = x - 2 * h * v;
        const VecX by_velocity = damped_ahead(elements, x, v, h, {}),
                   by_strain = damped_ahead(elements, x, v, h, {last.data(), before.data(), BACK});
        off[k] = (by_strain - by_velocity).norm() / by_velocity.norm();
    }
    EXPECT_LT(off[0], 1e-3);
    EXPECT_NEAR(off[0] / off[1], 4, 0.4) << "bdf2 is of second order";
}

TEST_P(EveryRod, TurningAndMovingItAsAWholeCostsNothing) {
    Dice dice(4);
    const RodElements elements = make_rod_elements(chain_model(), which);
    for (int repeat = 0; repeat < 20; ++repeat) {
        const Mat3 R = dice.rotation();
        VecX x = elements.modelled;
        for (int i = 0; i < elements.node_count; i += 2) {
            point(x, i) = R * point(elements.modelled, i) + Vec3(1, 2, 3);
            point(x, i + 1) = rotation_vector<double>(R);
        }
        EXPECT_LT(row.energy(elements, x), 1e-12);
        EXPECT_LT(force(elements, x).norm(), 1e-6);
    }
}

TEST_P(EveryRod, ForcesOnPlacesAddUpToNothing) {
    Dice dice(5);
    const RodElements elements = make_rod_elements(chain_model(true), which);
    const VecX f = force(elements, deformed(elements, dice, 0.1, 1));
    Vec3 sum = Vec3::Zero();
    double size = 0;
    for (int i = 0; i < elements.node_count; i += 2) {
        sum += point(f, i);
        size += point(f, i).norm();
    }
    EXPECT_LT(sum.norm(), 1e-12 * size);
}

TEST_P(EveryRod, RetractionMakesALinearTurnARigidOne) {
    const RodElements elements = make_rod_elements(chain_model(), which);
    const std::vector<uint8_t> held(size_t(elements.node_count), 0);
    const Vec3 turn(0.3, -0.8, 0.5), centre = point(elements.modelled, 0);
    VecX end = elements.modelled, out;
    for (int i = 0; i < elements.node_count; i += 2) {
        point(end, i) += turn.cross(point(elements.modelled, i) - centre);
        point(end, i + 1) = turn;
    }
    const double size = row.energy(elements, end);
    row.retract(elements, elements.modelled, end, held, out);
    EXPECT_LT(row.energy(elements, out), 1e-20 * size);
    // Nothing holds it: its centre of mass is where the displacement takes it.
    Vec3 off = Vec3::Zero();
    for (size_t i = 0; i < elements.mass.size(); ++i)
        off += elements.mass[i] * (point(out, int(2 * i)) - point(end, int(2 * i)));
    EXPECT_LT(off.norm(), 1e-14);
}

TEST_P(EveryRod, RetractionDiffersInSecondOrderAndLeavesWhatIsHeld) {
    const RodElements elements = make_rod_elements(chain_model(), which);
    Dice dice(5);
    const VecX from = deformed(elements, dice, 0.01, 0.5),
               way = deformed(elements, dice, 0.02, 0.4) - elements.modelled;
    std::vector<uint8_t> held(size_t(elements.node_count), 0);
    held[0] = held[6] = 1;
    VecX out, off[2];
    for (const int k : {0, 1}) {
        const VecX end = from + 1e-3 / (k + 1) * way;
        row.retract(elements, from, end, held, out);
        off[k] = out - end;
        EXPECT_EQ(point(off[k], 0), Vec3::Zero());
        EXPECT_EQ(point(off[k], 6), Vec3::Zero());
        for (int i = 1; i < elements.node_count; i += 2) EXPECT_EQ(point(off[k], i), Vec3::Zero());
    }
    EXPECT_GT(off[0].norm(), 1e-9);
    EXPECT_LT((off[0] - 4 * off[1]).norm(), 0.01 * off[0].norm());
}

TEST(Rod, StandsInBalanceAsModelled) {
    const RodElements elements = make_rod_elements(chain_model(true), FROND_MECHANICS_ROD);
    VecX f = VecX::Zero(elements.modelled.size());
    mechanics(FROND_MECHANICS_ROD).add_force(elements, elements.modelled, f);
    double weight = 0;
    for (size_t i = 0; i < elements.mass.size(); ++i) {
        f[Eigen::Index(6 * i) + 1] -= GRAVITY * elements.mass[i];
        weight += GRAVITY * elements.mass[i];
    }
    // Excludes the root, which the ground holds.
    EXPECT_LT(f.tail(f.size() - 6).norm(), 1e-9 * weight);
}

TEST(Rotation, RatesAndVectorsBelongTogether) {
    Dice dice(6);
    for (double angle : {1e-6, 1e-3, 0.5, 2.0, 3.1}) {
        const Vec3 v = angle * Vec3(dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1)).normalized();
        EXPECT_LT((rotation_vector<double>(rotation_of<double>(v)) - v).norm(), 1e-9) << angle;
        EXPECT_LT((rate_matrix<double>(v) * inverse_rate_matrix<double>(v) - Mat3::Identity()).norm(), 1e-9) << angle;
        // d(R)/dt = [T dv/dt] R
        const Vec3 dv(0.3, -0.2, 0.5);
        constexpr double H = 1e-6;
        const Mat3 slope = (rotation_of<double>(v + H * dv) - rotation_of<double>(v - H * dv)) / (2 * H);
        const Mat3 spin = cross_matrix<double>(rate_matrix<double>(v) * dv) * rotation_of<double>(v);
        EXPECT_LT((slope - spin).norm(), 1e-8) << angle;
    }
}

}  // namespace rod_tests

}  // namespace frond::test
