// In: nothing. Out: the highest rates at which one core computes and moves data.
#include <algorithm>
#include <chrono>
#include <vector>

#include "core/lanes.hpp"
#include "kernels/kernels.hpp"

namespace frond::kernels {

namespace {

constexpr int CHAINS = 12;  // independent dependency chains, enough to hide an operation's latency
constexpr int ROUNDS = 1 << 16;

// One product and one sum per chain and round; the results are used, so that the compiler keeps them.
template <class S>
FROND_INLINE double chains(double by, double more) {
    S sum[CHAINS];
    for (int c = 0; c < CHAINS; ++c) sum[c] = constant<S>(c);
    for (int round = 0; round < ROUNDS; ++round)
        for (int c = 0; c < CHAINS; ++c) sum[c] = sum[c] * by + more;
    S all = sum[0];
    for (int c = 1; c < CHAINS; ++c) all += sum[c];
    double total = 0;
    for (int lane = 0; lane < LANES<S>; ++lane) total += all[lane];
    return total;
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] double chains_of_four(double by, double more) {
    return chains<FourLanes>(by, more);
}
[[gnu::target("avx2,fma"), gnu::optimize("fp-contract=fast")]] double fused_chains(double by, double more) {
    return chains<FourLanes>(by, more);
}
#endif
double chains_of_two(double by, double more) {
    return chains<TwoLanes>(by, more);
}

[[gnu::noinline]] void triad(double* a, const double* b, const double* c, double s, size_t count) {
    for (size_t i = 0; i + 4 <= count; i += 4)
        store(FourLanes(load<FourLanes>(b + i) + s * load<FourLanes>(c + i)), a + i);
}
#if defined(__x86_64__)
[[gnu::target("avx2"), gnu::noinline]] void triad_of_four(double* a, const double* b, const double* c, double s,
                                                          size_t count) {
    for (size_t i = 0; i + 4 <= count; i += 4)
        store(FourLanes(load<FourLanes>(b + i) + s * load<FourLanes>(c + i)), a + i);
}
#endif

// Returns the time of the fastest of some runs [s].
template <class Job>
double least_seconds(const Job& job) {
    constexpr int GOES = 9;
    double least = 1e9;
    for (int go = 0; go < GOES; ++go) {
        const auto start = std::chrono::steady_clock::now();
        job();
        least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return least;
}

volatile double used;

double flops_a_second(double (*run)(double, double), int lanes) {
    const double seconds = least_seconds([&] { used = run(0.999, 1e-3); });
    return 2.0 * CHAINS * ROUNDS * lanes / seconds;
}

double bytes_a_second(size_t bytes) {
    const size_t count = bytes / sizeof(double) / 3 / 4 * 4, rounds = std::max<size_t>(1, (size_t(1) << 26) / bytes);
    std::vector<double> a(count), b(count, 1.0), c(count, 2.0);
    auto* run = triad;
#if defined(__x86_64__)
    if (most_lanes() >= 4) run = triad_of_four;
#endif
    const double seconds = least_seconds([&] {
        for (size_t round = 0; round < rounds; ++round) run(a.data(), b.data(), c.data(), double(round), count);
    });
    used = a[0];
    return 3.0 * sizeof(double) * double(count) * double(rounds) / seconds;
}

}  // namespace

Ceilings measure_ceilings() {
    constexpr size_t NEAR = 24 << 10, FAR = 192 << 20;  // [bytes]
    Ceilings ceilings = {};
    ceilings.products_and_sums = flops_a_second(chains_of_two, 2);
    ceilings.fused = ceilings.products_and_sums;
#if defined(__x86_64__)
    if (most_lanes() >= 4) ceilings.products_and_sums = flops_a_second(chains_of_four, 4);
    if (most_lanes() >= 4 && __builtin_cpu_supports("fma")) ceilings.fused = flops_a_second(fused_chains, 4);
#endif
    ceilings.triad_near = bytes_a_second(NEAR);
    ceilings.triad_far = bytes_a_second(FAR);
    return ceilings;
}

}  // namespace frond::kernels
