// Rods of a tapered stem compared with closed forms of cones, and with finite elements in its frequencies.
#include <gtest/gtest.h>

#include <cmath>

#include "mechanics/rod_elements.hpp"
#include "modelling/build.hpp"
#include "support/dense.hpp"
#include "support/materials.hpp"
#include "support/model_def.hpp"

namespace frond::test {
namespace cone_tests {

constexpr double LENGTH = 1, FOOT = 0.01;  // [m]
constexpr double E = 1e9, NU = 0.25, DENSITY = 800;

// Rods of a cone along +y with as many pieces, from stems or from a mesh, held at its foot.
struct Cone {
    std::shared_ptr<const Model> model;
    Eigen::MatrixXd K, M;
    int tip;  // first number of the last chain node

    Cone(double end, int pieces, bool from_mesh, frond_mass mass = FROND_MASS_CONSISTENT) {
        frond_organ_material material = {"stem", plain_material(DENSITY, E, NU, 1e-3)};
        frond_model_def def = model_def();
        def.rest = FROND_REST_WITHOUT_GRAVITY;
        def.capsule_height = LENGTH / pieces;
        def.organs = &material;
        def.organ_count = 1;
        const frond_stem stem = {-1, {0, 0, 0}, {0, LENGTH, 0}, FOOT, end};
        model = from_mesh ? build_from_surface(mesh(end, pieces), def) : build_from_stems(&stem, 1, def);
        const Mechanics& row = mechanics(FROND_MECHANICS_ROD);
        const RodElements elements = make_rod_elements(*model, FROND_MECHANICS_ROD);
        BlockMatrix matrix;
        matrix.set_pattern(elements.pattern);
        matrix.set_zero();
        row.add_stiffness(elements, elements.modelled, Tangent::exact, 1, matrix);
        K = dense(matrix).bottomRightCorner(6 * pieces, 6 * pieces);
        const Masses masses = row.masses(elements, mass);
        for (int k = 0; k < elements.pattern.block_count(); ++k)
            matrix.block(k) = masses.slot[size_t(k)] * Mat3::Identity();
        M = dense(matrix).bottomRightCorner(6 * pieces, 6 * pieces);
        for (int i = 0; i < pieces; ++i) M.block<3, 3>(6 * i + 3, 6 * i + 3) = elements.inertia[size_t(i + 1)];
        tip = 6 * (pieces - 1);
    }
    // Returns the tip's displacement or rotation by a unit force or moment there, of the same number of six.
    double yields(int of) const { return solve_dense(K, VecX::Unit(K.rows(), tip + of))[tip + of]; }
    static Surface mesh(double end, int pieces) {
        constexpr int SIDES = 48;
        const int rings = 4 * pieces;
        Surface surface;
        const auto at = [](int ring, int k) { return ring * SIDES + k % SIDES; };
        for (int ring = 0; ring <= rings; ++ring)
            for (int k = 0; k < SIDES; ++k) {
                const double along = double(ring) / rings, r = FOOT + along * (end - FOOT), turn = 2 * M_PI * k / SIDES;
                surface.positions.push_back({r * std::cos(turn), LENGTH * along, r * std::sin(turn)});
                if (ring == rings) continue;
                surface.triangles.push_back({at(ring, k), at(ring + 1, k), at(ring + 1, k + 1)});
                surface.triangles.push_back({at(ring, k), at(ring + 1, k + 1), at(ring, k + 1)});
            }
        for (int k = 1; k + 1 < SIDES; ++k) {
            surface.triangles.push_back({at(0, 0), at(0, k), at(0, k + 1)});
            surface.triangles.push_back({at(rings, 0), at(rings, k + 1), at(rings, k)});
        }
        Part part;
        part.name = part.material = "stem";
        part.triangle_count = int(surface.triangles.size());
        surface.parts.push_back(part);
        return surface;
    }
};

TEST(Rod, OfACylinderOrConeIsExactAtItsTip) {
    for (const double end : {FOOT, 0.5 * FOOT, 0.1 * FOOT})
        for (const int pieces : {2, 5, 20}) {
            SCOPED_TRACE(testing::Message() << "end " << end << ", " << pieces << " pieces");
            const Cone cone(end, pieces, false);
            const double bends =
                4 * LENGTH / (3 * M_PI * E * FOOT * end) * (1 / (FOOT * FOOT) + 1 / (FOOT * end) + 1 / (end * end));
            for (const int across : {0, 2}) {
                EXPECT_NEAR(cone.yields(across) / (4 * std::pow(LENGTH, 3) / (3 * M_PI * E * std::pow(FOOT, 3) * end)),
                            1, 1e-6);
                EXPECT_NEAR(cone.yields(3 + across) / bends, 1, 1e-6);
            }
            EXPECT_NEAR(cone.yields(1) / (LENGTH / (M_PI * E * FOOT * end)), 1, 1e-6);
            EXPECT_NEAR(cone.yields(4) / ((1 + NU) * bends), 1, 1e-6);
        }
}

// Returns squares of the angular frequencies of a cone in one plane, by many tapered beam elements with cubic shape
// functions.
VecX squares_of_cone(double end) {
    constexpr int COUNT = 120;
    constexpr double POINTS[] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
    constexpr double WEIGHTS[] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
    const double l = LENGTH / COUNT;
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * COUNT + 2, 2 * COUNT + 2), M = K;
    for (int e = 0; e < COUNT; ++e)
        for (int p = 0; p < 4; ++p) {
            const double x = POINTS[p], r = FOOT + (e + 0.5 + 0.5 * x) / COUNT * (end - FOOT);
            const double area = M_PI * r * r, inertia = area * r * r / 4, w = 0.5 * l * WEIGHTS[p];
            const Eigen::Vector4d shape(0.25 * (1 - x) * (1 - x) * (2 + x), 0.125 * l * (1 - x) * (1 - x) * (1 + x),
                                        0.25 * (1 + x) * (1 + x) * (2 - x), 0.125 * l * (1 + x) * (1 + x) * (x - 1));
            const Eigen::Vector4d curved = Eigen::Vector4d(6 * x, (3 * x - 1) * l, -6 * x, (3 * x + 1) * l) / (l * l);
            const Eigen::Vector4d slope(-1.5 * (1 - x * x) / l, 0.25 * (1 - x) * (-1 - 3 * x), 1.5 * (1 - x * x) / l,
                                        0.25 * (1 + x) * (3 * x - 1));
            K.block<4, 4>(2 * e, 2 * e) += w * E * inertia * curved * curved.transpose();
            M.block<4, 4>(2 * e, 2 * e) +=
                w * DENSITY * (area * shape * shape.transpose() + inertia * slope * slope.transpose());
        }
    return modes_of(K.bottomRightCorner(2 * COUNT, 2 * COUNT), M.bottomRightCorner(2 * COUNT, 2 * COUNT)).values;
}

TEST(Rod, OfAConeHasItsFirstThreeFrequencies) {
    for (const double end : {FOOT, 0.5 * FOOT, 0.45 * FOOT, 0.1 * FOOT}) {
        const VecX exact = squares_of_cone(end);
        for (const frond_mass mass : {FROND_MASS_LUMPED, FROND_MASS_CONSISTENT}) {
            const Cone cone(end, 20, false, mass);
            const VecX squares = modes_of(cone.K, cone.M).values;
            for (int mode = 0; mode < 3; ++mode)  // each in two planes
                EXPECT_NEAR(std::sqrt(squares[2 * mode] / exact[mode]), 1, 0.01)
                    << "end " << end << ", mass " << mass << ", mode " << mode;
        }
    }
}

// 48 sides enclose 0.9943 of the second moment of the circle.
TEST(Rod, OfAMeshOfAConeIsThatOfTheCone) {
    for (const double end : {FOOT, 0.5 * FOOT, 0.1 * FOOT}) {
        const Cone cone(end, 20, true);
        const double exact = 4 * std::pow(LENGTH, 3) / (3 * M_PI * E * std::pow(FOOT, 3) * end) / 0.9943;
        EXPECT_NEAR(cone.yields(0) / exact, 1, 0.002) << end;
        EXPECT_NEAR(cone.yields(2) / exact, 1, 0.002) << end;
    }
}

}  // namespace cone_tests
}  // namespace frond::test
