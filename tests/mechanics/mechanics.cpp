// Properties of every row of the table of mechanics: energy, force and stiffness are consistent.
#include "mechanics/mechanics.hpp"

#include <gtest/gtest.h>

#include "core/decompose.hpp"
#include "core/error.hpp"
#include "mechanics/tet_element.hpp"
#include "support/dense.hpp"
#include "support/meshes.hpp"

namespace frond::test {
namespace mechanics_tests {

struct EveryMechanics : testing::TestWithParam<std::tuple<int, int>> {
    const frond_mechanics which = frond_mechanics(std::get<0>(GetParam()));
    const int order = std::get<1>(GetParam());
    const Mechanics& row = mechanics(which, order);
    TetElements elements_of(const Model& model) const { return make_tet_elements(model, nullptr, order); }
    bool is_linear() const { return which == FROND_MECHANICS_TET_LINEAR; }
    bool is_hookean() const { return which != FROND_MECHANICS_TET_NEOHOOKEAN; }

    VecX force(const TetElements& elements, const VecX& x) const {
        VecX f = VecX::Zero(x.size());
        row.add_force(elements, x, f);
        return f;
    }
    Eigen::MatrixXd stiffness(const TetElements& elements, const VecX& x, Tangent tangent) const {
        BlockMatrix K;
        K.set_pattern(elements.pattern);
        K.set_zero();
        row.add_stiffness(elements, x, tangent, 1, K);
        return dense(K);
    }
};

std::string row_name(const testing::TestParamInfo<std::tuple<int, int>>& info) {
    const auto [which, order] = info.param;
    return std::string(mechanics(frond_mechanics(which), order).name) + (order == 1 ? "" : "_quadratic");
}
INSTANTIATE_TEST_SUITE_P(Mechanics, EveryMechanics,
                         testing::Combine(testing::Range(0, int(FROND_MECHANICS_ROD)), testing::Values(1, 2)),
                         row_name);

// Returns the deformation gradients at all points of all tets.
template <class Element>
std::vector<Mat3> gradients(const TetElements& elements, const VecX& x) {
    std::vector<Mat3> all;
    for (size_t e = 0; e < elements.tets.size(); ++e)
        for (int q = 0; q < Element::POINTS; ++q)
            all.push_back(Element::gradient(Element::share(elements, e, q), Element::places(elements, e, x), q));
    return all;
}
std::vector<Mat3> gradients(const TetElements& elements, const VecX& x) {
    return elements.nodes.order == 1 ? gradients<LinearTet>(elements, x) : gradients<QuadraticTetElement>(elements, x);
}

// Shapes from nearly at rest to strongly distorted; the last ones have inverted tets.
struct Case {
    Model model;
    double amount;  // random displacement per edge length
};
std::vector<Case> cases() {
    const Stuff stuff = {1000, 1e3, 0.3}, soft = {500, 100, 0.45}, cork = {200, 1e3, 0.0};
    return {{single_tet_model(1, stuff), 1e-3},         {single_tet_model(0.5, soft), 0.2},
            {single_tet_model(1, cork), 0.4},           {box_model(1, 2, 1, {1, 2, 1}, stuff), 0.05},
            {box_model(2, 1, 1, {2, 1, 1}, soft), 0.3}, {single_tet_model(1, stuff), 1.5},
            {box_model(1, 1, 1, {1, 1, 1}, stuff), 1.0}};
}

// Returns a rotated, translated and distorted shape, away from where the corotational rotation jumps.
VecX deformed(const Case& c, const TetElements& elements, Dice& dice) {
    for (;;) {
        const Mat3 R = dice.rotation();
        const Vec3 shift(dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1));
        VecX x = elements.rest_positions;
        for (int i = 0; i < elements.node_count; ++i) point(x, i) = R * point(elements.rest_positions, i) + shift;
        x += dice.vector(x.size(), c.amount);
        bool smooth = true;
        for (const Mat3& F : gradients(elements, x)) {
            // Stretches are square roots of eigenvalues of F^T F; the smallest is negative in inverted tets.
            const Vec3 s = symmetric_values(F.transpose() * F).cwiseMax(0).cwiseSqrt();
            smooth &= s[1] + (F.determinant() < 0 ? -s[0] : s[0]) > 0.2 * s[2];
        }
        if (smooth) return x;
    }
}

// Shapes at rest are distorted too, but less, so that no tet is flat.
TEST_P(EveryMechanics, RestDerivativeIsThatOfTheForce) {
    Dice dice(2);
    for (const Case& c : cases())
        for (int repeat = 0; repeat < 10; ++repeat) {
            TetElements elements = elements_of(c.model);
            const VecX tear = dice.vector(elements.rest_positions.size(), order == 1 ? 0.1 : 0.03);
            const VecX rest = elements.rest_positions + tear;
            set_rest_positions(elements, rest);
            const VecX x = deformed(c, elements, dice);
            const size_t e = size_t(repeat) % elements.tets.size();
            std::vector<Mat3> derivative;
            row.rest_derivative(elements, e, x, derivative);
            // Give all other tets zero stiffness.
            TetElements one = elements;
            for (size_t other = 0; other < one.mu.size(); ++other)
                if (other != e) one.mu[other] = one.lambda[other] = 0;
            const auto forces = [&](const VecX& X) {
                set_rest_positions(one, X);
                return force(one, x);
            };
            const double h = 1e-5;
            const ElementNodes nodes = element_nodes(elements, e);
            for (size_t b = 0; b < nodes.count; ++b)
                for (int axis = 0; axis < 3; ++axis) {
                    VecX X = rest;
                    double& moved = X[3 * nodes.node[b] + axis];
                    moved += h;
                    const VecX up = forces(X);
                    moved -= 2 * h;
                    const VecX slope = (up - forces(X)) / (2 * h);
                    for (size_t a = 0; a < nodes.count; ++a)
                        ASSERT_NEAR((point(slope, nodes.node[a]) - derivative[nodes.count * a + b].col(axis)).norm(), 0,
                                    1e-5 * slope.norm() + 1e-6);
                }
        }
}

TEST_P(EveryMechanics, ForceIsMinusTheGradientOfEnergy) {
    Dice dice(1);
    int inverted = 0;
    for (const Case& c : cases())
        for (int repeat = 0; repeat < 20; ++repeat) {
            const TetElements elements = elements_of(c.model);
            VecX x = deformed(c, elements, dice);
            VecX f = VecX::Zero(x.size());
            inverted += row.add_force(elements, x, f);
            const double h = 1e-5;
            for (Eigen::Index i = 0; i < x.size(); ++i) {
                const double middle = x[i];
                x[i] = middle + h;
                const double up = row.energy(elements, x);
                x[i] = middle - h;
                const double down = row.energy(elements, x);
                x[i] = middle;
                ASSERT_NEAR(f[i], -(up - down) / (2 * h), 1e-7 * f.norm() + 1e-6);
            }
        }
    EXPECT_GT(inverted, 5);
}

TEST_P(EveryMechanics, ExactStiffnessIsMinusTheDerivativeOfForce) {
    Dice dice(2);
    for (const Case& c : cases())
        for (int repeat = 0; repeat < 20; ++repeat) {
            const TetElements elements = elements_of(c.model);
            VecX x = deformed(c, elements, dice);
            const Eigen::MatrixXd K = stiffness(elements, x, Tangent::exact);
            const double h = 1e-6;
            for (Eigen::Index i = 0; i < x.size(); ++i) {
                const double middle = x[i];
                x[i] = middle + h;
                const VecX up = force(elements, x);
                x[i] = middle - h;
                const VecX down = force(elements, x);
                x[i] = middle;
                ASSERT_NEAR((K.col(i) + (up - down) / (2 * h)).norm(), 0, 1e-7 * K.norm());
            }
        }
}

TEST_P(EveryMechanics, PositiveStiffnessIsNeverNegative) {
    Dice dice(3);
    for (const Case& c : cases())
        for (int repeat = 0; repeat < 10; ++repeat) {
            const TetElements elements = elements_of(c.model);
            const VecX x = elements.rest_positions + dice.vector(elements.rest_positions.size(), 2 * c.amount);
            const Eigen::MatrixXd K = stiffness(elements, x, Tangent::positive);
            const VecX values = eigenvalues_of(K);
            ASSERT_GE(values.minCoeff(), -1e-12 * values.maxCoeff());
        }
}

TEST_P(EveryMechanics, BothTangentsAgreeAtRest) {
    const TetElements elements = elements_of(box_model(2, 2, 2, {1, 1, 1}));
    const Eigen::MatrixXd exact = stiffness(elements, elements.rest_positions, Tangent::exact);
    const Eigen::MatrixXd positive = stiffness(elements, elements.rest_positions, Tangent::positive);
    EXPECT_NEAR((exact - positive).norm(), 0, 1e-12 * exact.norm());
    EXPECT_GT(exact.norm(), 0);
}

// A compressed body may buckle, so its exact stiffness must have negative eigenvalues.
TEST(Corotational, ExactStiffnessTurnsNegativeUnderCompression) {
    const TetElements elements = make_tet_elements(single_tet_model());
    const VecX x = 0.5 * elements.rest_positions;
    BlockMatrix K;
    K.set_pattern(elements.pattern);
    K.set_zero();
    mechanics(FROND_MECHANICS_TET_COROTATIONAL).add_stiffness(elements, x, Tangent::exact, 1, K);
    EXPECT_LT(eigenvalues_of(dense(K)).minCoeff(), -1);
}

// An inverted tet is compressed; on the path back the force never reverses.
TEST(Neohookean, PushesATetThatIsInsideOutBackThroughItself) {
    const TetElements elements = make_tet_elements(single_tet_model(1, {1000, 1e3, 0.3}));
    VecX x = elements.rest_positions;
    for (double z = -1; z < 0.9; z += 0.05) {
        point(x, 3).z() = z;
        VecX f = VecX::Zero(x.size());
        mechanics(FROND_MECHANICS_TET_NEOHOOKEAN).add_force(elements, x, f);
        EXPECT_GT(f[11], 1) << z;
    }
}

// Compares the energy with its closed form for a stretch along the axes.
TEST(Neohookean, HasTheEnergyOfItsFormula) {
    const double E = 2e4, nu = 0.4, mu = E / (2 * (1 + nu)), lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
    const TetElements elements = make_tet_elements(single_tet_model(1, {1000, E, nu}));
    const auto energy = [&](double a, double b, double c) {
        const double m = 4 * mu / 3, l = lambda + 5 * mu / 6, alpha = 1 + m / l - m / (4 * l);
        const double I = a * a + b * b + c * c, J = a * b * c;
        return m / 2 * (I - 3) + l / 2 * (J - alpha) * (J - alpha) - m / 2 * std::log(I + 1);
    };
    Dice dice(11);
    for (int repeat = 0; repeat < 20; ++repeat) {
        const double a = dice.uniform(-0.5, 3), b = dice.uniform(0.1, 2), c = dice.uniform(0.1, 2);
        VecX x = elements.rest_positions;
        for (int i = 0; i < 4; ++i) point(x, i) = Vec3(a, b, c).cwiseProduct(point(x, i));
        EXPECT_NEAR(mechanics(FROND_MECHANICS_TET_NEOHOOKEAN).energy(elements, x),
                    elements.volume[0] * (energy(a, b, c) - energy(1, 1, 1)), 1e-10 * E);
    }
}

TEST_P(EveryMechanics, GivesNoForceUnderRigidMotion) {
    Dice dice(4);
    const TetElements elements = elements_of(tree_model(6, 4, 3, {1000, 1e6, 0.3}));
    const double scale = stiffness(elements, elements.rest_positions, Tangent::exact).norm();
    for (int repeat = 0; repeat < 20; ++repeat) {
        const Vec3 shift(dice.uniform(-9, 9), dice.uniform(-9, 9), dice.uniform(-9, 9));
        // Linear strain mistakes a finite rotation for a stretch, but not an infinitesimal one.
        const Vec3 spin(dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1));
        const Mat3 R = dice.rotation();
        VecX x = elements.rest_positions;
        for (int i = 0; i < elements.node_count; ++i) {
            const Vec3 p = point(elements.rest_positions, i);
            point(x, i) = shift + (is_linear() ? Vec3(p + spin.cross(p)) : Vec3(R * p));
        }
        EXPECT_NEAR(force(elements, x).norm(), 0, 1e-13 * scale);
        // Energies that are differences of larger numbers have rounding errors of these.
        double rounding = 1e-20 * scale;
        if (!is_hookean())
            for (size_t e = 0; e < elements.tets.size(); ++e) rounding += 2e-15 * elements.mu[e] * elements.volume[e];
        EXPECT_NEAR(row.energy(elements, x), 0, rounding);
    }
}

