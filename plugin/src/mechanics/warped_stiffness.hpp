// Linear elasticity in a frame rotated by R (warped stiffness, R K0 R^T), positive semi-definite, in lanes.
#pragma once

#include "mechanics/tet_point.hpp"

namespace frond {

template <class S>
FROND_INLINE TetStiffnessLanes<S> warped_stiffness(const TetShareLanes<S>& tet, const Lanes33<S>& R, const S& scale) {
    const Lanes33<S>& B = tet.rest_inverse;
    const S mu = scale * tet.volume * tet.mu, lambda = scale * tet.volume * tet.lambda;
    const Lanes33<S> G = B * transposed(R);  // rows: the rest gradients, rotated
    const auto block = [&](int a, int b) FROND_INLINED {
        Lanes33<S> k = outer(G.r[a], lambda * G.r[b]) + outer(G.r[b], mu * G.r[a]);
        add_to_diagonal(S(mu * dot(B.r[a], B.r[b])), k);
        return k;
    };
    return {block(0, 0), block(1, 0), block(2, 0), block(1, 1), block(2, 1), block(2, 2)};
}

// Returns its stress for a change dF of the deformation gradient: mu (dF + R dF^T R) + lambda tr(R^T dF) R.
template <class S>
FROND_INLINE Lanes33<S> warped_stress(const TetShareLanes<S>& tet, const Lanes33<S>& R, const Lanes33<S>& dF) {
    const S swell = tet.lambda * dot(R, dF);
    return tet.mu * (dF + R * transposed_times(dF, R)) + swell * R;
}

}  // namespace frond
