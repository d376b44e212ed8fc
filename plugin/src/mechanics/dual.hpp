// Dual: a number with its derivatives by the twelve coordinates of a rod segment (forward differentiation), so that a
// stiffness is exactly the derivative of the force as coded. The derivatives lie in lanes. Eigen's own AutoDiff makes
// dynamic temporaries of such expressions, about which GCC 12 warns.
#pragma once

#include <cmath>

#include "core/elementary.hpp"
#include "core/lanes.hpp"

namespace frond {

template <class S>
struct Dual {
    static constexpr int COUNT = 12, GROUPS = COUNT / LANES<S>;  // numbers of a segment's two ends
    double value;
    S slope[GROUPS];

    FROND_INLINE Dual(double constant = 0) : value(constant), slope{} {}
    FROND_INLINE static Dual variable(double value, int number) {
        Dual dual(value);
        dual.slope[number / LANES<S>][number % LANES<S>] = 1;
        return dual;
    }

    FROND_INLINE Dual operator-() const { return scaled(-1); }
    FROND_INLINE friend Dual operator+(const Dual& a, const Dual& b) {
        Dual out(a.value + b.value);
        for (int i = 0; i < GROUPS; ++i) out.slope[i] = a.slope[i] + b.slope[i];
        return out;
    }
    FROND_INLINE friend Dual operator-(const Dual& a, const Dual& b) {
        Dual out(a.value - b.value);
        for (int i = 0; i < GROUPS; ++i) out.slope[i] = a.slope[i] - b.slope[i];
        return out;
    }
    FROND_INLINE friend Dual operator*(const Dual& a, const Dual& b) {
        Dual out(a.value * b.value);
        for (int i = 0; i < GROUPS; ++i) out.slope[i] = a.value * b.slope[i] + b.value * a.slope[i];
        return out;
    }
    FROND_INLINE friend Dual operator/(const Dual& a, const Dual& b) {
        Dual out(a.value / b.value);
        for (int i = 0; i < GROUPS; ++i) out.slope[i] = (a.slope[i] - out.value * b.slope[i]) / b.value;
        return out;
    }
    // Operations with constants.
    FROND_INLINE Dual scaled(double by) const {
        Dual out(by * value);
        for (int i = 0; i < GROUPS; ++i) out.slope[i] = by * slope[i];
        return out;
    }
    FROND_INLINE Dual moved(double by) const {
        Dual out = *this;
        out.value += by;
        return out;
    }
    FROND_INLINE friend Dual operator+(const Dual& a, double b) { return a.moved(b); }
    FROND_INLINE friend Dual operator+(double a, const Dual& b) { return b.moved(a); }
    FROND_INLINE friend Dual operator-(double a, const Dual& b) { return b.scaled(-1).moved(a); }
    FROND_INLINE friend Dual operator*(double a, const Dual& b) { return b.scaled(a); }
    FROND_INLINE friend Dual operator*(const Dual& a, double b) { return a.scaled(b); }
    FROND_INLINE friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
};

// Returns a function of a from its value f and its derivative by a.
template <class S>
FROND_INLINE Dual<S> function_of(const Dual<S>& a, double f, double derivative) {
    Dual<S> out = a.scaled(derivative);
    out.value = f;
    return out;
}
template <class S>
FROND_INLINE Dual<S> sqrt(const Dual<S>& a) {
    const double root = std::sqrt(a.value);
    return function_of(a, root, 0.5 / root);
}
template <class S>
FROND_INLINE void sine_cosine(const Dual<S>& a, Dual<S>& sine, Dual<S>& cosine) {
    const double s = frond::sin(a.value), c = frond::cos(a.value);
    sine = function_of(a, s, c);
    cosine = function_of(a, c, -s);
}

}  // namespace frond
