// In: the deformation gradient at a point. Out: energy, stress and stiffness of the stable neo-Hookean solid of Smith,
// de Goes, Kim 2018 ("Stable neo-Hookean flesh simulation"), with I = |F|^2 and J = det F
//   W = m/2 (I - 3) - m/2 log((I + 1)/4) + l/2 (J - a)^2 - l/2 (1 - a)^2,  a = 1 + 3 m / (4 l).
// It is finite and has a restoring force wherever a tet is inverted. m = 4/3 mu and l = lambda + 5/6 mu make it agree
// with Lame's constants at small strain.
//
// The positive stiffness removes the negative eigenvalues from the second derivative of W by F, in closed form in the
// principal frame: three pairs of shear and rotation, and a 3x3 matrix for the stretches themselves.
#include <cmath>
#include <utility>

#include "core/decompose.hpp"
#include "core/elementary.hpp"
#include "mechanics/tet_row.hpp"

namespace frond {

namespace {

// F = U diag(stretch) V^T with U and V of determinant one, so that the stretches' product is J. U and V by columns.
template <class S>
struct Frame {
    Lanes33<S> U, V;
    Lanes3<S> stretch;
};

// Returns U and V of a nearly flat F, for which F^T F has lost the digits of the smallest stretch.
std::pair<Mat3, Mat3> turns_of_flat(const Mat3& F) {
    const SingularParts svd = singular_parts(F);
    Mat3 U = svd.U, V = svd.V;
    if (U.determinant() < 0) U.col(2) *= -1;
    if (V.determinant() < 0) V.col(2) *= -1;
    return {U, V};
}

// Rotates in the plane of p and q so that c_pq of a symmetric matrix, whose third row is r, becomes zero (Jacobi 1846).
// Returns false if all lanes had converged; converged lanes stay unchanged.
template <class S>
FROND_INLINE bool turn_plane(S& pp, S& qq, S& pq, S& pr, S& qr, Lanes3<S>& p, Lanes3<S>& q, const S& least) {
    const auto is_left = (pq > least) | (pq < -least);
    if (!any(is_left)) return false;
    const S twice = 2.0 * pq, gap = qq - pp, root = sqrt(S(gap * gap + twice * twice));
    const S t = select(is_left, S(twice / select(gap < 0.0, S(gap - root), S(gap + root))), constant<S>(0));
    const S c = 1.0 / sqrt(S(1.0 + t * t)), s = t * c;
    pp -= t * pq, qq += t * pq;
    pq = select(is_left, constant<S>(0), pq);
    const S pr_before = pr;
    pr = c * pr - s * qr, qr = s * pr_before + c * qr;
    const Lanes3<S> p_before = p;
    p = c * p - s * q, q = s * p_before + c * q;
    return true;
}

template <class S>
FROND_INLINE Frame<S> principal_frame(const Lanes33<S>& F) {
    constexpr double ROUNDING = 1e-17, FLAT = 1e-6;  // in terms of squared stretches
    constexpr int MOST_SWEEPS = 12;                  // two or three near rest; the rotations converge quadratically
    const Lanes33<S> C = transposed_times(F, F);
    const S size = trace(C), least = ROUNDING * size;
    S c00 = C.r[0].x, c11 = C.r[1].y, c22 = C.r[2].z, c01 = C.r[0].y, c02 = C.r[0].z, c12 = C.r[1].z;
    Frame<S> out = {};
    add_to_diagonal(constant<S>(1), out.V);
    for (int sweep = 0; sweep < MOST_SWEEPS; ++sweep) {
        bool is_left = turn_plane(c00, c11, c01, c02, c12, out.V.r[0], out.V.r[1], least);
        is_left |= turn_plane(c00, c22, c02, c01, c12, out.V.r[0], out.V.r[2], least);
        is_left |= turn_plane(c11, c22, c12, c01, c02, out.V.r[1], out.V.r[2], least);
        if (!is_left) break;
    }
    for (int i = 0; i < 3; ++i) {
        const Lanes3<S> drawn = F * out.V.r[i];
        out.U.r[i] = (1.0 / sqrt(dot(drawn, drawn))) * drawn;
    }
    // If a tet is inverted, the smallest stretch is the negative one.
    const S turned = select(dot(out.U.r[0], cross(out.U.r[1], out.U.r[2])) < 0.0, constant<S>(-1), constant<S>(1));
    const S one = constant<S>(1), c_least = select(c00 < c11, c00, c11), smallest = select(c22 < c_least, c22, c_least);
    const S sign0 = select(c00 == smallest, turned, one), sign1 = select(c00 == smallest, one, turned);
    out.U.r[0] = sign0 * out.U.r[0];
    out.U.r[1] = select(c11 == smallest, sign1, one) * out.U.r[1];
    out.U.r[2] = select((c00 == smallest) | (c11 == smallest), one, turned) * out.U.r[2];
    const S c_most = select(c00 > c11, c00, c11), largest = select(c22 > c_most, c22, c_most);
    // Numbers that are not finite stay so; the solver never gets them.
    const auto is_flat = !(smallest > FLAT * largest);
    if (any(is_flat))
        for (int lane = 0; lane < LANES<S>; ++lane) {
            const Mat3 of_lane = lane_of(F, lane);
            if (!lane_of(is_flat, lane) || !of_lane.allFinite()) continue;
            const auto [U, V] = turns_of_flat(of_lane);
            set_lane(out.U, lane, U.transpose());
            set_lane(out.V, lane, V.transpose());
        }
    const auto along = [&](int i) FROND_INLINED { return S(dot(out.U.r[i], F * out.V.r[i])); };
    out.stretch = {along(0), along(1), along(2)};
    return out;
}

Mat3 without_negative_part(const Mat3& A) {
    const SymmetricParts parts = symmetric_parts(A);
    if (parts.values[0] >= 0) return A;
    return parts.vectors * parts.values.cwiseMax(0).asDiagonal() * parts.vectors.transpose();
}

template <class S>
FROND_INLINE void take_negative_part_out(Lanes33<S>& A) {
    const S minor = A.r[0].x * A.r[1].y - A.r[0].y * A.r[1].x;
    const auto is_positive = (A.r[0].x > 0.0) & (minor > 0.0) & (dot(A.r[0], cross(A.r[1], A.r[2])) > 0.0);
    if (!any(!is_positive)) return;
    for (int lane = 0; lane < LANES<S>; ++lane) {
        const Mat3 of_lane = lane_of(A, lane);
        if (!lane_of(is_positive, lane) && of_lane.allFinite()) set_lane(A, lane, without_negative_part(of_lane));
    }
}

struct Neohookean {
    static constexpr bool GOES_AHEAD = false;

