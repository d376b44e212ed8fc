// Lanes: the numbers in a vector register. Each lane gives the same result as a single number, to the last bit and in
// any width: square roots are the processor's own and no products are fused.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

#include "core/constants.hpp"
#include "core/platform/vectors.hpp"

namespace frond {

template <class S>
constexpr int LANES = int(sizeof(S) / sizeof(double));  // numbers of a vector

constexpr int MOST_LANES = 8;  // on any processor

// Runs job.run<S>() in lanes of a width that this processor has; run() has to be FROND_INLINE.
#if defined(FROND_HAS_WIDE_LANES)
template <class Job>
FROND_FOR_EIGHT_LANES void run_in_eight_lanes(const Job& job) {
    job.template run<EightLanes>();
}
template <class Job>
FROND_FOR_FOUR_LANES void run_in_four_lanes(const Job& job) {
    job.template run<FourLanes>();
}
#endif
template <class Job>
FROND_FOR_TWO_LANES void run_in_two_lanes(const Job& job) {
    job.template run<TwoLanes>();
}
// Returns the largest number of lanes on this processor: 2, 4 or 8; tests lower it.
inline int& most_lanes() {
    static int most = lanes_of_processor();
    return most;
}
// Runs a job on elements of one plant, in four lanes at most: eight elements are seldom alike, and writing results lane
// by lane gains nothing from the width.
template <class Job>
void run_in_lanes(const Job& job) {
#if defined(FROND_HAS_WIDE_LANES)
    if (most_lanes() >= 4) return run_in_four_lanes(job);
#endif
    run_in_two_lanes(job);
}
// Runs a job in that many lanes, at most most_lanes().
template <class Job>
void run_in_lanes(int lanes, const Job& job) {
#if defined(FROND_HAS_WIDE_LANES)
    if (lanes == 8) return run_in_eight_lanes(job);
    if (lanes == 4) return run_in_four_lanes(job);
#endif
    (void)lanes;
    run_in_two_lanes(job);
}

// Reads and writes one lane; a plain number is its own only lane.
FROND_INLINE double lane_of(double a, int) {
    return a;
}
FROND_INLINE void set_lane(double& a, int, double value) {
    a = value;
}
template <class S, class = std::enable_if_t<!std::is_arithmetic_v<S>>>
FROND_INLINE auto lane_of(const S& a, int lane) {
    return a[lane];
}
template <class S, class = std::enable_if_t<!std::is_arithmetic_v<S>>>
FROND_INLINE void set_lane(S& a, int lane, double value) {
    a[lane] = value;
}
// Returns one lane of the result of a comparison.
FROND_INLINE bool lane_of(int mask, int) {
    return mask != 0;
}

// Returns a constant in all lanes.
template <class S>
FROND_INLINE S constant(double value) {
    return S{} + value;
}
// Selects lane by lane.
template <class Mask, class S>
FROND_INLINE S select(const Mask& mask, const S& yes, const S& no) {
    return kept_apart<S>(mask ? yes : no);
}
FROND_INLINE bool any(int mask) {
    return mask != 0;
}
template <class Mask>
FROND_INLINE std::enable_if_t<!std::is_arithmetic_v<Mask>, bool> any(const Mask& mask) {
    if constexpr (sizeof(Mask) == sizeof(EightLanes)) {
        const EightLanes ones = select(mask, constant<EightLanes>(1), EightLanes{});
        double sum = 0;
        for (int lane = 0; lane < 8; ++lane) sum += ones[lane];
        return sum > 0;
    }
    auto all = mask[0];
    for (size_t lane = 1; lane < sizeof mask / sizeof mask[0]; ++lane) all |= mask[lane];
    return all != 0;
}
// Returns a bit for each lane in which the mask is true.
FROND_INLINE unsigned bits_of(bool mask) {
    return mask;
}
template <class Mask>
FROND_INLINE unsigned bits_of(const Mask& mask) {
    unsigned bits = 0;
    for (size_t lane = 0; lane < sizeof mask / sizeof mask[0]; ++lane) bits |= unsigned(mask[lane] != 0) << lane;
    return bits;
}
// Returns value(lane) in each lane. Not by a loop: clang would write lane by lane into memory and read all back each
// time.
template <class S, class Value, size_t... LANE>
FROND_INLINE S gather(const Value& value, std::index_sequence<LANE...>) {
    return S{value(int(LANE))...};
}
template <class S, class Value>
FROND_INLINE S gather(const Value& value) {
    return gather<S>(value, std::make_index_sequence<size_t(LANES<S>)>());
}

FROND_INLINE double sqrt(double a) {
    return std::sqrt(a);
}
FROND_INLINE FourLanes sqrt(const FourLanes& a) {
    const TwoLanes low = sqrt(TwoLanes{a[0], a[1]}), high = sqrt(TwoLanes{a[2], a[3]});
    return FourLanes{low[0], low[1], high[0], high[1]};
}
// A single instruction if compiled with -fno-math-errno.
FROND_INLINE EightLanes sqrt(const EightLanes& a) {
    return EightLanes{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3]),
                      std::sqrt(a[4]), std::sqrt(a[5]), std::sqrt(a[6]), std::sqrt(a[7])};
}

