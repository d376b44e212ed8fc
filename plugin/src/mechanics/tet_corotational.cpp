// In: the gradient of deformation at a point. Out: energy, stress and stiffness of linear elasticity in that point's
// own rotated frame, mu |F - R|^2 + lambda/2 tr(R^T F - I)^2.
//
// After Müller and Gross 2004 ("Interactive virtual materials") for the frame; the exact stiffness holds the derivative
// of the rotation too, as in Chao, Pinkall, Sanan, Schröder 2010 ("A simple geometric model for elastic deformations").
#include "mechanics/polar.hpp"
#include "mechanics/tet_row.hpp"
#include "mechanics/warped_stiffness.hpp"

namespace frond {

namespace {

struct Strain {
    Mat3 F;
    Polar polar;
};

// With g = R b, a motion dx of the nodes turns R by w = T sum(g x dx), T = (tr(S) I - F R^T)^-1, which gives
//   K_ab = V (2 mu b_a.b_b I + lambda g_a g_b^T + (lambda tr(S - I) - 2 mu) [g_a]^T T [g_b]), [g] the cross product.
TetStiffness exact_stiffness(const TetShare& tet, const Strain& s, double scale) {
    const Polar& polar = s.polar;
    const Mat3& B = tet.rest_inverse;
    const double mu = scale * tet.volume * tet.mu, lambda = scale * tet.volume * tet.lambda;
    const Mat3 G = polar.rotation * B.transpose();

    Mat3 turn = -s.F * polar.rotation.transpose();
    turn.diagonal().array() += polar.trace;
    const Mat3 T = (lambda * (polar.trace - 3) - 2 * mu) * turn.inverse();

    // T [g_b], row by row: t^T [g] = (t x g)^T.
    Mat3 turned[3];
    for (int b = 0; b < 3; ++b)
        for (int r = 0; r < 3; ++r) turned[b].row(r) = T.row(r).cross(G.col(b).transpose());
    const auto block = [&](int a, int b) {
        // [g_a]^T m = m x g_a for each column m.
        Mat3 k;
        for (int c = 0; c < 3; ++c) k.col(c) = turned[b].col(c).cross(G.col(a)) + G.col(a) * (lambda * G(c, b));
        k.diagonal().array() += 2 * mu * B.row(a).dot(B.row(b));
        return k;
    };
    return {block(0, 0), block(1, 0), block(2, 0), block(1, 1), block(2, 1), block(2, 2)};
}

struct Corotational {
    static Strain strain(const TetShare&, const Mat3& F) { return {F, polar_decomposition(F)}; }

    static double energy(const TetShare& tet, const Strain& s) {
        const double stretch = s.polar.trace - 3;
        return tet.mu * (s.F - s.polar.rotation).squaredNorm() + 0.5 * tet.lambda * stretch * stretch;
    }

    // P = 2 mu (F - R) + lambda tr(S - I) R; the rotation's own derivative adds nothing, since S is symmetric.
    static Mat3 stress(const TetShare& tet, const Strain& s) {
        return 2 * tet.mu * s.F + (tet.lambda * (s.polar.trace - 3) - 2 * tet.mu) * s.polar.rotation;
    }

    static TetStiffness stiffness(const TetShare& tet, const Strain& s, Tangent tangent, double scale) {
        // Where the rotation is about to jump its derivative has no bound; the warped stiffness is finite everywhere.
        const bool smooth = s.polar.gaps > 1e-4 * s.polar.trace * s.polar.trace * s.polar.trace;
        if (tangent == Tangent::exact && smooth) return exact_stiffness(tet, s, scale);
        return warped_stiffness(tet, s.polar.rotation, scale);
    }

    static bool inverted(const Strain& s) { return s.polar.determinant < 0; }
};

}  // namespace

Mechanics tet_corotational(int order) {
    return tet_row<Corotational>("tet_corotational", order, false);
}

}  // namespace frond