TEST(Linear, MistakesALargeTurnForAStretch) {
    const TetElements elements = make_tet_elements(single_tet_model());
    VecX x = elements.rest_positions;
    const Mat3 R = Eigen::AngleAxisd(1, Vec3::UnitX()).toRotationMatrix();
    for (int i = 0; i < 4; ++i) point(x, i) = R * point(elements.rest_positions, i);
    EXPECT_GT(mechanics(FROND_MECHANICS_TET_LINEAR).energy(elements, x), 1e3);
}

TEST_P(EveryMechanics, ForcesAddUpToNothing) {
    Dice dice(5);
    const TetElements elements = elements_of(box_model(2, 2, 3, {1, 1, 1.5}));
    for (int repeat = 0; repeat < 20; ++repeat) {
        const VecX x = elements.rest_positions + dice.vector(elements.rest_positions.size(), 0.3);
        const VecX f = force(elements, x);
        Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
        for (int i = 0; i < elements.node_count; ++i) {
            sum += point(f, i);
            // The torque of linear forces vanishes about the rest positions, that of the others about the current ones.
            const VecX& arm = is_linear() ? elements.rest_positions : x;
            torque += point(arm, i).cross(Vec3(point(f, i)));
        }
        EXPECT_NEAR(sum.norm(), 0, 1e-13 * f.norm());
        EXPECT_NEAR(torque.norm(), 0, 1e-12 * f.norm());
    }
}