// Load and store, at any alignment.
template <class S>
FROND_INLINE S load(const double* from) {
    S out;
    std::memcpy(&out, from, sizeof(S));
    return out;
}
template <class S>
FROND_INLINE void store(const S& value, double* to) {
    std::memcpy(to, &value, sizeof(S));
}

// Four numbers, aligned for a single load or store.
struct alignas(32) Quad {
    double at[4];
};
FROND_INLINE FourLanes load(const Quad& from) {
    return load<FourLanes>(from.at);
}
FROND_INLINE void store(const FourLanes& value, Quad& to) {
    store(value, to.at);
}

// Stores the first three lanes.
FROND_INLINE void store_three(const FourLanes& value, float* to) {
    const auto narrow = convert_lanes<VectorOf<float, 4>::Type>(value);
    std::memcpy(to, &narrow, 3 * sizeof(float));
}

// Transposes a 4x4 matrix.
FROND_INLINE void turn_over(const FourLanes& v0, const FourLanes& v1, const FourLanes& v2, const FourLanes& v3,
                            FourLanes (&out)[4]) {
    const FourLanes a = choose<0, 4, 2, 6>(v0, v1), b = choose<1, 5, 3, 7>(v0, v1);
    const FourLanes c = choose<0, 4, 2, 6>(v2, v3), d = choose<1, 5, 3, 7>(v2, v3);
    out[0] = choose<0, 1, 4, 5>(a, c);
    out[1] = choose<0, 1, 4, 5>(b, d);
    out[2] = choose<2, 3, 6, 7>(a, c);
    out[3] = choose<2, 3, 6, 7>(b, d);
}

// Rounds numbers below 2^51 to integers: adding ROUND leaves no fractional bits.
template <class S>
FROND_INLINE S whole(const S& a) {
    constexpr double ROUND = 6755399441055744.0;  // 1.5 2^52
    return (a + ROUND) - ROUND;
}

// Evaluates c[0] + c[1] x + c[2] x^2 + ...
template <class S, int N>
FROND_INLINE S polynomial(const double (&c)[N], const S& x) {
    S sum = constant<S>(c[N - 1]);
    for (int i = N - 2; i >= 0; --i) sum = sum * x + c[i];
    return sum;
}

// Computes sine and cosine, within 4e-16 for angles of a few turns and less accurately for larger ones: subtracts whole
// half turns, halves the rest and sums its series.
template <class S>
FROND_INLINE void sine_cosine(const S& angle, S& sine, S& cosine) {
    constexpr double PI_BELOW = 1.2246467991473532e-16;  // pi - PI, the double
    constexpr double SINE[] = {
        1, -1.0 / 6, 1.0 / 120, -1.0 / 5040, 1.0 / 362880, -1.0 / 39916800, 1.0 / 6227020800, -1.0 / 1307674368000};
    constexpr double COSINE[] = {1,
                                 -1.0 / 2,
                                 1.0 / 24,
                                 -1.0 / 720,
                                 1.0 / 40320,
                                 -1.0 / 3628800,
                                 1.0 / 479001600,
                                 -1.0 / 87178291200,
                                 1.0 / 20922789888000};
    const S turns = whole<S>(angle * (1 / PI));
    const S half = ((angle - turns * PI) - turns * PI_BELOW) * 0.5, square = half * half;
    const S odd = turns - 2.0 * whole<S>(turns * 0.5);
    const S sign = 1.0 - 2.0 * odd * odd;
    const S s = half * polynomial(SINE, square), c = polynomial(COSINE, square);
    sine = sign * 2.0 * s * c;
    cosine = sign * (c * c - s * s);
}

}  // namespace frond
