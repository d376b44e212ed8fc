// Dual: a number with its derivatives by the twelve coordinates of a piece of rod, carried along by the chain rule
// (forward differentiation), so that a stiffness is exactly the derivative of the force as it is written. Eigen's own
// AutoDiff makes dynamic temporaries of such expressions, about which GCC 12 warns.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace frond {

struct Dual {
    using Slope = Eigen::Array<double, 12, 1>;
    double value;
    Slope slope;

    Dual(double constant = 0) : value(constant), slope(Slope::Zero()) {}
    Dual(double value, const Slope& slope) : value(value), slope(slope) {}
    static Dual variable(double value, int number) {
        Dual dual(value);
        dual.slope[number] = 1;
        return dual;
    }

    Dual operator-() const { return {-value, -slope}; }
    friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.slope + b.slope}; }
    friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.slope - b.slope}; }
    friend Dual operator*(const Dual& a, const Dual& b) {
        return {a.value * b.value, a.value * b.slope + b.value * a.slope};
    }
    friend Dual operator/(const Dual& a, const Dual& b) {
        const double quotient = a.value / b.value;
        return {quotient, (a.slope - quotient * b.slope) / b.value};
    }
    friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
};

inline Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return {root, a.slope * (0.5 / root)};
}
inline void sine_cosine(const Dual& a, Dual& sine, Dual& cosine) {
    const double s = std::sin(a.value), c = std::cos(a.value);
    sine = {s, c * a.slope};
    cosine = {c, -s * a.slope};
}

}  // namespace frond
