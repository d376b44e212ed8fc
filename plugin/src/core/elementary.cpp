// In: numbers. Out: their elementary functions. Arguments are reduced, and the first terms of power series summed, in
// pairs of numbers (Dekker, "A floating-point technique for extending the available precision", 1971); the terms after
// them, which are small, are summed in single numbers. Only additions, products, quotients and square roots are used,
// which IEEE 754 determines to the last bit as long as no products are fused.
#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/constants.hpp"

namespace frond {

namespace {

// ---- pairs ----

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
Two root_of(const Two& a) {
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

// ---- bits ----

uint64_t bits_of_number(double x) {
    uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
}
double number_of_bits(uint64_t bits) {
    double x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
}
// Returns 2^k, for k from -1022 to 1023.
double power_of_two(int k) {
    return number_of_bits(uint64_t(k + 1023) << 52);
}
// Returns x 2^k, for k from -2000 to 2000.
double scaled_by_two(double x, int k) {
    return x * power_of_two(k / 2) * power_of_two(k - k / 2);
}
// Rounds numbers below 2^51 to integers.
double nearest(double x) {
    constexpr double ROUND = 6755399441055744.0;  // 1.5 2^52
    return (x + ROUND) - ROUND;
}

constexpr double INFINITE = std::numeric_limits<double>::infinity(),
                 NAN_VALUE = std::numeric_limits<double>::quiet_NaN();

// ---- exponentials and logarithms ----

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

// ---- angles ----

constexpr Two HALF_PI = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr Two WHOLE_PI = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

struct Reduced {
    Two angle;  // within a quarter of pi
    int quadrant;
};

// Subtracts multiples of pi/2 from large numbers (Payne and Hanek, "Radian reduction for trigonometric functions",
// 1983): multiplies by those bits of 2/pi that matter.
Reduced reduce_large(double x) {
    // 2/pi, after 64 bits that are zero.
    static const uint32_t BITS[] = {0,          0,          0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0, 0xdb629599,
                                    0x3c439041, 0xfe5163ab, 0xdebbc561, 0xb7246e3a, 0x424dd2e0, 0x06492eea, 0x09d1921c,
                                    0xfe1deb1c, 0xb129a73e, 0xe88235f5, 0x2ebb4484, 0xe99c7026, 0xb45f7e41, 0x3991d639,
                                    0x835339f4, 0x9c845f8b, 0xbdf9283b, 0x1ff897ff, 0xde05980f, 0xef2f118b, 0x5a0a6d1f,
                                    0x6d367ecf, 0x27cb09b7, 0x4f463f66, 0x9e5fea2d, 0x7527bac7, 0xebe5f17b, 0x3d0739f7,
                                    0x8a5292ea, 0x6bfb5fb1, 0x1f8d5d08, 0x56033046, 0xfc7b6bab};
    constexpr int LIMBS = 6;
    const uint64_t bits = bits_of_number(x);
    const uint64_t whole = (bits & 0xfffffffffffff) | 0x10000000000000;  // |x| is whole times 2^exponent
    const int exponent = int((bits >> 52) & 0x7ff) - 1075, first = exponent - 2 + 64;

    // The product modulo four quadrants, in units of 2^-190 quadrants; the last limb is the highest.
    uint32_t product[LIMBS] = {};
    for (int part = 0; part < 2; part++) {
        const uint64_t factor = part == 0 ? uint32_t(whole) : uint32_t(whole >> 32);
        uint64_t carry = 0;
        for (int i = 0; i + part < LIMBS; i++) {
            const int at = first / 32 + LIMBS - 1 - i, shift = first % 32;
            const uint64_t limb = uint32_t(((uint64_t(BITS[at]) << 32 | BITS[at + 1]) << shift) >> 32);
            carry += limb * factor + product[i + part];
            product[i + part] = uint32_t(carry);
            carry >>= 32;
        }
    }

    // The nearest quadrant, and the signed rest.
    int quadrant = int(product[LIMBS - 1] >> 30);
    for (int i = LIMBS - 1; i >= 0; i--) product[i] = product[i] << 2 | (i > 0 ? product[i - 1] >> 30 : 0);
    const bool is_below = product[LIMBS - 1] >> 31;
    if (is_below) {
        quadrant++;
        uint64_t carry = 1;
        for (uint32_t& limb : product) {
            carry += uint32_t(~limb);
            limb = uint32_t(carry);
            carry >>= 32;
        }
    }
    Two rest = of(0);
    for (int i = 0; i < LIMBS; i++) rest = rest + of(product[i] * power_of_two(32 * (i - LIMBS)));
    Two angle = rest * HALF_PI;
    if (is_below != (x < 0)) angle = -angle;
    return {angle, x < 0 ? -quadrant : quadrant};
}

// Subtracts multiples of pi/2; of smaller numbers in four parts, of which three have 33 bits (Cody and Waite, "Software
// manual for the elementary functions", 1980).
Reduced reduce(double x) {
    if (std::abs(x) <= 0.25 * PI) return {of(x), 0};
    if (std::abs(x) > 131072) return reduce_large(x);
    const double n = nearest(x * 0x1.45f306dc9c883p-1);
    Two angle = exact_sum(x - n * 0x1.921fb54400000p+0, -n * 0x1.0b4611a600000p-34);
    angle = angle + of(-n * 0x1.3198a2e000000p-69);
    return {angle + of(-n * 0x1.b839a252049c1p-104), int(n)};
}

// Sine and cosine of an angle within a quarter of pi.
Two sine_of(const Two& x) {
    constexpr double SERIES[] = {-1.0 / 6,
                                 1.0 / 120,
                                 -1.0 / 5040,
                                 1.0 / 362880,
                                 -1.0 / 39916800,
                                 1.0 / 6227020800,
                                 -1.0 / 1307674368000,
                                 1.0 / 355687428096000.0,
                                 -1.0 / 121645100408832000.0};
    const double square = x.high * x.high;
    return quick_sum(x.high, x.low * (1 - 0.5 * square) + x.high * square * power_series(SERIES, square));
}
Two cosine_of(const Two& x) {
    constexpr double SERIES[] = {1.0 / 24,
                                 -1.0 / 720,
                                 1.0 / 40320,
                                 -1.0 / 3628800,
                                 1.0 / 479001600,
                                 -1.0 / 87178291200,
                                 1.0 / 20922789888000.0,
                                 -1.0 / 6402373705728000.0,
                                 1.0 / 2432902008176640000.0};
    const Two square = exact_product(x.high, x.high), first = quick_sum(1, -0.5 * square.high);
    const double fourth = square.high * square.high;
    return quick_sum(first.high,
                     first.low - (0.5 * square.low + x.high * x.low) + fourth * power_series(SERIES, square.high));
}
// The sine of an angle some quadrants further on.
double sine_in_quadrant(const Reduced& at, int further) {
    const int quadrant = (at.quadrant + further) & 3;
    const double sine = quadrant % 2 == 0 ? sine_of(at.angle).high : cosine_of(at.angle).high;
    return quadrant >= 2 ? -sine : sine;
}

// The angle of a triangle's corner from its two legs, which are not negative: the arc tangent of the nearest eighth,
// and the series for the difference.
Two corner_of(const Two& opposite, const Two& adjacent) {
    constexpr Two OF_EIGHTHS[] = {of(0),
                                  {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                  {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                  {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                  {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                  {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                  {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                  {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                  {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};
    constexpr double SERIES[] = {-1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11, 1.0 / 13, -1.0 / 15, 1.0 / 17};
    if (opposite.high > adjacent.high) return HALF_PI - corner_of(adjacent, opposite);
    const double eighths = nearest(8 * (opposite.high / adjacent.high));
    const Two near = of(eighths / 8);
    const Two rest = (opposite - near * adjacent) / (adjacent + near * opposite);
    const double square = rest.high * rest.high;
    return OF_EIGHTHS[int(eighths)] +
           quick_sum(rest.high, rest.low + rest.high * square * power_series(SERIES, square));
}

// The square root of 1 - x^2.
Two other_leg(double x) {
    return root_of(exact_sum(1, -x) * exact_sum(1, x));
}

// Below this, x and its sine, tangent, arc sine and hyperbolic tangent are the same number.
constexpr double SMALLEST_BENT = 0x1p-27;

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

double sin(double x) {
    if (!std::isfinite(x)) return NAN_VALUE;
    return std::abs(x) < SMALLEST_BENT ? x : sine_in_quadrant(reduce(x), 0);
}

double cos(double x) {
    return std::isfinite(x) ? sine_in_quadrant(reduce(x), 1) : NAN_VALUE;
}

double tan(double x) {
    if (!std::isfinite(x)) return NAN_VALUE;
    if (std::abs(x) < SMALLEST_BENT) return x;
    const Reduced at = reduce(x);
    const Two sine = sine_of(at.angle), cosine = cosine_of(at.angle);
    return (at.quadrant % 2 == 0 ? sine / cosine : -cosine / sine).high;
}

double asin(double x) {
    const double size = std::abs(x);
    if (!(size <= 1)) return NAN_VALUE;
    return size < SMALLEST_BENT ? x : std::copysign(corner_of(of(size), other_leg(size)).high, x);
}

double acos(double x) {
    const double size = std::abs(x);
    if (!(size <= 1)) return NAN_VALUE;
    const Two angle = corner_of(other_leg(size), of(size));
    return (x < 0 ? WHOLE_PI - angle : angle).high;
}

double atan2(double y, double x) {
    if (std::isnan(x) || std::isnan(y)) return NAN_VALUE;
    double along = std::abs(x), aside = std::abs(y);
    if (along == INFINITE && aside == INFINITE) along = aside = 1;
    Two angle;
    if (aside == 0 || along == INFINITE) {
        angle = of(0);
    } else if (along < 0x1p-100 * aside || aside == INFINITE) {
        angle = HALF_PI;
    } else if (aside < 0x1p-100 * along) {
        angle = of(aside / along);
    } else {
        const int power = std::max(along, aside) > 0x1p400 ? -600 : std::max(along, aside) < 0x1p-400 ? 600 : 0;
        angle = corner_of(of(scaled_by_two(aside, power)), of(scaled_by_two(along, power)));
    }
    if (std::signbit(x)) angle = WHOLE_PI - angle;
    return std::copysign(angle.high, y);
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
