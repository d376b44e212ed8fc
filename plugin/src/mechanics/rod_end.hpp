// An end of a rod segment: its position, and its rotation as a vector and as the quaternion (w, p). By quaternions the
// midway rotation, and tan(angle/4) of the rotation between the ends, take no trigonometric function, and that
// rotation's vector one arc tangent of a small number.
#pragma once

#include "core/lane_vectors.hpp"

namespace frond {

template <class S>
struct RodEnd {
    Lanes3<S> place, turn;
    S square;     // square of the rotation angle
    S w, half;    // cosine of half the angle, and sine of half the angle over the angle
    Lanes3<S> p;  // vector part of the quaternion
};

template <class S>
FROND_INLINE RodEnd<S> rod_end(const Lanes3<S>& place, const Lanes3<S>& turn) {
    constexpr double TINY = 1e-8;  // square of an angle, below which series are exact [rad^2]
    RodEnd<S> end;
    end.place = place;
    end.turn = turn;
    end.square = dot(turn, turn);
    const auto tiny = end.square < TINY;
    const S angle = sqrt(select(tiny, constant<S>(TINY), end.square));
    S sine, cosine;
    sine_cosine(S(0.5 * angle), sine, cosine);
    end.w = select(tiny, S(1.0 - end.square * 0.125), cosine);
    end.half = select(tiny, S(0.5 - end.square * (1.0 / 48)), S(sine / angle));
    end.p = end.half * turn;
    return end;
}

template <class S>
FROND_INLINE Lanes33<S> rotation_of(const S& w, const Lanes3<S>& p) {
    return turning<S>(p, 2.0 * w, constant<S>(2));
}

// Returns the map from the vector's rate to the angular velocity: I + (1 - cos a)/a^2 [v] + (a - sin a)/a^3 [v]^2.
template <class S>
FROND_INLINE Lanes33<S> rate_of(const RodEnd<S>& end) {
    constexpr double SERIES[] = {1.0 / 6,        -1.0 / 120,        1.0 / 5040,          -1.0 / 362880,
                                 1.0 / 39916800, -1.0 / 6227020800, 1.0 / 1307674368000, -1.0 / 355687428096000};
    const auto small = end.square < 1.0;
    const S square = select(small, constant<S>(1), end.square);
    const S second = select(small, polynomial(SERIES, end.square), S((1.0 - 2.0 * end.half * end.w) / square));
    return turning<S>(end.turn, 2.0 * end.half * end.half, second);
}

// Returns a node's rotary inertia by the rate of its rotation vector. The map to the angular velocity in the node's
// frame is R(v)^T T(v) = T(-v).
template <class S>
FROND_INLINE Lanes33<S> inertia_by_rate(const Lanes3<S>& turn, const Lanes33<S>& inertia) {
    const Lanes33<S> rate = rate_of(rod_end(Lanes3<S>{}, -turn));
    return transposed_times(rate, inertia * rate);
}

}  // namespace frond
