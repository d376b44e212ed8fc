// Grain: what a tet's tissue resists along the organ's axis beyond what it resists in every direction, as the fibres of a
// stem do. In: the gradient of deformation at a point. Out: energy, stress and stiffness, of a line through the tet that
// lies along the axis in the modelled shape and is a spring. It is why a cage may bend as stiffly as it should and yet
// twist easily: an axis that bends is drawn out at one side, one that is twisted is not.
//
// With a the line's direction at rest, l = |F a| its stretch and g the modulus: W = g/2 (l - 1)^2. Linear mechanics take
// its stretch as a.F a.
#pragma once

#include "mechanics/tet_element.hpp"

namespace frond {

// Adds `by` times b_c.a b_d.a between the corners c and d, b the rest gradients.
inline void add_along_grain(const TetShare& share, const Mat3& by, TetStiffness& k) {
    const Vec3 beta = share.rest_inverse * share.axis;
    k.k11 += beta[0] * beta[0] * by;
    k.k21 += beta[1] * beta[0] * by;
    k.k31 += beta[2] * beta[0] * by;
    k.k22 += beta[1] * beta[1] * by;
    k.k32 += beta[2] * beta[1] * by;
    k.k33 += beta[2] * beta[2] * by;
}

struct TurningGrain {
    // A line pressed together to less than this is pushed apart no harder than in proportion to its length.
    static constexpr double SHORTEST = 0.1;  // [-]

    static double energy(const TetShare& share, const Mat3& F) {
        const double square = (F * share.axis).squaredNorm(), l = std::sqrt(square);
        if (l < SHORTEST) return 0.5 * share.grain * ((1 - 1 / SHORTEST) * square + 1 - SHORTEST);
        return 0.5 * share.grain * (l - 1) * (l - 1);
    }
    static Mat3 stress(const TetShare& share, const Mat3& F) {
        const Vec3 line = F * share.axis;
        return share.grain * tension(line.norm()) * line * share.axis.transpose();
    }
    // The positive one leaves out that tension resists turning: damping is made of it.
    static void add_stiffness(const TetShare& share, const Mat3& F, Tangent tangent, double scale, TetStiffness& k) {
        const Vec3 line = F * share.axis;
        const double l = line.norm(), V = scale * share.volume * share.grain;
        const Vec3 along = line / std::max(l, SHORTEST);
        if (tangent == Tangent::positive) return add_along_grain(share, V * along * along.transpose(), k);
        const double g = tension(l);
        Mat3 by = V * g * Mat3::Identity();
        if (l >= SHORTEST) by += V * (1 - g) * along * along.transpose();
        add_along_grain(share, by, k);
    }
    // Derivative of the force on a corner by a corner's place at rest is beta of the first times this: the line's length,
    // the volume and beta itself change. `gradient` and `beta` are the second corner's.
    static Mat3 rest_derivative(const TetShare& share, const Mat3& F, const Vec3& gradient, double beta) {
        const Vec3 line = F * share.axis;
        const double l = std::max(line.norm(), SHORTEST), g = tension(l);
        return share.volume * share.grain * line *
               ((2 * g + 1 / l) * beta * share.axis - g * gradient).transpose();
    }

private:
    static double tension(double l) { return 1 - 1 / std::max(l, SHORTEST); }  // over g and the line
};

struct StraightGrain {
    static double energy(const TetShare& share, const Mat3& F) {
        const double strain = strain_of(share, F);
        return 0.5 * share.grain * strain * strain;
    }
    static Mat3 stress(const TetShare& share, const Mat3& F) {
        return share.grain * strain_of(share, F) * share.axis * share.axis.transpose();
    }
    static void add_stiffness(const TetShare& share, const Mat3&, Tangent, double scale, TetStiffness& k) {
        add_along_grain(share, scale * share.volume * share.grain * share.axis * share.axis.transpose(), k);
    }
    static Mat3 rest_derivative(const TetShare& share, const Mat3& F, const Vec3& gradient, double beta) {
        const Vec3 &a = share.axis, line = F * a;
        const double strain = strain_of(share, F);
        const Mat3 by_direction =
            strain * (Mat3::Identity() - 2 * a * a.transpose()) + a * (line - 2 * a.dot(line) * a).transpose();
        return -share.volume * share.grain * (strain * a * gradient.transpose() + beta * by_direction);
    }

private:
    static double strain_of(const TetShare& share, const Mat3& F) { return share.axis.dot(F * share.axis) - 1; }
};

// A material with grain. `Law` and its `Strain`, which has F, as tet_row.hpp says.
template <class Law, class Grain>
struct Grained {
    using Own = Law;
    using Grains = Grain;
    static auto strain(const TetShare& share, const Mat3& F) { return Law::strain(share, F); }
    template <class Strain>
    static double energy(const TetShare& share, const Strain& s) {
        return Law::energy(share, s) + (share.grain > 0 ? Grain::energy(share, s.F) : 0);
    }
    template <class Strain>
    static Mat3 stress(const TetShare& share, const Strain& s) {
        if (share.grain > 0) return Law::stress(share, s) + Grain::stress(share, s.F);
        return Law::stress(share, s);
    }
    template <class Strain>
    static TetStiffness stiffness(const TetShare& share, const Strain& s, Tangent tangent, double scale) {
        TetStiffness k = Law::stiffness(share, s, tangent, scale);
        if (share.grain > 0) Grain::add_stiffness(share, s.F, tangent, scale, k);
        return k;
    }
    template <class Strain>
    static bool inverted(const Strain& s) {
        return Law::inverted(s);
    }
};

}  // namespace frond