TEST_P(EveryMechanics, OnePassGivesTheSameAsTwo) {
    Dice dice(6);
    const TetElements elements = elements_of(box_model(2, 2, 2, {1, 1, 1}));
    const VecX x = elements.rest_positions + dice.vector(elements.rest_positions.size(), 0.2);
    for (Tangent tangent : {Tangent::exact, Tangent::positive}) {
        BlockMatrix K, twice;
        K.set_pattern(elements.pattern);
        twice.set_pattern(elements.pattern);
        K.set_zero();
        twice.set_zero();
        VecX f = VecX::Zero(x.size()), f_alone = f;
        const int inverted = row.add_force_and_stiffness(elements, x, tangent, f, K);
        EXPECT_EQ(inverted, row.add_force(elements, x, f_alone));
        row.add_stiffness(elements, x, tangent, 2, twice);
        EXPECT_NEAR((f - f_alone).norm(), 0, 1e-12 * f.norm());
        EXPECT_NEAR((2 * dense(K) - dense(twice)).norm(), 0, 1e-12 * dense(twice).norm());
    }
}

// The damping of a solve is that of all elements plus each element's own.
TEST_P(EveryMechanics, OnePassAheadIsMadeOfTheRest) {
    if (!row.add_ahead) GTEST_SKIP() << "goes the long way";
    Dice dice(7);
    const TetElements elements = elements_of(box_model(2, 2, 1, {1, 1, 0.5}));
    const Eigen::Index n = elements.rest_positions.size();
    const VecX x = elements.rest_positions + dice.vector(n, 0.2), way = dice.vector(n, 0.3), v = dice.vector(n, 2);
    const double step = 0.013, damping = 0.02;
    std::vector<double> own;
    for (size_t e = 0; e < elements.tets.size(); ++e) own.push_back(dice.uniform(0, 0.1));
    for (const std::vector<double>& each : {std::vector<double>(), own}) {
        BlockMatrix A, K, D;
        for (BlockMatrix* matrix : {&A, &K, &D}) {
            matrix->set_pattern(elements.pattern);
            matrix->set_zero();
        }
        VecX f = VecX::Zero(n), expected = f;
        const int inverted = row.add_ahead(elements, x, {way.data(), v.data(), step, damping, each}, f, A);
        EXPECT_EQ(inverted, each.empty() ? row.add_force_and_stiffness(elements, x, Tangent::positive, expected, K)
                                         : row.add_force_stiffness_and_damping(elements, x, each, expected, K, D));
        const Eigen::MatrixXd damps = damping * dense(K) + dense(D);
        expected -= dense(K) * way + damps * v;
        EXPECT_LT((f - expected).norm(), 1e-12 * expected.norm());
        EXPECT_LT((dense(A) - step * step * dense(K) - step * damps).norm(), 1e-12 * dense(A).norm());
    }
}

