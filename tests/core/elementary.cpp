// Elementary functions: near the exact value everywhere, special values as in C, and the same bits on every system.
#include "core/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

namespace frond::test {
namespace elementary_tests {

// Long double, which has 64 bits on x86 and 113 on ARM, is the judge.
static_assert(std::numeric_limits<long double>::digits >= 64, "there is nothing to compare with");

struct Row {
    const char* name;
    double (*function)(double);
    long double (*exact)(long double);
    double lower, upper;    // where arguments are spread evenly
    int smallest, largest;  // exponents of others
    uint64_t hash;          // of values
};
const Row ROWS[] = {{"exp", frond::exp, std::exp, -745, 709, -60, 9, 0x79adcd9d75e5dd9cu},
                    {"log", frond::log, std::log, 0.3, 3, -1074, 1023, 0xf5236642f8c832a8u},
                    {"log1p", frond::log1p, std::log1p, -1, 4, -1022, 1023, 0x9117dc8b0eb3475eu},
                    {"log10", frond::log10, std::log10, 0.01, 100, -1074, 1023, 0x37530633a042c546u},
                    {"cbrt", frond::cbrt, std::cbrt, -8, 8, -1074, 1023, 0x318c77ae6ded73cbu},
                    {"sin", frond::sin, std::sin, -10, 10, -1074, 62, 0xd175e38170d8aff4u},
                    {"cos", frond::cos, std::cos, -10, 10, -1074, 62, 0x22bad4951bcfb901u},
                    {"tan", frond::tan, std::tan, -10, 10, -1074, 62, 0x02d12c44b9ae3828u},
                    {"asin", frond::asin, std::asin, -1, 1, -1074, 0, 0x83ef90982d96d9a0u},
                    {"acos", frond::acos, std::acos, -1, 1, -1074, 0, 0x08b6bed28de84df4u},
                    {"tanh", frond::tanh, std::tanh, -22, 22, -1074, 5, 0xcec43797cab6bf0du}};

// Arguments of either sign, half of them spread evenly, half by their exponents.
struct Arguments {
    std::mt19937_64 random{11};
    double share() { return double(random() >> 11) * 0x1p-53; }
    double by_exponent(int smallest, int largest) {
        const double fraction = share();
        const double size = std::ldexp(1 + fraction, smallest + int(random() % uint64_t(largest - smallest + 1)));
        return random() & 1 ? -size : size;
    }
    double next(const Row& row) {
        return random() & 1 ? row.lower + (row.upper - row.lower) * share() : by_exponent(row.smallest, row.largest);
    }
};

// Returns the error in units of the last place that the exact value has.
double error_of(double value, long double exact) {
    int exponent;
    std::frexp(double(exact), &exponent);
    const double last = std::ldexp(1.0, std::max(exponent - 53, -1074));
    return double(std::abs(((long double)value - exact) / last));
}
bool is_finite(long double exact) {
    return std::abs(exact) <= (long double)std::numeric_limits<double>::max();
}

class OfOne : public ::testing::TestWithParam<Row> {};

// Windows' C library takes sines of x87, which knows pi to 66 bits: it is no judge of them. Their bits are compared
// below.
bool is_judged(const Row& row) {
#ifdef _WIN32
    return row.largest != 62;
#else
    return row.name != nullptr;
#endif
}

TEST_P(OfOne, IsTheExactValueButForTheLastPlace) {
    const Row& row = GetParam();
    if (!is_judged(row)) GTEST_SKIP();
    Arguments arguments;
    double worst = 0, at = 0;
    int count = 0;
    for (int i = 0; i < 100000; i++) {
        const double x = arguments.next(row);
        const long double exact = row.exact(x);
        if (std::isnan(exact)) {
            ASSERT_TRUE(std::isnan(row.function(x))) << x;
            continue;
        }
        if (!is_finite(exact)) continue;
        count++;
        const double error = error_of(row.function(x), exact);
        if (error > worst) worst = error, at = x;
    }
    EXPECT_LT(worst, 0.9) << at;
    EXPECT_GT(count, 25000);
}

TEST_P(OfOne, HasTheSpecialValuesOfC) {
    const Row& row = GetParam();
    if (!is_judged(row)) GTEST_SKIP();
    constexpr double MOST = std::numeric_limits<double>::max(), LEAST = std::numeric_limits<double>::denorm_min();
    for (const double x : std::vector<double>{0, 1, 2, 0.5, 1e300, 1e-310, LEAST, MOST, INFINITY, NAN})
        for (double sign : {1.0, -1.0}) {
            const double value = row.function(sign * x), exact = double(row.exact((long double)(sign * x)));
            if (std::isnan(exact)) {
                EXPECT_TRUE(std::isnan(value)) << sign * x;
                continue;
            }
            EXPECT_DOUBLE_EQ(value, exact) << sign * x;
            if (exact == 0) {
                EXPECT_EQ(std::signbit(value), std::signbit(exact)) << sign * x;
            }
        }
}

// A hash of the values of a hundred thousand arguments, recorded where the judge was good.
TEST_P(OfOne, GivesTheSameBitsEverywhere) {
    const Row& row = GetParam();
    Arguments arguments;
    uint64_t hash = 0;
    for (int i = 0; i < 100000; i++) {
        const double value = row.function(arguments.next(row));
        uint64_t bits = 0;
        if (!std::isnan(value)) std::memcpy(&bits, &value, sizeof bits);
        hash = (hash ^ bits) * 0x100000001b3u;
        hash ^= hash >> 29;
    }
    EXPECT_EQ(hash, row.hash) << row.name;
}

INSTANTIATE_TEST_SUITE_P(Elementary, OfOne, ::testing::ValuesIn(ROWS),
                         [](const ::testing::TestParamInfo<Row>& info) { return std::string(info.param.name); });

TEST(Elementary, FunctionsOfTwoNumbersAreExactButForTheLastPlace) {
    Arguments arguments;
    double worst[3] = {};
    for (int i = 0; i < 200000; i++) {
        const bool is_near = i % 2;
        const double x = arguments.by_exponent(is_near ? -3 : -1074, is_near ? 3 : 1023);
        const double y = arguments.by_exponent(is_near ? -3 : -1074, is_near ? 3 : 1023);
        worst[0] = std::max(worst[0], error_of(frond::atan2(y, x), std::atan2((long double)y, (long double)x)));
        const long double length = std::hypot((long double)x, (long double)y);
        if (is_finite(length)) worst[1] = std::max(worst[1], error_of(frond::hypot(x, y), length));
        // A long double's own power is too inexact for large exponents.
        const double base = std::abs(x), power = arguments.by_exponent(-4, is_near ? 3 : 0);
        const long double raised = std::pow((long double)base, (long double)power);
        if (is_finite(raised)) worst[2] = std::max(worst[2], error_of(frond::pow(base, power), raised));
    }
    EXPECT_LT(worst[0], 0.6);
    EXPECT_LT(worst[1], 0.8);
    EXPECT_LT(worst[2], 0.9);
}

TEST(Elementary, FunctionsOfTwoNumbersHaveTheSpecialValuesOfC) {
    const std::vector<double> numbers = {
        0.0,  1,  2,  3,  0.5,  1e300,  1e-310,  1e19,  9007199254740991.0,  INFINITY, NAN,
        -0.0, -1, -2, -3, -0.5, -1e300, -1e-310, -1e19, -9007199254740991.0, -INFINITY};
    const auto are_same = [](double value, double wanted) {
        if (std::isnan(wanted)) return std::isnan(value);
        return std::abs(value - wanted) <= 4e-16 * std::abs(wanted) ||
               (value == wanted && std::signbit(value) == std::signbit(wanted));
    };
    for (double x : numbers)
        for (double y : numbers) {
            EXPECT_TRUE(are_same(frond::pow(x, y), std::pow(x, y))) << x << " to " << y << ": " << frond::pow(x, y);
            EXPECT_TRUE(are_same(frond::atan2(x, y), std::atan2(x, y)))
                << x << " over " << y << ": " << frond::atan2(x, y);
            EXPECT_TRUE(are_same(frond::hypot(x, y), std::hypot(x, y))) << x << ", " << y << ": " << frond::hypot(x, y);
        }
}

TEST(Elementary, PowersAndRootsOfWholeNumbersAreWhole) {
    for (int i = 1; i <= 200; i++) {
        EXPECT_EQ(frond::cbrt(double(i) * i * i), i);
        EXPECT_EQ(frond::hypot(3 * i, 4 * i), 5 * i);
        EXPECT_EQ(frond::pow(2, i - 100), std::ldexp(1.0, i - 100));
    }
    for (int i = 0; i <= 15; i++) EXPECT_EQ(frond::log10(frond::pow(10, i)), i);
}

// 1.3 million values, folded by FNV-1a. A compiler that fuses products or takes its own functions gives another number.
TEST(Elementary, FunctionsGiveTheSameBitsEverywhere) {
    Arguments arguments;
    uint64_t hash = 14695981039346656037u;
    const auto fold = [&](double value) {
        uint64_t bits = 0;
        if (!std::isnan(value)) std::memcpy(&bits, &value, sizeof bits);
        for (int byte = 0; byte < 8; byte++) hash = (hash ^ (bits >> (8 * byte) & 255)) * 1099511628211u;
    };
    for (int i = 0; i < 100000; i++) {
        for (const Row& row : ROWS) fold(row.function(arguments.next(row)));
        const double x = arguments.by_exponent(-20, 20), y = arguments.by_exponent(-20, 20);
        fold(frond::atan2(y, x));
        fold(frond::hypot(y, x));
        fold(frond::pow(std::abs(x), arguments.by_exponent(-4, 3)));
    }
    EXPECT_EQ(hash, 7707986994785968230u);
}

}  // namespace elementary_tests
}  // namespace frond::test
