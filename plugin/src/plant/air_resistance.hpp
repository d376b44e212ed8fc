// In: segments of organs, their frames and the air that passes them. Out: resistance, force over velocity.
//
// The air's pressure depends only on the component of its velocity across a stem's axis or along a blade's normal
// (Hoerner 1965; Taylor 1952, "Analysis of the swimming of long and narrow animals"): F = rho/2 Cd A u |u|. So the drag
// of a blade that is bent downwind falls as Gosselin, de Langre, Machado-Almeida 2010 measured.
//   cylinder  Cd = 1 + 10 Re^(-2/3)                       (White 1991, "Viscous fluid flow")
//   sphere    Cd = 24 / Re + 6 / (1 + sqrt Re) + 0.4      (the same); both up to Re = 2e5
// Skin friction is that of a flat plate: 1.328 / sqrt Re on either side (Blasius 1908).
#pragma once

#include "core/lane_functions.hpp"
#include "core/lane_vectors.hpp"
#include "plant/air.hpp"

namespace frond {

// Segments of one shape, one per lane.
template <class S>
struct AirLanes {
    S coefficient, size, skin, chord_along, chord_across;
    Lanes3<S> area;
    // piece(lane) returns the segment of a lane.
    template <class Piece>
    FROND_INLINE explicit AirLanes(const Piece& piece)
        : coefficient(gather<S>([&](int l) { return piece(l).coefficient; })),
          size(gather<S>([&](int l) { return piece(l).size; })),
          skin(gather<S>([&](int l) { return piece(l).skin; })),
          chord_along(gather<S>([&](int l) { return piece(l).chord_along; })),
          chord_across(gather<S>([&](int l) { return piece(l).chord_across; })),
          area{gather<S>([&](int l) { return piece(l).area[0]; }), gather<S>([&](int l) { return piece(l).area[1]; }),
               gather<S>([&](int l) { return piece(l).area[2]; })} {}
};

constexpr double VISCOSITY = 1.5e-5;  // kinematic viscosity of air [m^2/s]

// Drag coefficients by Reynolds number.
template <class S>
FROND_INLINE S cylinder_coefficient(const S& Re) {
    return 1.0 + 10.0 * over_cube_root(S(Re * Re));
}
template <class S>
FROND_INLINE S sphere_coefficient(const S& Re) {
    return 24.0 / Re + 6.0 / (1.0 + sqrt(Re)) + 0.4;
}

// Returns rho/2 Cd A |u| with the area seen along u: exact for an ellipse and for an ellipsoid.
template <class S>
FROND_INLINE S air_pressure(const AirLanes<S>& piece, AirShape shape, const Lanes3<S>& local, double density) {
    constexpr double STILL = 1e-9;  // [m/s]
    const S speed = sqrt(dot(local, local));
    S coefficient = piece.coefficient;
    if (any(coefficient == 0.0)) {
        const S Re = speed * piece.size / VISCOSITY;
        coefficient = select(coefficient > 0.0, coefficient,
                             shape == AirShape::COMPACT ? sphere_coefficient<S>(Re) : cylinder_coefficient<S>(Re));
    }
    const Lanes3<S> seen = scaled(piece.area, local);
    return select(speed > STILL, S(0.5 * density * coefficient * sqrt(dot(seen, seen))), S{});
}

// Returns the resistance by friction of air that flows along the skin.
template <class S>
FROND_INLINE S air_friction(const AirLanes<S>& piece, const S& along, const S& across, double density) {
    const S square = along * along + across * across;
    const S way = select(along < 0.0, S(-along), along) * piece.chord_along +
                  select(across < 0.0, S(-across), across) * piece.chord_across;  // speed times chord
    const auto goes = way > 0.0;
    return select(goes,
                  S(0.5 * 1.328 * density * piece.skin * sqrt(VISCOSITY * square / select(goes, way, constant<S>(1)))),
                  S{});
}

// Returns the resistance along axis, thin and wide to air that passes with velocity `local` in that frame.
template <class S>
FROND_INLINE Lanes3<S> air_resistance(const AirLanes<S>& piece, AirShape shape, const Lanes3<S>& local,
                                      double density) {
    if (shape == AirShape::SHEET) {
        const S rub = air_friction(piece, local.x, local.z, density);
        return {rub, air_pressure(piece, shape, {S{}, local.y, S{}}, density), rub};
    }
    if (shape == AirShape::ROUND) {
        const S push = air_pressure(piece, shape, {S{}, local.y, local.z}, density);
        return {air_friction(piece, local.x, S{}, density), push, push};
    }
    const S push = air_pressure(piece, shape, local, density);
    return {push, push, push};
}

}  // namespace frond