TEST_P(EveryMechanics, CountsTetsThatAreInsideOut) {
    const TetElements elements = elements_of(single_tet_model());
    VecX x = elements.rest_positions, f = VecX::Zero(x.size());
    EXPECT_EQ(row.add_force(elements, x, f), 0);
    point(x, 3).z() = -0.2;
    EXPECT_EQ(row.add_force(elements, x, f), 1);
}

TEST_P(EveryMechanics, StretchesABarAsYoungsModulusSays) {
    // Uniaxial stress: strain s along x, -nu s across; energy E s^2 / 2 per volume for small s.
    const Stuff stuff = {1000, 2e6, 0.35};
    const TetElements elements = elements_of(box_model(3, 1, 1, {3, 1, 1}, stuff));
    const double s = 1e-4;
    const auto energy = [&](double strain) {
        VecX x = elements.rest_positions;
        for (int i = 0; i < elements.node_count; ++i) {
            Vec3 p = point(x, i);
            point(x, i) = p + strain * Vec3(p.x(), -0.35 * p.y(), -0.35 * p.z());
        }
        return row.energy(elements, x);
    };
    // The mean over stretch and compression, so that odd powers of strain cancel; the next term is smaller by s^2.
    EXPECT_NEAR((energy(s) + energy(-s)) / 2, 0.5 * 2e6 * s * s * 3, (is_hookean() ? 1e-9 : 1e-7) * 2e6 * s * s);
}

