// In: tets at rest and where their nodes are. Out: energy, force and stiffness of linear elasticity in each tet's own
// rotated frame, mu |F - R|^2 + lambda/2 tr(R^T F - I)^2.
//
// After Müller and Gross 2004 ("Interactive virtual materials") for the frame; the exact stiffness holds the derivative
// of the rotation too, as in Chao, Pinkall, Sanan, Schröder 2010 ("A simple geometric model for elastic deformations").
#include "mechanics/polar.hpp"
#include "mechanics/rows.hpp"
#include "mechanics/tet_element.hpp"

namespace frond {

namespace {

// P = 2 mu (F - R) + lambda tr(S - I) R; the rotation's own derivative adds nothing, since S is symmetric.
Mat3 stress(const TetElements& elements, size_t e, const Mat3& F, const Polar& polar) {
    const double mu = elements.mu[e];
    return 2 * mu * F + (elements.lambda[e] * (polar.trace - 3) - 2 * mu) * polar.rotation;
}

// With g = R b, a motion dx of the nodes turns R by w = T sum(g x dx), T = (tr(S) I - F R^T)^-1, which gives
//   K_ab = V (2 mu b_a.b_b I + lambda g_a g_b^T + (lambda tr(S - I) - 2 mu) [g_a]^T T [g_b]), [g] the cross product.
TetStiffness exact_stiffness(const TetElements& elements, size_t e, const Mat3& F, const Polar& polar, double scale) {
    const Mat3& B = elements.rest_inverse[e];
    const double mu = scale * elements.volume[e] * elements.mu[e];
    const double lambda = scale * elements.volume[e] * elements.lambda[e];
    const Mat3 G = polar.rotation * B.transpose();

    Mat3 turn = -F * polar.rotation.transpose();
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

TetStiffness stiffness(const TetElements& elements, size_t e, const Mat3& F, const Polar& polar, Tangent tangent,
                       double scale) {
    // Where the rotation is about to jump its derivative has no bound; the warped stiffness is finite everywhere.
    const bool smooth = polar.gaps > 1e-4 * polar.trace * polar.trace * polar.trace;
    if (tangent == Tangent::exact && smooth) return exact_stiffness(elements, e, F, polar, scale);
    return warped_stiffness(elements, e, polar.rotation, scale);
}

}  // namespace

double tet_corotational_energy(const Elements& body, const VecX& x) {
    const TetElements& elements = as_tets(body);
    double energy = 0;
    for (size_t e = 0; e < elements.tets.size(); ++e) {
        const Mat3 F = deformation_gradient(elements, e, x);
        const Polar polar = polar_decomposition(F);
        const double stretch = polar.trace - 3;
        energy += elements.volume[e] *
                  (elements.mu[e] * (F - polar.rotation).squaredNorm() + 0.5 * elements.lambda[e] * stretch * stretch);
    }
    return energy;
}

int tet_corotational_add_force(const Elements& body, const VecX& x, VecX& f) {
    const TetElements& elements = as_tets(body);
    int inverted = 0;
    for (size_t e = 0; e < elements.tets.size(); ++e) {
        const Mat3 F = deformation_gradient(elements, e, x);
        const Polar polar = polar_decomposition(F);
        scatter_force(elements, e, stress(elements, e, F, polar), f);
        inverted += polar.determinant < 0;
    }
    return inverted;
}

void tet_corotational_add_stiffness(const Elements& body, const VecX& x, Tangent tangent, double scale,
                                    BlockMatrix& K) {
    const TetElements& elements = as_tets(body);
    for (size_t e = 0; e < elements.tets.size(); ++e) {
        const Mat3 F = deformation_gradient(elements, e, x);
        scatter_stiffness(elements, e, stiffness(elements, e, F, polar_decomposition(F), tangent, scale), K);
    }
}

int tet_corotational_add_both(const Elements& body, const VecX& x, Tangent tangent, VecX& f, BlockMatrix& K) {
    const TetElements& elements = as_tets(body);
    int inverted = 0;
    for (size_t e = 0; e < elements.tets.size(); ++e) {
        const Mat3 F = deformation_gradient(elements, e, x);
        const Polar polar = polar_decomposition(F);
        scatter_force(elements, e, stress(elements, e, F, polar), f);
        scatter_stiffness(elements, e, stiffness(elements, e, F, polar, tangent, 1), K);
        inverted += polar.determinant < 0;
    }
    return inverted;
}

}  // namespace frond
