// In: numbers. Out: their sines and their like, and the angles that have them. Arguments are reduced, and the first
// terms of power series summed, in pairs of numbers; the terms after them, which are small, are summed in single
// numbers.
#include <algorithm>

#include "core/constants.hpp"
#include "core/elementary.hpp"
#include "core/elementary_pair.hpp"

namespace frond {

namespace {

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

}  // namespace

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

}  // namespace frond
