// Pairs of numbers, in which the elementary functions are computed (Dekker, "A floating-point technique for extending
// the available precision", 1971). Only additions, products, quotients and square roots are used, which IEEE 754
// determines to the last bit as long as no products are fused.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace frond {

// The sum of two numbers, the second one within the first one's last bit.
struct Two {
    double high, low;
};

// The exact sum; quick_sum() if the first number is the larger one.
constexpr Two exact_sum(double a, double b) {
    const double sum = a + b, of_b = sum - a;
    return {sum, (a - (sum - of_b)) + (b - of_b)};
}
constexpr Two quick_sum(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
}
// The exact product, by halves of 26 bits.
constexpr Two exact_product(double a, double b) {
    constexpr double SPLIT = 134217729;  // 2^27 + 1
    const double sa = SPLIT * a, sb = SPLIT * b, product = a * b;
    const double a1 = sa - (sa - a), a2 = a - a1, b1 = sb - (sb - b), b2 = b - b1;
    return {product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2};
}

constexpr Two operator-(const Two& a) {
    return {-a.high, -a.low};
}
constexpr Two operator+(const Two& a, const Two& b) {
    const Two high = exact_sum(a.high, b.high), low = exact_sum(a.low, b.low);
    const Two sum = quick_sum(high.high, high.low + low.high);
    return quick_sum(sum.high, sum.low + low.low);
}
constexpr Two operator-(const Two& a, const Two& b) {
    return a + -b;
}
constexpr Two operator*(const Two& a, const Two& b) {
    const Two product = exact_product(a.high, b.high);
    return quick_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}
constexpr Two operator/(const Two& a, const Two& b) {
    const double first = a.high / b.high;
    const Two rest = a - Two{first, 0} * b;
    const double second = rest.high / b.high;
    return quick_sum(first, second + (rest - Two{second, 0} * b).high / b.high);
}
constexpr Two of(double a) {
    return {a, 0};
}
inline Two root_of(const Two& a) {
    if (a.high <= 0) return of(0);
    const double root = std::sqrt(a.high);
    return quick_sum(root, (a - exact_product(root, root)).high / (2 * root));
}

// Evaluates c[0] + c[1] x + ...
template <int N>
double power_series(const double (&c)[N], double x) {
    double sum = c[N - 1];
    for (int i = N - 2; i >= 0; i--) sum = sum * x + c[i];
    return sum;
}

inline uint64_t bits_of_number(double x) {
    uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
}
inline double number_of_bits(uint64_t bits) {
    double x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
}
// Returns 2^k, for k from -1022 to 1023.
inline double power_of_two(int k) {
    return number_of_bits(uint64_t(k + 1023) << 52);
}
// Returns x 2^k, for k from -2000 to 2000.
inline double scaled_by_two(double x, int k) {
    return x * power_of_two(k / 2) * power_of_two(k - k / 2);
}
// Rounds numbers below 2^51 to integers.
inline double nearest(double x) {
    constexpr double ROUND = 6755399441055744.0;  // 1.5 2^52
    return (x + ROUND) - ROUND;
}

constexpr double INFINITE = std::numeric_limits<double>::infinity(),
                 NAN_VALUE = std::numeric_limits<double>::quiet_NaN();
// Below this, x and its sine, tangent, arc sine and hyperbolic tangent are the same number.
constexpr double SMALLEST_BENT = 0x1p-27;

}  // namespace frond
