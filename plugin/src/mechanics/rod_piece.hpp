// In: a rod segment and the positions and rotations of its two ends. Out: its strain, the gradient of its energy, its
// stiffness. Written for any number type: lanes, or numbers that carry their derivatives.
#pragma once

#include "mechanics/rod_end.hpp"

namespace frond {

// A segment at rest; see RodSegment.
template <class S>
struct RodPiece {
    S length, centre, warping;
    Lanes33<S> frame;
    Lanes3<S> stretch, bend, rest_strain, rest_curvature, set_curvature;
    S set_w;
    Lanes3<S> set_p;
};

// A segment cannot turn half way round against itself, by bending, twist or both, as there the midway frame would flip
// and its moments change their sign: beyond two radians the measure of bending and twist grows faster than the angle,
// to 2.7 times at half a turn. `quarter` is the axis of the rotation times tan(angle/4), of the given square. Sets the
// growth and its derivative by the rotation vector, which is along that.
template <class S>
FROND_INLINE void fold_up(const Lanes3<S>& quarter, const S& square, S& fold, Lanes3<S>& fold_slope) {
    constexpr double FROM = 0.29844638;  // tan(angle/4)^2 at two radians
    constexpr double STIFFNESS = 5;      // so that the growth at half a turn is 2.7 times [-]
    const S beyond = select(square < FROM, constant<S>(0), S(square - FROM));
    const S grown = STIFFNESS * beyond * beyond;
    fold = 1.0 + grown * beyond;
    fold_slope = (1.5 * grown * (1.0 + square)) * quarter;
}

// Deformation of a segment by its two ends.
template <class S>
struct RodBent {
    Lanes3<S> chord;               // [m]
    Lanes33<S> first;              // rotation of the first end, half of the plastic one added
    Lanes3<S> turn;                // rotation vector of the second end relative to the first, without the plastic one
    Lanes3<S> quarter;             // its axis times tan(angle/4)
    S cotangent;                   // angle/2 cot(angle/2)
    S fold;                        // curvature is by fold * turn
    Lanes3<S> fold_slope;          // derivative of fold by turn
    Lanes33<S> middle;             // the frame at the midway rotation
    Lanes3<S> strain, curvature;   // relative to rest
    Lanes3<S> along;               // direction of the chord in the frame `middle`
    S twist_slope;                 // derivative of the measure of twist by twist
    S tilt_thin, tilt_wide;        // of the chord from the midway frame
    S tilt_scale;                  // derivative of tilt by the chord's component across, for a straight chord
    S stretch_scale;               // derivative of the strain along by the chord's length
    S stretch_thin, stretch_wide;  // and by the curvature [m]
};

// Sets the strain by the chord in the frame `middle`, over the length at rest. Stretch is the ratio of lengths and tilt
// 2 tan(angle/2), by the angle between chord and frame, so that what tilts a segment does not lengthen it.
template <class S>
FROND_INLINE void measure_chord(const Lanes3<S>& chord, RodBent<S>& out) {
    constexpr double SHORT = 1e-9, LEAST = 1e-6;  // keep a chord of no length, and one turned around, finite
    const S length = sqrt(SHORT * SHORT + dot(chord, chord)), sum = length + chord.x;
    out.along = (1.0 / length) * chord;
    out.tilt_scale = 2.0 / select(sum < LEAST, constant<S>(LEAST), sum);
    out.tilt_thin = out.tilt_scale * chord.y;
    out.tilt_wide = out.tilt_scale * chord.z;
    out.strain = {length, out.tilt_thin, out.tilt_wide};
}

// Returns the chord, as above, of a strain that is not relative to rest.
template <class S>
FROND_INLINE Lanes3<S> chord_of_strain(const Lanes3<S>& strain) {
    const S square = 0.25 * (strain.y * strain.y + strain.z * strain.z), by = strain.x / (1.0 + square);
    return {by * (1.0 - square), by * strain.y, by * strain.z};
}

// Returns the derivative of the strain by the chord, as above, times a matrix.
template <class S>
FROND_INLINE Lanes33<S> strain_change(const RodBent<S>& bent, const Lanes33<S>& m) {
    const Lanes3<S> longer = transposed_times(m, bent.along);
    const Lanes3<S> turned = (0.5 * bent.tilt_scale) * (longer + m.r[0]);
    return {{bent.stretch_scale * longer, bent.tilt_scale * m.r[1] - bent.tilt_thin * turned,
             bent.tilt_scale * m.r[2] - bent.tilt_wide * turned}};
}
// Returns its transposed times a vector.
template <class S>
FROND_INLINE Lanes3<S> strain_change_transposed(const RodBent<S>& bent, const Lanes3<S>& f) {
    const S turned = 0.5 * bent.tilt_scale * (bent.tilt_thin * f.y + bent.tilt_wide * f.z);
    return (bent.stretch_scale * f.x - turned) * bent.along +
           Lanes3<S>{-turned, bent.tilt_scale * f.y, bent.tilt_scale * f.z};
}

// A tapered segment bends as if most of its bending were at its elastic centre, so that its chord follows the farther
// end more. Returns a strain with the tilt that this leaves, for one with the tilt from the midway axis, by the
// curvature; `way` -1: the other way round. Then tilt and bending store energy apart from each other.
template <class S>
FROND_INLINE Lanes3<S> tilt_at_centre(const RodPiece<S>& rod, const Lanes3<S>& strain, const Lanes3<S>& curvature,
                                      const S& way) {
    const S by = way * rod.centre;
    return {strain.x, strain.y + by * curvature.z, strain.z - by * curvature.y};
}

// The arc that a bent segment is.
template <class S>
struct RodBow {
    S longer, longer_slope;  // by what it is longer than its chord, over that, and the derivative by its angle's square
    S firm;                  // root of its stiffness over EA, where it is stretched little
    S give_thin, give_wide;  // 1 / firm^2 is 1 plus these times squares of curvatures [m^2]
};

// An arc of the angle a is a^2 / 24 + 7 a^4 / 5760 longer than its chord, here bounded by 0.54. Tension straightens it:
// a clamped beam that is so bowed yields by a^2 L^3 / (720 EI), in series with L / EA.
template <class S>
FROND_INLINE RodBow<S> bow_of(const RodPiece<S>& rod, const Lanes3<S>& curvature) {
    const S area = rod.length * rod.length, give = (1.0 / 720) * area * area * rod.stretch.x;
    const S square = area * (curvature.y * curvature.y + curvature.z * curvature.z);
    const S over = 1.0 / sqrt(576.0 + square * (4.0 * square - 33.6));
    RodBow<S> bow;
    bow.longer = square * over;
    bow.longer_slope = (576.0 - 16.8 * square) * over * over * over;
    bow.give_thin = give / rod.bend.y;
    bow.give_wide = give / rod.bend.z;
    bow.firm = 1.0 / sqrt(1.0 + bow.give_thin * curvature.y * curvature.y + bow.give_wide * curvature.z * curvature.z);
    return bow;
}

// The strain along, so that half of EA times its square is the energy, by how much longer an arc is than at rest; and
// its derivatives by that and by the bow's length and firmness. It yields by no more than it is longer than its chord.
template <class S>
struct ArcStrain {
    S strain, slope, by_longer, by_firm;
};
template <class S>
FROND_INLINE ArcStrain<S> arc_strain(const RodBow<S>& bow, const S& beyond) {
    constexpr double NONE = 1e-24;  // square of a strain that is none
    const S over = 1.0 / sqrt(beyond * beyond + bow.longer * bow.longer + NONE), loose = 1.0 - bow.firm;
    const S straight = bow.longer * over, stretched = beyond * over;
    return {beyond * (1.0 - loose * straight), 1.0 - loose * straight * straight * straight,
            -loose * stretched * stretched * stretched, beyond * straight};
}
// Does the inverse. The strain is convex, so Newton's method converges from above.
template <class S>
FROND_INLINE S stretch_of_arc(const RodBow<S>& bow, const S& strain) {
    constexpr int ITERATIONS = 4;
    const S most = strain * (1.0 / bow.firm - 1.0), sign = select(strain < 0.0, constant<S>(-1), constant<S>(1));
    S beyond = strain + select(sign * most < bow.longer, most, S(sign * bow.longer));
    for (int i = 0; i < ITERATIONS; ++i) {
        const ArcStrain<S> at = arc_strain(bow, beyond);
        beyond = beyond - (at.strain - strain) / at.slope;
    }
    return beyond;
}

// Takes the strain along, which is the chord's, to that of the arc.
template <class S>
FROND_INLINE void measure_arc(const RodPiece<S>& rod, const Lanes3<S>& curvature, RodBent<S>& out) {
    const RodBow<S> bow = bow_of(rod, curvature);
    const ArcStrain<S> arc = arc_strain(bow, S(out.strain.x * (1.0 + bow.longer) - rod.rest_strain.x));
    const S by_bend = 2.0 * rod.length * rod.length * bow.longer_slope * (arc.slope * out.strain.x + arc.by_longer);
    const S by_give = arc.by_firm * bow.firm * bow.firm * bow.firm;
    out.stretch_scale = arc.slope * (1.0 + bow.longer);
    out.stretch_thin = (by_bend - by_give * bow.give_thin) * curvature.y;
    out.stretch_wide = (by_bend - by_give * bow.give_wide) * curvature.z;
    out.strain.x = rod.rest_strain.x + arc.strain;
}
// Takes such a strain back to the chord's.
template <class S>
FROND_INLINE Lanes3<S> chord_strain(const RodPiece<S>& rod, const Lanes3<S>& strain, const Lanes3<S>& curvature) {
    const RodBow<S> bow = bow_of(rod, curvature);
    const S beyond = stretch_of_arc(bow, S(strain.x - rod.rest_strain.x));
    return {(rod.rest_strain.x + beyond) / (1.0 + bow.longer), strain.y, strain.z};
}

// Adds the curvature's part, as above, to the derivative of the strain by an end.
template <class S>
FROND_INLINE void add_bend(const RodPiece<S>& rod, const RodBent<S>& bent, const Lanes33<S>& bend, Lanes33<S>& strain) {
    strain.r[0] = strain.r[0] + bent.stretch_thin * bend.r[1] + bent.stretch_wide * bend.r[2];
    strain.r[1] = strain.r[1] + rod.centre * bend.r[2];
    strain.r[2] = strain.r[2] - rod.centre * bend.r[1];
}

// Measures a segment's twist [1/m] so that half its stiffness times the square is the energy per length. A section that
// twists stretches its rim and shortens its middle: besides Saint-Venant's G J twist^2 / 2 that stores E twist^4 / 8
// times the integral of (r^2 - mean r^2)^2 over the section (Wagner's effect, Timoshenko and Goodier 1951, section
// 103); A width^4 / 180 for strips, and A width^4 / 192 for circles, where it does not count. It is what keeps blades
// from being wound up.
template <class S>
FROND_INLINE void measure_twist(const RodPiece<S>& rod, RodBent<S>& out) {
    const S grown = rod.warping * out.curvature.x * out.curvature.x, scale = sqrt(1.0 + grown);
    out.twist_slope = (1.0 + 2.0 * grown) / scale;
    out.curvature.x = scale * out.curvature.x;
}

template <class S>
FROND_INLINE RodBent<S> bend_between(const RodPiece<S>& rod, const RodEnd<S>& a, const RodEnd<S>& b) {
    // atan(x)/x by powers of x^2, for x up to tan(pi/8): the best uniform (Chebyshev) approximation, within 2e-18.
    constexpr double ARC[] = {0.99999999999999999874,   -0.33333333333333121163,  0.19999999999940891408,
                              -0.14285714279250239667,  0.11111110744919395758,   -0.090908968090564377814,
                              0.076920453307659118451,  -0.066629518120618369597, 0.058468782857870010961,
                              -0.050351024039430294125, 0.037965256099576568431,  -0.017805395704537507381};
    RodBent<S> out;
    out.chord = b.place - a.place;
    // Each end meets the other half way along the plastic rotation.
    const S a_w = a.w * rod.set_w - dot(a.p, rod.set_p), b_w = b.w * rod.set_w + dot(b.p, rod.set_p);
    const Lanes3<S> a_p = a.w * rod.set_p + rod.set_w * a.p + cross(a.p, rod.set_p);
    const Lanes3<S> b_p = rod.set_w * b.p - b.w * rod.set_p - cross(b.p, rod.set_p);
    out.first = rotation_of(a_w, a_p);
    S w = a_w * b_w + dot(a_p, b_p);
    Lanes3<S> u = a_w * b_p - b_w * a_p - cross(a_p, b_p);
    const S sign = select(w < 0.0, constant<S>(-1), constant<S>(1));
    w = w * sign;
    const S over = 1.0 / (1.0 + w);
    out.quarter = (sign * over) * u;
    const S square = dot(out.quarter, out.quarter), secant = sqrt(1.0 + square), eighth = 1.0 / (1.0 + secant);
    const S angle_over = 8.0 * eighth * polynomial(ARC, S(square * eighth * eighth));  // angle over tan(angle/4)
    out.turn = angle_over * out.quarter;
    out.cotangent = 0.5 * angle_over * over * w;
    fold_up(out.quarter, square, out.fold, out.fold_slope);
    const S shrink = 1.0 / secant;
    const S w_middle = (a_w - dot(a_p, out.quarter)) * shrink;
    const Lanes3<S> p_middle = shrink * (a_p + a_w * out.quarter + cross(a_p, out.quarter));
    out.middle = rotation_of(w_middle, p_middle) * rod.frame;
    const S per_length = 1.0 / rod.length;
    measure_chord(per_length * transposed_times(out.middle, out.chord), out);
    out.curvature = per_length * transposed_times(rod.frame, out.fold * out.turn);
    const Lanes3<S> whole = out.curvature + rod.set_curvature;
    measure_arc(rod, whole, out);
    out.strain = tilt_at_centre(rod, out.strain, whole, constant<S>(1)) - rod.rest_strain;
    measure_twist(rod, out);
    out.curvature = out.curvature - rod.rest_curvature;
    return out;
}

// Returns the coefficient of [v]^2 in the inverse of rate_of(), I - [v]/2 + (1 - a/2 cot(a/2))/a^2 [v]^2.
template <class S>
FROND_INLINE S inverse_rate_second(const RodBent<S>& bent) {
    // |B_2k| / (2k)!, B_2k the Bernoulli numbers
    constexpr double SERIES[] = {0.083333333333333333333,   0.0013888888888888888889,  3.3068783068783068783e-5,
                                 8.2671957671957671958e-7,  2.0876756987868098979e-8,  5.2841901386874931848e-10,
                                 1.3382536530684678833e-11, 3.3896802963225828668e-13, 8.5860620562778445641e-15,
                                 2.174868698558061873e-16,  5.5090028283602295152e-18};
    const S square = dot(bent.turn, bent.turn);
    const auto small = square < 1.0;
    return select(small, polynomial(SERIES, square), S((1.0 - bent.cotangent) / select(small, constant<S>(1), square)));
}

// Gradient of the energy by position and rotation vector of either end.
template <class S>
struct RodGradient {
    Lanes3<S> place_a, turn_a, place_b, turn_b;
};

template <class S>
FROND_INLINE RodGradient<S> gradient_of(const RodPiece<S>& rod, const Lanes33<S>& rate_a, const Lanes33<S>& rate_b,
                                        const RodBent<S>& bent) {
    const Lanes3<S> pull = scaled(rod.stretch, bent.strain);
    const Lanes3<S> force = bent.middle * strain_change_transposed(bent, pull);
    const Lanes3<S> middle_moment = cross(force, bent.chord);
    Lanes3<S> moment = scaled(rod.bend, bent.curvature);
    moment = {bent.twist_slope * moment.x, moment.y - rod.centre * pull.z + bent.stretch_thin * pull.x,
              moment.z + rod.centre * pull.y + bent.stretch_wide * pull.x};
    const Lanes3<S> by_fold = rod.frame * moment;
    const Lanes3<S> couple = bent.fold * by_fold + dot(bent.turn, by_fold) * bent.fold_slope;
    const Lanes3<S> turned = cross(bent.turn, couple);
    const Lanes3<S> end_moment =
        bent.first * (couple + constant<S>(0.5) * turned + inverse_rate_second(bent) * cross(bent.turn, turned));
    // The midway rotation follows the second end's by (1 - [R1 quarter]) / 2.
    const Lanes3<S> second =
        constant<S>(0.5) * (middle_moment + cross(bent.first * bent.quarter, middle_moment)) + end_moment;
    return {-force, transposed_times(rate_a, middle_moment - second), force, transposed_times(rate_b, second)};
}

// Derivatives of strain and curvature by the ends: strain changes by strain_chord (place b - place a) + strain_a turn_a
// + strain_b turn_b, curvature by bend_b turn_b - bend_a turn_a; all over the length.
template <class S>
struct RodChange {
    Lanes33<S> strain_chord, strain_a, strain_b, bend_a, bend_b;
};

template <class S>
FROND_INLINE RodChange<S> change_of(const RodPiece<S>& rod, const Lanes33<S>& rate_a, const Lanes33<S>& rate_b,
                                    const RodBent<S>& bent) {
    const Lanes3<S>& c = bent.chord;
    const Lanes3<S> share = bent.first * bent.quarter;
    Lanes33<S> seen, by_share;
    for (int i = 0; i < 3; ++i) {
        // Rows of middle^T [chord], and of its product with the second end's share of the midway rotation.
        const Lanes3<S> axis = i == 0   ? Lanes3<S>{bent.middle.r[0].x, bent.middle.r[1].x, bent.middle.r[2].x}
                               : i == 1 ? Lanes3<S>{bent.middle.r[0].y, bent.middle.r[1].y, bent.middle.r[2].y}
                                        : Lanes3<S>{bent.middle.r[0].z, bent.middle.r[1].z, bent.middle.r[2].z};
        seen.r[i] = cross(axis, c);
        by_share.r[i] = constant<S>(0.5) * (seen.r[i] - cross(seen.r[i], share));
    }
    const Lanes33<S> inverse_rate = turning<S>(bent.turn, constant<S>(-0.5), inverse_rate_second(bent));
    Lanes33<S> folding = bent.fold * inverse_rate;
    for (int i = 0; i < 3; ++i)
        folding.r[i] = folding.r[i] + (i == 0 ? bent.turn.x : i == 1 ? bent.turn.y : bent.turn.z) * bent.fold_slope;
    Lanes33<S> turning_by = transposed_times(rod.frame, folding) * transposed(bent.first);
    turning_by.r[0] = bent.twist_slope * turning_by.r[0];
    RodChange<S> out = {strain_change(bent, transposed(bent.middle)), strain_change(bent, (seen - by_share) * rate_a),
                        strain_change(bent, by_share * rate_b), turning_by * rate_a, turning_by * rate_b};
    add_bend(rod, bent, -out.bend_a, out.strain_a);
    add_bend(rod, bent, out.bend_b, out.strain_b);
    return out;
}

// Computes the lower blocks (r, c), c <= r, at [r (r + 1) / 2 + c], of the stiffness's positive semi-definite part.
template <class S>
FROND_INLINE void positive_stiffness(const RodPiece<S>& rod, const RodChange<S>& change, Lanes33<S> (&K)[10]) {
    const S per_length = 1.0 / rod.length;
    const Lanes3<S> stretch = per_length * rod.stretch, bend = per_length * rod.bend;
    const Lanes33<S> pulled = scaled_rows(stretch, change.strain_chord);
    const Lanes33<S> weighted_a = scaled_rows(stretch, change.strain_a),
                     weighted_b = scaled_rows(stretch, change.strain_b);
    const Lanes33<S> bent_a = scaled_rows(bend, change.bend_a), bent_b = scaled_rows(bend, change.bend_b);
    K[0] = transposed_times(change.strain_chord, pulled);
    K[1] = -transposed_times(change.strain_a, pulled);
    K[2] = transposed_times(change.strain_a, weighted_a) + transposed_times(change.bend_a, bent_a);
    K[3] = -K[0];
    K[4] = -transposed(K[1]);
    K[5] = K[0];
    K[6] = -transposed_times(change.strain_b, pulled);
    K[7] = transposed_times(change.strain_b, weighted_a) - transposed_times(change.bend_b, bent_a);
    K[8] = -K[6];
    K[9] = transposed_times(change.strain_b, weighted_b) + transposed_times(change.bend_b, bent_b);
}

}  // namespace frond
