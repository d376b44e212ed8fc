// Tet-by-tet functions of a row of the table of mechanics, from a material and an element; the rest is in
// tet_row.hpp. A material ("law") has these functions of the deformation gradient F at one point:
//   Strain strain(share, F)                         input of the others
//   double energy(share, strain)                    a volume [J/m^3]
//   Mat3 stress(share, strain)                      first Piola-Kirchhoff, dW/dF [Pa]
//   TetStiffness stiffness(share, strain, tangent, scale)   scale times volume times d2W/dF2 between corners [N/m]
//   bool inverted(strain)
#pragma once

#include "mechanics/rows.hpp"
#include "mechanics/tet_plasticity.hpp"

namespace frond {

template <class Law, class Element>
struct TetByTet {
    // Makes the strain beyond yield plastic, or only a part of it where F_p would go too far.
    static void let_flow(const Yield& yield, const TetShare& share, const Mat3& F, const Strained& now, double h,
                         const Mat3& rest_inverse, TetPlastic& plastic) {
        double hardening = plastic.hardening;
        const double elastic = elastic_share(yield, now.strain, h, hardening);
        for (double part = 1; part > LEAST_FLOW; part /= 2) {
            const Mat3 change = flow_of(now.S, 1 - part * (1 - elastic));
            TetPlastic next = plastic;
            next.inverse *= change;
            if (!(next.inverse.squaredNorm() < FARTHEST)) continue;
            next.rest_inverse = rest_inverse * next.inverse;
            next.hardening += part * (hardening - plastic.hardening);
            // A change of shape may raise the volumetric energy at second order; energy must not grow.
            if (Law::energy(share, Law::strain(share, F * change)) <= Law::energy(share, Law::strain(share, F)))
                plastic = next;
            return;
        }
    }
    static void flow(Elements& body, const VecX& x, double h) {
        TetElements& elements = static_cast<TetElements&>(body);
        Strained now;
        for (size_t e = 0; e < elements.tets.size(); ++e) {
            const auto places = Element::places(elements, e, x);
            for (int q = 0; q < Element::POINTS; ++q) {
                const TetShare share = Element::share(elements, e, q);
                const Mat3 F = Element::gradient(share, places, q);
                if (!exceeds(share, F, elements.yields[e].strain, now)) continue;
                const size_t point = e * Element::POINTS + size_t(q);
                let_flow(elements.yields[e], share, F, now, h, elements.rest_inverse[point], elements.plastic[point]);
            }
        }
    }

    // Unbounded flow would end in a needle, which has no inverse; tissue would have broken before. Where a plastic
    // stretch nears 1.5, tets stay elastic.
    static constexpr double FARTHEST = 3.5;  // largest squared norm of F_p^-1 [-]
};

// In the linear tet at a point, moving corner b at rest by dX acts on F as moving it in space by -F dX; it also changes
// the volume V and the gradients b_a. With H_a = V P b_a, minus the force on corner a, and K the stiffness,
//   df_a/dX_b = K_ab F - H_a b_b^T + H_b b_a^T.
// A translation changes nothing, and forces add up to zero, which gives the blocks of corner 0.
template <class Plain, class Element>
void rest_derivative(const Elements& body, size_t e, const VecX& x, std::vector<Mat3>& out) {
    using Law = PointByPoint<WithoutGrain<Plain>>;
    const TetElements& elements = as_tets(body);
    out.assign(Element::NODES * Element::NODES, Mat3::Zero());
    const auto places = Element::places(elements, e, x);
    for (int q = 0; q < Element::POINTS; ++q) {
        const TetShare share = Element::share(elements, e, q);
        const Mat3 F = Element::gradient(share, places, q);
        const auto strain = Law::strain(share, F);
        const Mat3& B = share.rest_inverse;
        const Mat3 H = Law::stress(share, strain) * B.transpose() * share.volume;
        const TetStiffness k = Law::stiffness(share, strain, Tangent::exact, 1);
        const Mat3 K[3][3] = {
            {k.k11, k.k21.transpose(), k.k31.transpose()}, {k.k21, k.k22, k.k32.transpose()}, {k.k31, k.k32, k.k33}};
        std::array<Mat3, 16> corners;
        corners.fill(Mat3::Zero());
        for (size_t a = 1; a < 4; ++a)
            for (size_t b = 1; b < 4; ++b) {
                const Eigen::Index i = Eigen::Index(a) - 1, j = Eigen::Index(b) - 1;
                const Mat3 block = K[i][j] * F - H.col(i) * B.row(j) + H.col(j) * B.row(i) +
                                   grain_rest_derivative<Plain>(share, F, B.row(i), B.row(j));
                corners[4 * a + b] = block;
                corners[4 * a] -= block;
                corners[b] -= block;
                corners[0] += block;
            }
        Element::add_to_nodes(q, corners, out);
    }
}

}  // namespace frond
