// Vector registers as compilers offer them: GNU vectors, whose operators and comparisons work lane by lane.
#pragma once

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

#include <cmath>

#include "core/platform/compiler.hpp"

// GCC warns that the ABI of vector arguments depends on the target; none are passed, since all functions are inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace frond {

template <class Number, int COUNT>
struct VectorOf {
    using Type [[gnu::vector_size(COUNT * sizeof(Number))]] = Number;
};
using TwoLanes = VectorOf<double, 2>::Type;
using FourLanes = VectorOf<double, 4>::Type;
using EightLanes = VectorOf<double, 8>::Type;

// Functions that are compiled for a width. AVX-512 includes fused products, so code that runs in eight lanes has to be
// compiled with -ffp-contract=off.
#if defined(__x86_64__)
#define FROND_HAS_WIDE_LANES
#define FROND_FOR_EIGHT_LANES [[gnu::target("avx512f")]]
#define FROND_FOR_FOUR_LANES [[gnu::target("avx2")]]
#endif
// On x86-64 two lanes serve only processors from before 2013, so the compiler spends little time on them.
#if defined(__x86_64__) && !defined(__clang__)
#define FROND_FOR_TWO_LANES [[gnu::optimize("O1")]]
#else
#define FROND_FOR_TWO_LANES
#endif

// Returns the largest number of lanes that this processor has: 2, 4 or 8.
inline int lanes_of_processor() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx512f") ? 8 : __builtin_cpu_supports("avx2") ? 4 : 2;
#else
    return 2;
#endif
}

// Returns the value. Keeps GCC from merging selects in eight lanes into one mask, which it would evaluate lane by lane.
template <class S>
FROND_INLINE S kept_apart(const S& value) {
    S kept = value;
#if defined(__x86_64__) && !defined(__clang__)
    if constexpr (sizeof(S) == sizeof(EightLanes)) asm("" : "+v"(kept));
#endif
    return kept;
}

FROND_INLINE TwoLanes sqrt(const TwoLanes& a) {
#if defined(__SSE2__)
    return _mm_sqrt_pd(a);
#elif defined(__aarch64__)
    return vsqrtq_f64(a);
#elif defined(__wasm_simd128__)
    return TwoLanes(wasm_f64x2_sqrt(v128_t(a)));
#else
    return TwoLanes{std::sqrt(a[0]), std::sqrt(a[1])};
#endif
}

// Converts lane by lane.
template <class To, class From>
FROND_INLINE To convert_lanes(const From& from) {
    return __builtin_convertvector(from, To);
}

// Shuffles two vectors: lanes 0 to 3 are the first one's, 4 to 7 the second one's.
template <int A, int B, int C, int D>
FROND_INLINE FourLanes choose(const FourLanes& v, const FourLanes& w) {
#ifdef __clang__
    return __builtin_shufflevector(v, w, A, B, C, D);
#else
    using Places = VectorOf<long long, 4>::Type;
    return __builtin_shuffle(v, w, Places{A, B, C, D});
#endif
}

}  // namespace frond