    template <class S>
    struct Strain {
        Lanes33<S> F, cofactor;
        S I, J;  // |F|^2, det F
    };

    template <class S>
    FROND_INLINE static Strain<S> strain(const Lanes33<S>& F) {
        const Lanes33<S> cof = cofactor(F);
        return {F, cof, dot(F, F), dot(F.r[0], cof.r[0])};
    }

    // Terms of stress and stiffness.
    template <class S>
    struct Slopes {
        S m, l;     // the material's own constants [Pa]
        S pull;     // m (1 - 1/(I+1)): stress along F
        S bend;     // 2 m / (I+1)^2: its derivative by I, doubled
        S squeeze;  // l (J - a): stress along the cofactor
    };
    template <class S>
    FROND_INLINE static Slopes<S> slopes(const TetShareLanes<S>& tet, const Strain<S>& s) {
        const S m = (4.0 / 3) * tet.mu, l = tet.lambda + (5.0 / 6) * tet.mu, more = s.I + 1.0;
        return {m, l, m * s.I / more, 2.0 * m / (more * more), l * (s.J - 1.0) - 0.75 * m};
    }

    // The values at rest are subtracted term by term, so that little is lost to rounding near rest.
    template <class S>
    FROND_INLINE static S energy(const TetShareLanes<S>& tet, const Strain<S>& s) {
        const Slopes<S> of = slopes(tet, s);
        const S stretch = s.I - 3.0, swell = s.J - 1.0;
        S bend = stretch;
        for (int l = 0; l < LANES<S>; ++l) set_lane(bend, l, frond::log1p(lane_of(stretch, l) / 4));
        return 0.5 * of.m * (stretch - bend) + 0.5 * of.l * swell * swell - 0.75 * of.m * swell;
    }

    template <class S>
    FROND_INLINE static Lanes33<S> stress(const TetShareLanes<S>& tet, const Strain<S>& s) {
        const Slopes<S> of = slopes(tet, s);
        return of.pull * s.F + of.squeeze * s.cofactor;
    }

