// Functions of lanes that work on the bits of numbers; like all of lanes.hpp, they give the same bits in any width.
#pragma once

#include "core/lanes.hpp"

namespace frond {

// Vector of 64-bit integers, for the bits of the numbers in S.
template <class S>
using BitsOf = decltype(S{} < S{});

// Returns the absolute value.
template <class S>
FROND_INLINE S magnitude(const S& x) {
    constexpr long long REST = 0x7fffffffffffffff;
    return S(BitsOf<S>(x) & REST);
}

// Converts integers from 0 to below 2^52 to floating point.
template <class S>
FROND_INLINE S number_of(const BitsOf<S>& bits) {
    constexpr double BEGIN = 4503599627370496.0;  // 2^52, whose mantissa takes the integer
    constexpr long long EXPONENT = 0x4330000000000000;
    return S(bits | EXPONENT) - BEGIN;
}

// Returns the natural logarithm of positive normal numbers, within 3e-16 of the larger of the result and 1.
template <class S>
FROND_INLINE S logarithm(const S& x) {
    constexpr long long FRACTION = 0x000fffffffffffff, OF_ONE = 0x3ff0000000000000;
    constexpr double LN2_ABOVE = 0.693147180369123816490,
                     LN2_BELOW = 1.90821492927058770002e-10;  // the first one's last bits are zero
    constexpr double SERIES[] = {1,        1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9, 1.0 / 11,
                                 1.0 / 13, 1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21};
    const BitsOf<S> bits = BitsOf<S>(x);
    const S above = S((bits & FRACTION) | OF_ONE), power = number_of<S>(bits >> 52) - 1023.0;
    const auto is_large = above > SQRT2;
    const S m = select(is_large, S(0.5 * above), above), whole = select(is_large, S(power + 1.0), power);
    const S s = (m - 1.0) / (m + 1.0);
    return whole * LN2_ABOVE + (whole * LN2_BELOW + 2.0 * s * polynomial(SERIES, S(s * s)));
}

// Returns the exponential of numbers from -700 to 700, with a relative error within 4e-16.
template <class S>
FROND_INLINE S exponential(const S& x) {
    constexpr double LN2_ABOVE = 0.693147180369123816490, LN2_BELOW = 1.90821492927058770002e-10,
                     OVER_LN2 = 1 / (LN2_ABOVE + LN2_BELOW);
    constexpr double BIAS = 4503599627370496.0 + 1023;  // 2^52, whose mantissa takes the exponent
    constexpr double SERIES[] = {
        1,          1,           1.0 / 2,      1.0 / 6,       1.0 / 24,       1.0 / 120,       1.0 / 720,
        1.0 / 5040, 1.0 / 40320, 1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};
    const S power = whole<S>(x * OVER_LN2), rest = (x - power * LN2_ABOVE) - power * LN2_BELOW;
    return polynomial(SERIES, rest) * S(BitsOf<S>(power + BIAS) << 52);
}

// Returns one over the cube root of positive normal numbers, with a relative error within 1e-15: a guess from the
// exponent, then Newton's method.
template <class S>
FROND_INLINE S over_cube_root(const S& x) {
    constexpr int LOW = 12;  // low bits, which the guess does not need
    constexpr double GUESS = double(0x553ef0ff289dd796 >> LOW), BEGIN = 4503599627370496.0;
    constexpr long long FRACTION = 0x000fffffffffffff;
    const S guess = BEGIN + (GUESS - number_of<S>(BitsOf<S>(x) >> LOW) * (1.0 / 3));
    S y = S((BitsOf<S>(guess) & FRACTION) << LOW);
    for (int i = 0; i < 4; ++i) y = y * ((4.0 - x * y * y * y) * (1.0 / 3));
    return y;
}

}  // namespace frond
