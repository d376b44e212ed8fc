// What the air does to pieces of a plant, at their ends a half each: several pieces of a shape at once, or one piece of
// several plants.
#pragma once

#include "mechanics/rod_piece.hpp"
#include "plant/air_resistance.hpp"

namespace frond {

// Axis, thin, wide as rows; nothing where the piece has lost its shape.
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

// Of a node that is turned so.
template <class S>
FROND_INLINE Lanes33<S> rotation_by(const Lanes3<S>& turn) {
    const RodEnd<S> at = rod_end(Lanes3<S>{}, turn);
    return rotation_of(at.w, at.p);
}
// A direction of the chain, turned as a node is.
template <class S>
FROND_INLINE Lanes3<S> turned_by(const Lanes3<S>& turn, const Lanes3<S>& direction) {
    return rotation_by(turn) * direction;
}

// At one end of a piece, of air that passes it and of its own velocity: a symmetric matrix, xx, xy, xz, yy, yz, zz, and
// how much of it more it is held back by within a step of h [s].
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
    // Pressure is along the normal of the step's start. What a wind could carry past itself within a step is held back
    // from turning by more than that allows: of no effect on what rests, and of first order in the step [-].
    constexpr double MANY = 2;
    const Lanes3<S> wind = passing + velocity;
    return {{half.r[0].x, half.r[0].y, half.r[0].z, half.r[1].y, half.r[1].z, half.r[2].z},
            MANY * h * sqrt(dot(wind, wind)) / piece.chord_along};
}

}  // namespace frond
