// In: numbers. Out: their exponentials, logarithms, powers and roots. Arguments are reduced, and the first terms of
// power series summed, in pairs of numbers; the terms after them, which are small, are summed in single numbers.
#include <algorithm>

#include "core/constants.hpp"
#include "core/elementary.hpp"
#include "core/elementary_pair.hpp"

namespace frond {

namespace {

// The logarithm of 2; the first part has 42 bits, so that its products with exponents are exact.
constexpr double LN2_FIRST = 0x1.62e42fefa3800p-1;
constexpr Two LN2_REST = {0x1.ef35793c76730p-45, 0x1.f97b57a079a19p-103};

// A number (1 + fraction) 2^power.
struct Exponential {
    Two fraction;
    int power;
};

// Computes the exponential of numbers below 1100: subtracts multiples of the logarithm of 2 and sums the series.
Exponential exponential(const Two& x) {
    constexpr double SERIES[] = {0.5,
                                 1.0 / 6,
                                 1.0 / 24,
                                 1.0 / 120,
                                 1.0 / 720,
                                 1.0 / 5040,
                                 1.0 / 40320,
                                 1.0 / 362880,
                                 1.0 / 3628800,
                                 1.0 / 39916800,
                                 1.0 / 479001600,
                                 1.0 / 6227020800,
                                 1.0 / 87178291200,
                                 1.0 / 1307674368000};
    constexpr double OVER_LN2 = 0x1.71547652b82fep+0;
    const double power = nearest(x.high * OVER_LN2);
    const Two first = exact_sum(x.high, -power * LN2_FIRST);
    const Two r = quick_sum(first.high, first.low + (x.low - power * LN2_REST.high));
    return {quick_sum(r.high, r.low + r.high * r.high * power_series(SERIES, r.high)), int(power)};
}
double value_of(const Exponential& e) {
    return scaled_by_two((of(1) + e.fraction).high, e.power);
}
// The exponential of any number that is not NaN.
double exponential_value(const Two& x) {
    if (x.high > 710) return INFINITE;
    if (x.high < -746) return 0;
    return value_of(exponential(x));
}

// A positive number 2^power (1 + fraction), the fraction from -0.3 to 0.42.
struct Split {
    Two fraction;
    double power;
};
Split split(Two x) {
    double power = 0;
    if (x.high < std::numeric_limits<double>::min()) {
        x.high *= power_of_two(54);
        power = -54;
    }
    int exponent = int(bits_of_number(x.high) >> 52) - 1023;
    if (x.high * scaled_by_two(1, -exponent) > SQRT2) exponent++;
    const double scale = scaled_by_two(1, -exponent);
    const Two fraction = exact_sum(x.high * scale, -1);
    return {quick_sum(fraction.high, fraction.low + x.low * scale), power + exponent};
}

// The terms from s^9 on of 2 artanh(s), over s^9: powers of s^2.
constexpr double ARTANH[] = {2.0 / 9,  2.0 / 11, 2.0 / 13, 2.0 / 15, 2.0 / 17, 2.0 / 19,
                             2.0 / 21, 2.0 / 23, 2.0 / 25, 2.0 / 27, 2.0 / 29};

// Computes the logarithm of positive finite numbers by log(1 + f) = 2 artanh(f/(2 + f)).
double logarithm_value(const Two& x) {
    constexpr double FIRST[] = {2.0 / 3, 2.0 / 5, 2.0 / 7};
    const auto [fraction, power] = split(x);
    const Two under = quick_sum(2, fraction.high);
    const double s = fraction.high / under.high, square = s * s, fourth = square * square;
    const Two whole = exact_product(s, under.high);
    const double rest =
        ((fraction.high - whole.high) - whole.low + (fraction.low - s * (under.low + fraction.low))) / under.high;
    const double above = s * square * (power_series(FIRST, square) + fourth * square * power_series(ARTANH, square));
    const Two sum = exact_sum(power * LN2_FIRST, 2 * s);
    return sum.high + (sum.low + (power * LN2_REST.high + (2 * rest + above)));
}
// The same as a pair, good for 2^-75.
Two logarithm_of(double x) {
    constexpr Two FIRST[] = {of(2), of(2) / of(3), of(2) / of(5), of(2) / of(7)};
    const auto [fraction, power] = split(of(x));
    const Two s = fraction / (fraction + of(2)), square = s * s;
    Two sum = of(power_series(ARTANH, square.high));
    for (int i = 3; i >= 0; i--) sum = FIRST[i] + square * sum;
    return of(power * LN2_FIRST) + (of(power) * LN2_REST + s * sum);
}

}  // namespace

double exp(double x) {
    return std::isnan(x) ? x : exponential_value(of(x));
}

double log(double x) {
    if (x == 0) return -INFINITE;
    if (!(x > 0)) return NAN_VALUE;
    return x == INFINITE ? x : logarithm_value(of(x));
}

double log1p(double x) {
    if (x == -1) return -INFINITE;
    if (!(x > -1)) return NAN_VALUE;
    if (x == INFINITE || std::abs(x) < 0x1p-54) return x;
    return logarithm_value(exact_sum(1, x));
}

double log10(double x) {
    constexpr Two OVER_LN10 = {0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57};
    if (x == 0) return -INFINITE;
    if (!(x > 0)) return NAN_VALUE;
    return x == INFINITE ? x : (logarithm_of(x) * OVER_LN10).high;
}

double pow(double x, double y) {
    if (y == 0 || x == 1) return 1;
    if (std::isnan(x) || std::isnan(y)) return NAN_VALUE;
    const double size = std::abs(x);
    const bool is_whole = std::abs(y) >= 0x1p52 || nearest(y) == y,
               is_odd = is_whole && std::abs(y) < 0x1p53 && std::floor(y / 2) * 2 != y;
    const double sign = std::signbit(x) && is_odd ? -1 : 1;
    if (size == 0 || size == INFINITE) return sign * ((size == 0) == (y > 0) ? 0 : INFINITE);
    if (std::abs(y) == INFINITE) return size == 1 ? 1 : (size > 1) == (y > 0) ? INFINITE : 0;
    if (x < 0 && !is_whole) return NAN_VALUE;
    if (size == 1) return sign;
    const Two logarithm = logarithm_of(size);
    const double about = y * logarithm.high;
    if (std::abs(about) > 800) return sign * (about > 0 ? INFINITE : 0);
    return sign * exponential_value(std::abs(about) < 0x1p-60 ? of(0) : of(y) * logarithm);
}

double cbrt(double x) {
    if (x == 0 || !std::isfinite(x)) return x;
    // Of a number around 1: the power of two that is left out has a whole third. One step of Newton's method follows,
    // from a root that is right but for its last bit.
    const int third = int(nearest(split(of(std::abs(x))).power / 3));
    const double size = scaled_by_two(std::abs(x), -3 * third), root = exponential_value(logarithm_of(size) / of(3));
    const Two square = exact_product(root, root);
    const double better = root - (square * of(root) - of(size)).high / (3 * square.high);
    return std::copysign(scaled_by_two(better, third), x);
}

double hypot(double x, double y) {
    if (std::isinf(x) || std::isinf(y)) return INFINITE;
    const double largest = std::max(std::abs(x), std::abs(y));
    if (!(largest > 0)) return x + y == 0 ? 0 : NAN_VALUE;
    const int power = largest > 0x1p400 ? 600 : largest < 0x1p-400 ? -600 : 0;
    const double a = scaled_by_two(x, -power), b = scaled_by_two(y, -power);
    return scaled_by_two(root_of(exact_product(a, a) + exact_product(b, b)).high, power);
}

double tanh(double x) {
    if (std::isnan(x)) return x;
    const double size = std::abs(x);
    if (size < SMALLEST_BENT) return x;
    if (size > 20) return std::copysign(1.0, x);
    // (e - 1)/(e + 1), e the exponential of 2 x
    const Exponential e = exponential(of(2 * size));
    const double scale = power_of_two(e.power);
    const Two rest = of(scale - 1) + Two{scale * e.fraction.high, scale * e.fraction.low};
    return std::copysign((rest / (rest + of(2))).high, x);
}

}  // namespace frond