TEST(TetElements, RefuseWhatHasNoVolumeOrNoSense) {
    const auto code_of = [](const Model& model) {
        try {
            make_tet_elements(model);
        } catch (const Error& error) {
            return error.code;
        }
        return FROND_OK;
    };
    const Model good = single_tet_model();
    EXPECT_EQ(code_of(good), FROND_OK);
    Model bad = good;
    bad.cage.nodes[3] = {0.3, 0.3, 0};
    EXPECT_EQ(code_of(bad), FROND_RESULT_BAD_GEOMETRY);
    bad = good;
    bad.cage.nodes[3].x() = std::nan("");
    EXPECT_EQ(code_of(bad), FROND_RESULT_BAD_GEOMETRY);
    bad = good;
    bad.cage.tets[0][2] = 4;
    EXPECT_EQ(code_of(bad), FROND_RESULT_BAD_GEOMETRY);
    bad = good;
    bad.cage.tets.clear();
    EXPECT_EQ(code_of(bad), FROND_RESULT_BAD_GEOMETRY);
    for (double nu : {-0.1, 0.5, std::nan("")}) {
        bad = good;
        bad.tet_poisson[0] = nu;
        EXPECT_EQ(code_of(bad), FROND_RESULT_BAD_ARGUMENT) << nu;
    }
    for (double E : {0.0, -1.0, HUGE_VAL}) {
        bad = good;
        bad.tet_young[0] = E;
        EXPECT_EQ(code_of(bad), FROND_RESULT_BAD_ARGUMENT) << E;
    }
}

}  // namespace mechanics_tests

}  // namespace frond::test
