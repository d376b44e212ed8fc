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
    Dual& operator+=(const Dual& b) { return *this = *this + b; }
    Dual& operator-=(const Dual& b) { return *this = *this - b; }
    Dual& operator*=(const Dual& b) { return *this = *this * b; }
    Dual& operator/=(const Dual& b) { return *this = *this / b; }
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
    friend bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
    friend bool operator==(const Dual& a, const Dual& b) { return a.value == b.value; }
    friend bool operator!=(const Dual& a, const Dual& b) { return a.value != b.value; }
};

inline Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return {root, a.slope * (0.5 / root)};
}
inline Dual sin(const Dual& a) {
    return {std::sin(a.value), std::cos(a.value) * a.slope};
}
inline Dual cos(const Dual& a) {
    return {std::cos(a.value), -std::sin(a.value) * a.slope};
}
inline Dual tan(const Dual& a) {
    const double tangent = std::tan(a.value);
    return {tangent, (1 + tangent * tangent) * a.slope};
}
inline Dual atan2(const Dual& y, const Dual& x) {
    const double square = x.value * x.value + y.value * y.value;
    return {std::atan2(y.value, x.value), (x.value * y.slope - y.value * x.slope) / square};
}

}  // namespace frond

template <>
struct Eigen::NumTraits<frond::Dual> : Eigen::NumTraits<double> {
    using Real = frond::Dual;
    using NonInteger = frond::Dual;
    using Nested = frond::Dual;
    enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1, ReadCost = 13, AddCost = 13, MulCost = 39 };
};
