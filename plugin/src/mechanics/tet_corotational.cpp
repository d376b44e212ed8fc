// In: the deformation gradient at a point. Out: energy, stress and stiffness of linear elasticity in that point's own
// rotated frame, mu |F - R|^2 + lambda/2 tr(R^T F - I)^2.
//
// The frame is after Müller and Gross 2004 ("Interactive virtual materials"); the exact stiffness includes the
// derivative of the rotation, as in Chao, Pinkall, Sanan, Schröder 2010 ("A simple geometric model for elastic
// deformations").
#include "mechanics/polar_lanes.hpp"
#include "mechanics/tet_row.hpp"
#include "mechanics/warped_stiffness.hpp"

namespace frond {

namespace {

struct Corotational {
    static constexpr bool GOES_AHEAD = true;
    static constexpr bool TURNS = true;

    template <class S>
    struct Strain {
        Lanes33<S> F;
        PolarLanes<S> polar;
    };

    template <class S>
    FROND_INLINE static Strain<S> strain(const Lanes33<S>& F) {
        return {F, polar_in_lanes(F)};
    }

    template <class S>
    FROND_INLINE static S energy(const TetShareLanes<S>& tet, const Strain<S>& s) {
        const Lanes33<S> change = s.F - s.polar.rotation;
        const S stretch = s.polar.trace - 3.0;
        return tet.mu * dot(change, change) + 0.5 * tet.lambda * stretch * stretch;
    }

    // P = 2 mu (F - R) + lambda tr(S - I) R; the derivative of the rotation adds nothing, since S is symmetric.
    template <class S>
    FROND_INLINE static Lanes33<S> stress(const TetShareLanes<S>& tet, const Strain<S>& s) {
        const S twice = 2.0 * tet.mu;
        return twice * s.F + (tet.lambda * (s.polar.trace - 3.0) - twice) * s.polar.rotation;
    }

    template <class S>
    FROND_INLINE static Lanes33<S> stress_of_change(const TetShareLanes<S>& tet, const Strain<S>& s,
                                                    const Lanes33<S>& dF) {
        return warped_stress(tet, s.polar.rotation, dF);
    }

    // With g = R b and [g] its cross product, displacements dx of the nodes rotate R by w = T sum(g x dx),
    // T = (tr(S) I - F R^T)^-1, which gives
    //   K_ab = V (2 mu b_a.b_b I + lambda g_a g_b^T + (lambda tr(S - I) - 2 mu) [g_a]^T T [g_b]).
    template <class S>
    FROND_INLINE static TetStiffnessLanes<S> exact_stiffness(const TetShareLanes<S>& tet, const Strain<S>& s,
                                                             const S& scale) {
        const Lanes33<S>& B = tet.rest_inverse;
        const S volume = scale * tet.volume, twice = 2.0 * volume * tet.mu, lambda = volume * tet.lambda;
        const Lanes33<S> G = B * transposed(s.polar.rotation);
        Lanes33<S> turn = -(s.F * transposed(s.polar.rotation));
        add_to_diagonal(s.polar.trace, turn);
        const Lanes33<S> cof = cofactor(turn);
        const Lanes33<S> T = ((lambda * (s.polar.trace - 3.0) - twice) / dot(turn.r[0], cof.r[0])) * transposed(cof);

        // T [g_b], row by row: t^T [g] = (t x g)^T.
        Lanes33<S> turned[3];
        for (int b = 0; b < 3; ++b)
            for (int r = 0; r < 3; ++r) turned[b].r[r] = cross(T.r[r], G.r[b]);
        const auto block = [&](int a, int b) FROND_INLINED {
            // [g_a]^T m = m x g_a for each column m.
            const Lanes33<S>& m = turned[b];
            const Lanes3<S>& g = G.r[a];
            Lanes33<S> k = outer(g, lambda * G.r[b]);
            k.r[0] = k.r[0] + (g.z * m.r[1] - g.y * m.r[2]);
            k.r[1] = k.r[1] + (g.x * m.r[2] - g.z * m.r[0]);
            k.r[2] = k.r[2] + (g.y * m.r[0] - g.x * m.r[1]);
            add_to_diagonal(S(twice * dot(B.r[a], B.r[b])), k);
            return k;
        };
        return {block(0, 0), block(1, 0), block(2, 0), block(1, 1), block(2, 1), block(2, 2)};
    }

    template <class S>
    FROND_INLINE static TetStiffnessLanes<S> stiffness(const TetShareLanes<S>& tet, const Strain<S>& s, Tangent tangent,
                                                       const S& scale) {
        const S size = s.polar.trace;
        // Where the rotation is about to jump, its derivative is unbounded; the warped stiffness is finite everywhere.
        const auto jumps = !(s.polar.gaps > 1e-4 * size * size * size);
        if (tangent == Tangent::positive) return warped_stiffness(tet, s.polar.rotation, scale);
        const TetStiffnessLanes<S> exact = exact_stiffness(tet, s, scale);
        if (!any(jumps)) return exact;
        const TetStiffnessLanes<S> warped = warped_stiffness(tet, s.polar.rotation, scale);
        return {select(jumps, warped.k11, exact.k11), select(jumps, warped.k21, exact.k21),
                select(jumps, warped.k31, exact.k31), select(jumps, warped.k22, exact.k22),
                select(jumps, warped.k32, exact.k32), select(jumps, warped.k33, exact.k33)};
    }

    template <class S>
    FROND_INLINE static auto inverted(const Strain<S>& s) {
        return s.polar.determinant < 0.0;
    }
};

}  // namespace

Mechanics tet_corotational(int order) {
    return batched_tet_row<Corotational>("tet_corotational", order);
}

}  // namespace frond