    // K_ab = V (pull b_a.b_b I + bend (F b_a)(F b_b)^T + l (C b_a)(C b_b)^T - squeeze [F (b_a x b_b)]), C the cofactor
    // and [.] the cross product: the derivative of C.
    template <class S>
    FROND_INLINE static TetStiffnessLanes<S> exact_stiffness(const TetShareLanes<S>& tet, const Strain<S>& s,
                                                             const S& scale) {
        const Slopes<S> of = slopes(tet, s);
        const Lanes33<S>& B = tet.rest_inverse;
        const S V = scale * tet.volume;
        const Lanes33<S> FB = B * transposed(s.F), CB = B * transposed(s.cofactor);  // one row a corner
        const auto block = [&](int a, int b) FROND_INLINED {
            Lanes33<S> k = outer(FB.r[a], S(V * of.bend) * FB.r[b]) + outer(CB.r[a], S(V * of.l) * CB.r[b]);
            add_to_diagonal(S(V * of.pull * dot(B.r[a], B.r[b])), k);
            if (a == b) return k;
            const Lanes3<S> w = S(V * of.squeeze) * (s.F * cross(B.r[a], B.r[b]));
            k.r[0].y += w.z, k.r[1].x -= w.z;
            k.r[0].z -= w.y, k.r[2].x += w.y;
            k.r[1].z += w.x, k.r[2].y -= w.x;
            return k;
        };
        return {block(0, 0), block(1, 0), block(2, 0), block(1, 1), block(2, 1), block(2, 2)};
    }

    // Tension resists rotation. A solve far from rest needs that; but damping is made of this stiffness too, and must
    // let a body rotate as a whole. So tension counts only beyond this share of the modulus.
    static constexpr double FREE_TURN = 0.05;

    template <class S>
    FROND_INLINE static TetStiffnessLanes<S> positive_stiffness(const TetShareLanes<S>& tet, const Strain<S>& s,
                                                                const S& scale) {
        const Slopes<S> of = slopes(tet, s);
        const Frame<S> frame = principal_frame(s.F);
        const Lanes3<S>& z = frame.stretch;

        // Stretches: second derivatives of W by z. Shears and rotations in the plane of i and j: pull -+ squeeze z_k.
        const Lanes3<S> c = {z.y * z.z, z.z * z.x, z.x * z.y}, squeezed = of.squeeze * z;
        Lanes33<S> A = outer(z, of.bend * z) + outer(c, of.l * c);
        add_to_diagonal(of.pull, A);
        A.r[0].y += squeezed.z, A.r[1].x += squeezed.z;
        A.r[1].z += squeezed.x, A.r[2].y += squeezed.x;
        A.r[0].z += squeezed.y, A.r[2].x += squeezed.y;
        take_negative_part_out(A);
        const auto positive = [](const S& a) FROND_INLINED { return select(a < 0.0, constant<S>(0), a); };
        const auto shear = [&](const S& by) FROND_INLINED { return positive(of.pull - by); };
        const auto turn = [&](const S& by) FROND_INLINED { return positive((of.pull + by) - FREE_TURN * of.m); };
        const auto planes = [&](double sign) FROND_INLINED {
            const auto of_plane = [&](const S& by) FROND_INLINED { return S(0.5 * (shear(by) + sign * turn(by))); };
            const S xy = of_plane(squeezed.z), yz = of_plane(squeezed.x), zx = of_plane(squeezed.y);
            const S none = constant<S>(0);
            return Lanes33<S>{{{none, xy, zx}, {xy, none, yz}, {zx, yz, none}}};
        };
        const Lanes33<S> straight = planes(1), crossed = planes(-1);

        // With b in that frame: K_ij = A_ij b_i b'_j + crossed_ij b_j b'_i, and straight_ij b_j b'_j on the diagonal.
        const Lanes33<S> G = tet.rest_inverse * transposed(frame.V);  // one row a corner
        const S V = scale * tet.volume;
        const auto block = [&](int a, int b) FROND_INLINED {
            const Lanes33<S> outside = outer(G.r[a], V * G.r[b]), across = transposed(outside);
            const Lanes3<S> diagonal = straight * Lanes3<S>{outside.r[0].x, outside.r[1].y, outside.r[2].z};
            Lanes33<S> k;
            for (int i = 0; i < 3; ++i) k.r[i] = scaled(A.r[i], outside.r[i]) + scaled(crossed.r[i], across.r[i]);
            k.r[0].x += diagonal.x, k.r[1].y += diagonal.y, k.r[2].z += diagonal.z;
            return transposed_times(frame.U, k * frame.U);
        };
        return {block(0, 0), block(1, 0), block(2, 0), block(1, 1), block(2, 1), block(2, 2)};
    }

    template <class S>
    FROND_INLINE static TetStiffnessLanes<S> stiffness(const TetShareLanes<S>& tet, const Strain<S>& s, Tangent tangent,
                                                       const S& scale) {
        return tangent == Tangent::exact ? exact_stiffness(tet, s, scale) : positive_stiffness(tet, s, scale);
    }

    template <class S>
    FROND_INLINE static auto inverted(const Strain<S>& s) {
        return s.J < 0.0;
    }
};

}  // namespace

Mechanics tet_neohookean(int order) {
    Mechanics row = tet_row<Neohookean>("tet_neohookean", order, true);
    row.asked_from = 1.0 / 3;  // tension stiffens it
    return row;
}

}  // namespace frond
