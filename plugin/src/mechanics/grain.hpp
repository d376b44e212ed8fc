// A material with a grain: fibres along one direction, as in stems and blades, that resist stretch. With d = F a, a the
// direction at rest, and the stretch s = |d| - 1 they add W = A/2 s^2, A their modulus: a transversely isotropic solid
// (Spencer 1984, "Continuum theory of the mechanics of fibre-reinforced composites", for fibres alone).
//
// A linear tet is far too stiff in twist if its modulus is that of bending; fibres along an axis are not stretched by a
// twist about it, so cages with a grain bend and twist as their organs do.
#pragma once

#include "mechanics/tet_point.hpp"

namespace frond {

// Applies a material without its grain to single points.
template <class Law>
struct WithoutGrain : Law {
    template <class S>
    FROND_INLINE static auto strain(const TetShareLanes<S>&, const Lanes33<S>& F) {
        return Law::strain(F);
    }
};

// Returns the derivative of the fibres' force on a corner of a linear tet by the place of another one at rest, from the
// gradients of their shape functions at rest. Fibres go through the same points of their tet in every rest shape, so
// their direction and length at rest change with it.
template <class Law>
Mat3 grain_rest_derivative(const TetShare& tet, const Mat3& F, const Vec3& of, const Vec3& by) {
    const Vec3 drawn = F * tet.axis;
    const double size = tet.volume * tet.grain * tet.mu * of.dot(tet.axis), share = by.dot(tet.axis);
    if (!Law::TURNS) {
        const double along = tet.axis.dot(drawn), stretch = along - 1;
        const Vec3 change = stretch * by + share * (drawn - (2 * along + 2 * stretch) * tet.axis);
        return -size * (tet.axis * change.transpose() + stretch * share * Mat3::Identity());
    }
    const double length = drawn.norm();
    if (!(length > 0)) return Mat3::Zero();
    const Vec3 change = (length - 1) * by - (2 * length - 1) * share * tet.axis;
    return -size / length * drawn * change.transpose();
}

// Makes a material with a grain from one without; see tet_by_tet.hpp and tet_row.hpp for what a material is.
template <class Law>
struct Grained {
    static constexpr bool GOES_AHEAD = Law::GOES_AHEAD;

    template <class S>
    struct Strain {
        typename Law::template Strain<S> own;
        Lanes3<S> along;  // direction of the fibres now, of length one
        S stretch;        // [-]
    };

    template <class S>
    FROND_INLINE static Strain<S> strain(const TetShareLanes<S>& tet, const Lanes33<S>& F) {
        const Lanes3<S> drawn = F * tet.axis;
        if (!Law::TURNS) return {Law::strain(F), tet.axis, S(dot(tet.axis, drawn) - 1.0)};
        const S length = sqrt(S(dot(drawn, drawn)));
        // What has no length has no direction, and is not pushed apart.
        const S inverse = 1.0 / select(length > 0.0, length, constant<S>(1));
        return {Law::strain(F), inverse * drawn, length - 1.0};
    }

    template <class S>
    FROND_INLINE static S modulus(const TetShareLanes<S>& tet) {
        return tet.grain * tet.mu;
    }

    template <class S>
    FROND_INLINE static S energy(const TetShareLanes<S>& tet, const Strain<S>& s) {
        return Law::energy(tet, s.own) + 0.5 * modulus(tet) * s.stretch * s.stretch;
    }

    template <class S>
    FROND_INLINE static Lanes33<S> stress(const TetShareLanes<S>& tet, const Strain<S>& s) {
        return Law::stress(tet, s.own) + outer(S(modulus(tet) * s.stretch) * s.along, tet.axis);
    }

    template <class S>
    FROND_INLINE static Lanes33<S> stress_of_change(const TetShareLanes<S>& tet, const Strain<S>& s,
                                                    const Lanes33<S>& dF) {
        return Law::stress_of_change(tet, s.own, dF) +
               outer(S(modulus(tet) * dot(s.along, dF * tet.axis)) * s.along, tet.axis);
    }

    // Adds V A (b_a.a)(b_b.a) (d d^T + s / |d| (I - d d^T)), the second term only if exact.
    template <class S>
    FROND_INLINE static TetStiffnessLanes<S> stiffness(const TetShareLanes<S>& tet, const Strain<S>& s, Tangent tangent,
                                                       const S& scale) {
        TetStiffnessLanes<S> k = Law::stiffness(tet, s.own, tangent, scale);
        const S size = scale * tet.volume * modulus(tet);
        if (!any(size != 0.0)) return k;
        const Lanes3<S> share = tet.rest_inverse * tet.axis;
        Lanes33<S> whole = outer(s.along, size * s.along);
        if (Law::TURNS && tangent == Tangent::exact) {
            const S length = s.stretch + 1.0, by = s.stretch / select(length > 0.0, length, constant<S>(1));
            whole = (1.0 - by) * whole;
            add_to_diagonal(S(size * by), whole);
        }
        const auto add = [&](const S& a, const S& b, Lanes33<S>& block) FROND_INLINED {
            block = block + S(a * b) * whole;
        };
        add(share.x, share.x, k.k11), add(share.y, share.x, k.k21), add(share.z, share.x, k.k31);
        add(share.y, share.y, k.k22), add(share.z, share.y, k.k32), add(share.z, share.z, k.k33);
        return k;
    }

    template <class S>
    FROND_INLINE static auto inverted(const Strain<S>& s) {
        return Law::inverted(s.own);
    }
};

}  // namespace frond
