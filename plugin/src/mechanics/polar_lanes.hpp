// The rotation nearest to a deformation gradient, in lanes.
//
// The trace t of S = R^T F is the largest root of p(t) = t^4 - 2 |F|^2 t^2 - 8 det F t + 2 |F^T F|^2 - |F|^4, Horn's
// quartic for absolute orientation (Horn 1987, "Closed-form solution of absolute orientation using unit quaternions").
// Since R is the gradient of t with respect to F, differentiating p(t, F) = 0 gives R in closed form.
#pragma once

#include "mechanics/polar.hpp"
#include "mechanics/tet_point.hpp"

namespace frond {

// Polar in lanes.
template <class S>
struct PolarLanes {
    Lanes33<S> rotation;
    S trace, gaps, determinant;
};

template <class S>
FROND_INLINE PolarLanes<S> polar_in_lanes(const Lanes33<S>& F) {
    const Lanes33<S> C = transposed_times(F, F), cof = cofactor(F);
    const S det = dot(F.r[0], cof.r[0]), size = trace(C);  // |F|^2

    // Newton's method from above: sqrt(3) |F| bounds the trace and is exact for a rotation. Converged lanes stay.
    const S c0 = 2.0 * dot(C, C) - size * size;
    S t = sqrt(S(3.0 * size)), last = constant<S>(1);
    for (int iteration = 0; iteration < 30; ++iteration) {
        const S t2 = t * t;
        const S value = (t2 - 2.0 * size) * t2 - 8.0 * det * t + c0;
        const S step = select(last != 0, S(value / (4.0 * ((t2 - size) * t - 2.0 * det))), constant<S>(0));
        t -= step;
        // The step after one of 1e-9 would be 1e-18.
        const S over = 1e-9 * t;
        last = select((step > over) | (step < -over), step, constant<S>(0));
        if (!any(last != 0)) break;
    }

    // Twice the product of the gaps; where it is small, the quotient loses digits.
    const S slope = (t * t - size) * t - 2.0 * det, inverse = 1.0 / slope;
    const S f = (t * t + size) * inverse, c = 2.0 * t * inverse;
    PolarLanes<S> out = {f * F + c * cof - (2.0 * inverse) * (F * C), t, 0.5 * slope, det};
    const auto sound = (slope > 0.1 * size * sqrt(size)) & (size > 1e-60);
    if (any(!sound))
        for (int lane = 0; lane < LANES<S>; ++lane) {
            if (lane_of(sound, lane)) continue;
            const Polar slow = polar_by_values(lane_of(F, lane));
            set_lane(out.rotation, lane, slow.rotation);
            set_lane(out.trace, lane, slow.trace);
            set_lane(out.gaps, lane, slow.gaps);
        }
    return out;
}

}  // namespace frond
