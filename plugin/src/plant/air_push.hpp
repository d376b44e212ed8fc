// The air's push on segments of a plant, half of it at each end: several segments of one shape at once, or one segment
// of several plants.
#pragma once

#include "mechanics/rod_piece.hpp"
#include "plant/air_resistance.hpp"

namespace frond {

// Returns axis, thin and wide as rows; zero where the segment has collapsed.
template <class S>
FROND_INLINE Lanes33<S> air_frame(const Lanes3<S>& chord, const Lanes3<S>& wide) {
    constexpr double LEAST = 1e-9;  // [m], [-]
    const S length = sqrt(dot(chord, chord));
    const auto is_long = length > LEAST;
    const Lanes3<S> axis = (1.0 / select(is_long, length, constant<S>(1))) * chord;
    const Lanes3<S> across = wide - dot(axis, wide) * axis;
    const S size = sqrt(dot(across, across));
    const auto is_wide = size > LEAST;
    const S over = select(is_wide, S(1.0 / select(is_wide, size, constant<S>(1))), S{});
    const Lanes3<S> along = select(is_long, over * size, S{}) * axis, beside = select(is_long, over, S{}) * across;
    return {{along, cross(beside, along), beside}};
}

// Returns the rotation matrix of a node with this rotation vector.
template <class S>
FROND_INLINE Lanes33<S> rotation_by(const Lanes3<S>& turn) {
    const RodEnd<S> at = rod_end(Lanes3<S>{}, turn);
    return rotation_of(at.w, at.p);
}
// Turns a direction of the chain with a node.
template <class S>
FROND_INLINE Lanes3<S> turned_by(const Lanes3<S>& turn, const Lanes3<S>& direction) {
    return rotation_by(turn) * direction;
}

// The air's push at one end of a segment, from the air's velocity past it and its own: a symmetric matrix, xx, xy, xz,
// yy, yz, zz, and the share of it that is added as damping within a step of h [s].
template <class S>
struct AirPush {
    S resistance[6];  // [N s/m]
    S lag;            // [-]
};
template <class S>
FROND_INLINE AirPush<S> air_push(const AirLanes<S>& piece, AirShape shape, const Lanes33<S>& frame,
                                 const Lanes3<S>& passing, const Lanes3<S>& velocity, double density, double h) {
    const Lanes3<S> d = air_resistance(piece, shape, frame * passing, density);
    const Lanes33<S> by = scaled_rows(constant<S>(0.5) * d, frame), half = transposed_times(frame, by);
    // Pressure acts along the normal at the start of the step. A segment that wind could carry past itself within the
    // step is damped, so that it turns no farther than that allows: no effect at rest, first order in the step [-].
    constexpr double MANY = 2;
    const Lanes3<S> wind = passing + velocity;
    return {{half.r[0].x, half.r[0].y, half.r[0].z, half.r[1].y, half.r[1].z, half.r[2].z},
            MANY * h * sqrt(dot(wind, wind)) / piece.chord_along};
}

}  // namespace frond
