// Lanes: functions are correct, and each number is the same as if computed alone, to the last bit, for any width.
#include "core/lane_functions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace frond::test {
namespace lanes_tests {

// Applies all functions to a list of numbers, in lanes of a given width.
struct Functions {
    const std::vector<double>& in;
    std::vector<double>& out;
    template <class S>
    FROND_INLINE void run() const {
        for (size_t i = 0; i < in.size(); i += size_t(LANES<S>)) {
            const S x = gather<S>([&](int lane) { return in[i + size_t(lane)]; });
            S sine, cosine;
            sine_cosine(x, sine, cosine);
            const S all[] = {sine,
                             cosine,
                             sqrt(x * x + 1.0),
                             whole(x),
                             select(x < 0.0, S(-x), x),
                             logarithm<S>(x * x + 1e-3),
                             over_cube_root<S>(x * x + 1e-9),
                             exponential<S>(0.5 * x),
                             select(x > -1.0, select(x < 1.0, x, constant<S>(1)), constant<S>(-1)),
                             magnitude(x)};
            for (int lane = 0; lane < LANES<S>; ++lane)
                for (const S& value : all) out.push_back(value[lane]);
        }
    }
};

std::vector<double> some_numbers() {
    std::mt19937_64 random(3);
    std::vector<double> numbers = {0, 1e-9, -1e-9, M_PI, -M_PI, M_PI / 2, 3 * M_PI, 1e-300};
    for (double size : {1e-4, 1.0, 10.0, 1000.0})
        for (int i = 0; i < 100; ++i) numbers.push_back(std::uniform_real_distribution<double>(-size, size)(random));
    return numbers;
}

TEST(Lanes, OfAnyWidthGiveTheSameBits) {
    const std::vector<double> numbers = some_numbers();
    std::vector<double> two;
    run_in_lanes(2, Functions{numbers, two});
    for (int lanes = 4; lanes <= most_lanes(); lanes *= 2) {
        std::vector<double> wide;
        run_in_lanes(lanes, Functions{numbers, wide});
        EXPECT_EQ(wide, two) << lanes << " lanes";
    }
}

TEST(Lanes, HaveTheFunctionsThatTheyAreNamedFor) {
    const std::vector<double> numbers = some_numbers();
    std::vector<double> out;
    run_in_lanes(Functions{numbers, out});
    for (size_t i = 0; i < numbers.size(); ++i) {
        const double x = numbers[i], *f = out.data() + 10 * i;
        const double near = 4e-16 * std::max(1.0, std::abs(x));
        EXPECT_NEAR(f[0], std::sin(x), near) << x;
        EXPECT_NEAR(f[1], std::cos(x), near) << x;
        EXPECT_EQ(f[2], std::sqrt(x * x + 1)) << x;
        EXPECT_EQ(f[3], std::nearbyint(x)) << x;
        EXPECT_EQ(f[4], std::abs(x)) << x;
        EXPECT_NEAR(f[5], std::log(x * x + 1e-3), 3e-16 * std::max(1.0, std::abs(f[5]))) << x;
        EXPECT_NEAR(f[6] * std::cbrt(x * x + 1e-9), 1, 1e-15) << x;
        EXPECT_NEAR(f[7] * std::exp(-0.5 * x), 1, 4e-16 * std::max(1.0, std::abs(x))) << x;
        EXPECT_EQ(f[8], std::min(std::max(x, -1.0), 1.0)) << x;
        EXPECT_EQ(f[9], std::abs(x)) << x;
    }
}

// Counts wrong results of any() and bits_of() when a single lane is set.
struct AskLanes {
    unsigned& wrong;
    template <class S>
    FROND_INLINE void run() const {
        wrong = unsigned(any(constant<S>(0) > 0.5));
        for (int lane = 0; lane < LANES<S>; ++lane) {
            S one = constant<S>(0);
            one[lane] = 1;
            wrong += unsigned(!any(one > 0.5)) + unsigned(!any(one == 0.0));
            wrong += unsigned(bits_of(one > 0.5) != 1u << lane);
        }
    }
};
TEST(Lanes, TellWhetherThereIsAny) {
    for (int lanes = 2; lanes <= most_lanes(); lanes *= 2) {
        unsigned wrong = 1;
        run_in_lanes(lanes, AskLanes{wrong});
        EXPECT_EQ(wrong, 0u) << lanes << " lanes";
    }
}

}  // namespace lanes_tests

}  // namespace frond::test
