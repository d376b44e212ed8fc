// A tet's integration point as materials see it, in lanes: as many tets or points at once as there are lanes; S may be
// a plain number.
#pragma once

#include "core/lane_vectors.hpp"
#include "mechanics/tet_element.hpp"

namespace frond {

// TetShare in lanes.
template <class S>
struct TetShareLanes {
    Lanes33<S> rest_inverse;
    S volume, lambda, mu;
    Lanes3<S> axis;
    S grain;
};

// TetStiffness in lanes.
template <class S>
struct TetStiffnessLanes {
    Lanes33<S> k11, k21, k31, k22, k32, k33;
};
template <class S>
FROND_INLINE TetStiffnessLanes<S> operator*(const S& by, const TetStiffnessLanes<S>& k) {
    return {by * k.k11, by * k.k21, by * k.k31, by * k.k22, by * k.k32, by * k.k33};
}

// Blocks with corner 0, which follow from the others, since a translation gives no force.
template <class S>
struct FirstCorner {
    Lanes33<S> k00, k10, k20, k30;
};
template <class S>
FROND_INLINE FirstCorner<S> first_corner(const TetStiffnessLanes<S>& k) {
    const Lanes33<S> k10 = -(k.k11 + transposed(k.k21) + transposed(k.k31));
    const Lanes33<S> k20 = -(k.k21 + k.k22 + transposed(k.k32));
    const Lanes33<S> k30 = -(k.k31 + k.k32 + k.k33);
    return {-(k10 + k20 + k30), k10, k20, k30};
}

// Returns the stress, extrapolated by the stiffness over the displacement ahead.
template <class Law, class Group, class S, class Strain>
FROND_INLINE Lanes33<S> stress_ahead(const Group& tets, const TetShareLanes<S>& share, const Strain& strain,
                                     const Ahead& ahead, const S& damped) {
    const Lanes33<S> change = tets.edges(ahead.way) + damped * tets.edges(ahead.v);
    return Law::stress(share, strain) + Law::stress_of_change(share, strain, change * share.rest_inverse);
}

template <class S>
FROND_INLINE Mat3 lane_of(const Lanes33<S>& a, int lane) {
    Mat3 out;
    for (int r = 0; r < 3; ++r) {
        out(r, 0) = lane_of(a.r[r].x, lane);
        out(r, 1) = lane_of(a.r[r].y, lane);
        out(r, 2) = lane_of(a.r[r].z, lane);
    }
    return out;
}
template <class S>
FROND_INLINE void set_lane(Lanes33<S>& a, int lane, const Mat3& value) {
    for (int r = 0; r < 3; ++r) {
        set_lane(a.r[r].x, lane, value(r, 0));
        set_lane(a.r[r].y, lane, value(r, 1));
        set_lane(a.r[r].z, lane, value(r, 2));
    }
}
inline Lanes33<double> one_lane(const Mat3& value) {
    Lanes33<double> out;
    set_lane(out, 0, value);
    return out;
}

// Applies a material written for lanes to single points; see tet_by_tet.hpp for what a material is.
template <class Law>
struct PointByPoint {
    using Strain = typename Law::template Strain<double>;
    static TetShareLanes<double> share_of(const TetShare& tet) {
        const Lanes3<double> axis = {tet.axis.x(), tet.axis.y(), tet.axis.z()};
        return {one_lane(tet.rest_inverse), tet.volume, tet.lambda, tet.mu, axis, tet.grain};
    }
    static Strain strain(const TetShare& tet, const Mat3& F) { return Law::strain(share_of(tet), one_lane(F)); }
    static double energy(const TetShare& tet, const Strain& s) { return Law::energy(share_of(tet), s); }
    static Mat3 stress(const TetShare& tet, const Strain& s) { return lane_of(Law::stress(share_of(tet), s), 0); }
    static TetStiffness stiffness(const TetShare& tet, const Strain& s, Tangent tangent, double scale) {
        const TetStiffnessLanes<double> k = Law::stiffness(share_of(tet), s, tangent, scale);
        return {lane_of(k.k11, 0), lane_of(k.k21, 0), lane_of(k.k31, 0),
                lane_of(k.k22, 0), lane_of(k.k32, 0), lane_of(k.k33, 0)};
    }
    static bool inverted(const Strain& s) { return Law::inverted(s); }
};

}  // namespace frond
