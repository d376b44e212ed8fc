// Wind: spectrum, coherence and profile agree with the stated ones; the same seed gives the same bits.
#include "plant/wind_lanes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace frond::test {
namespace wind_tests {

frond_wind_def plain_def() {
    frond_wind_def def = {};
    def.velocity = {8, 0, 0};
    def.turbulence = 0.25;
    def.length_scale = 30;
    def.seed = 1;
    def.profile = FROND_WIND_PROFILE_UNIFORM;
    def.reference_height = 10;
    def.roughness = 0.03;
    def.exponent = 1.0 / 7;
    def.density = 1.2;
    return def;
}

Vec3 wind_at(const Wind& wind, const Vec3& p) {
    std::vector<frond_vec3> out;
    EXPECT_TRUE(wind_velocities(wind, Vec3::UnitY(), 0, {{p.x(), p.y(), p.z()}}, out));
    return Vec3(out[0].x, out[0].y, out[0].z);
}

// Returns gusts that pass a point at intervals of h: later ones are upwind. Each is the mean of `parts` samples within
// h.
std::vector<Vec3> passing(const frond_wind_def& def, int count, double h, int parts = 1) {
    std::vector<frond_vec3> points, velocities;
    for (int i = 0; i < parts * count; i++) points.push_back({1 - def.velocity.x * h * i / parts, 10, 2});
    EXPECT_TRUE(wind_velocities(*make_wind(def), Vec3::UnitY(), 0, points, velocities));
    std::vector<Vec3> series(size_t(count), Vec3::Zero());
    for (size_t i = 0; i < points.size(); i++) {
        const frond_vec3& v = velocities[i];
        series[i / size_t(parts)] += Vec3(v.x - def.velocity.x, v.y, v.z) / parts;
    }
    return series;
}

TEST(Wind, KnowsItsWaves) {
    for (double turns = -3; turns < 3; turns += 1e-3)
        EXPECT_NEAR(cosine_of_turns(constant<TwoLanes>(turns))[0], std::cos(2 * M_PI * turns), 4e-9) << turns;
}

TEST(Wind, HasTheMeanAndTheStandardDeviationsThatAreGiven) {
    const frond_wind_def def = plain_def();
    Vec3 mean = Vec3::Zero(), square = Vec3::Zero();
    const int count = 40000;
    for (const Vec3& gust : passing(def, count, 0.5)) {
        mean += gust / count;
        square += gust.cwiseAbs2() / count;
    }
    EXPECT_LT(mean.norm(), 0.02 * 8);
    // Up is y; z is across.
    EXPECT_NEAR(std::sqrt(square.x()), 0.25 * 8, 0.03 * 2);
    EXPECT_NEAR(std::sqrt(square.z()), 0.8 * 0.25 * 8, 0.03 * 2);
    EXPECT_NEAR(std::sqrt(square.y()), 0.5 * 0.25 * 8, 0.03 * 2);
}

// Returns the power in a band of frequencies, by a discrete Fourier transform of the signal with a Hann window.
double power_between(const std::vector<double>& signal, double h, double low, double high) {
    const int count = int(signal.size());
    double power = 0;
    for (int k = int(std::ceil(low * count * h)); k < high * count * h; k++) {
        double re = 0, im = 0;
        for (int i = 0; i < count; i++) {
            const double window = std::sqrt(8.0 / 3) * std::pow(std::sin(M_PI * i / count), 2);
            const double angle = 2 * M_PI * (double(k) * i / count - std::floor(double(k) * i / count));
            re += window * signal[size_t(i)] * std::cos(angle);
            im += window * signal[size_t(i)] * std::sin(angle);
        }
        power += 2 * (re * re + im * im) / (double(count) * count);
    }
    return power;
}

// Kaimal's spectrum over octaves of n = f L / U, for each component with its own sigma and L.
TEST(Wind, HasKaimalsSpectrum) {
    frond_wind_def def = plain_def();
    const double U = 8, sigma = 0.25 * U;
    const struct {
        int axis;
        double share, length;
    } components[] = {{0, 1, 30}, {2, 0.8, 30 * 2.7 / 8.1}, {1, 0.5, 30 * 0.66 / 8.1}};
    // Means over parts of h prevent aliasing of higher frequencies.
    constexpr int SEEDS = 12, COUNT = 1024, PARTS = 16;
    for (const auto& c : components)
        for (double n = 0.04; n < 2; n *= 4) {
            const double f = n * U / c.length, h = 1 / (40 * f);  // so that the band is well within the series
            double power = 0;
            for (int seed = 1; seed <= SEEDS; seed++) {
                def.seed = uint64_t(seed);
                std::vector<double> signal;
                for (const Vec3& gust : passing(def, COUNT, h, PARTS)) signal.push_back(gust[c.axis]);
                power += power_between(signal, h, f, 4 * f) / SEEDS;
            }
            const auto below = [](double x) { return 1 - std::pow(1 + 6 * x, -2.0 / 3); };
            const double known = std::pow(c.share * sigma, 2) * (below(4 * n) - below(n));
            EXPECT_NEAR(power / known, 1, 0.2) << "axis " << c.axis << ", n " << n;
        }
}

// Coherence exp(-12 r sqrt((f/U)^2 + (0.12/L)^2)) per wave: the mean product of gusts a distance r apart across the
// wind equals its mean over the spectrum.
TEST(Wind, GustsAreCoherentAcrossTheWindAsStated) {
    frond_wind_def def = plain_def();
    const double U = 8, L = 30, sigma = 0.25 * U;
    for (double r : {0.5, 2.0, 8.0}) {
        double product = 0, count = 0;
        for (uint64_t seed = 1; seed <= 60; seed++) {
            def.seed = seed;
            const auto wind = make_wind(def);
            for (int i = 0; i < 200; i++, count++) {
                const double a = wind_at(*wind, Vec3(0, 10, 0)).x() - U, b = wind_at(*wind, Vec3(0, 10, r)).x() - U;
                product += a * b;
                pass_time(*wind, 1.7);
            }
        }
        double known = 0;
        const int slices = 20000;
        for (int i = 0; i < slices; i++) {
            const double energy = (i + 0.5) / slices, n = (std::pow(1 - energy, -1.5) - 1) / 6;
            known += std::exp(-12 * r * std::hypot(n / L, 0.12 / L)) / slices;
        }
        EXPECT_NEAR(product / count / (sigma * sigma), known, 0.08) << r;
    }
}

// The air that passes here now was upwind before.
TEST(Wind, GustsAreCarriedAlong) {
    const auto wind = make_wind(plain_def());
    const Vec3 upwind = wind_at(*wind, Vec3(-16, 3, 1));
    pass_time(*wind, 2);
    EXPECT_NEAR((wind_at(*wind, Vec3(0, 3, 1)) - upwind).norm(), 0, 1e-6);
    EXPECT_GT((wind_at(*wind, Vec3(-16, 3, 1)) - upwind).norm(), 1e-3);
}

TEST(Wind, GrowsWithHeightAsItsProfileSays) {
    frond_wind_def def = plain_def();
    def.turbulence = 0;
    def.ground_height = 2;
    const auto speed = [&](double y) { return wind_at(*make_wind(def), Vec3(0, y, 0)).x(); };
    EXPECT_EQ(speed(-50), 8);
    def.profile = FROND_WIND_PROFILE_LOG;
    EXPECT_NEAR(speed(12), 8, 1e-12);
    EXPECT_NEAR(speed(2 + 1), 8 * std::log(1 / 0.03) / std::log(10 / 0.03), 1e-12);
    EXPECT_EQ(speed(2.03), 0);
    EXPECT_EQ(speed(-1), 0);
    def.profile = FROND_WIND_PROFILE_POWER;
    EXPECT_NEAR(speed(12), 8, 1e-12);
    EXPECT_NEAR(speed(2.5), 8 * std::pow(0.05, 1.0 / 7), 1e-12);
    EXPECT_EQ(speed(1), 0);
}

TEST(Wind, IsTheSameToTheBitForOneSeedAndAnotherForAnother) {
    frond_wind_def def = plain_def();
    const auto series = [&] { return passing(def, 100, 0.1); };
    const std::vector<Vec3> first = series();
    EXPECT_EQ(series(), first);
    def.seed = 2;
    EXPECT_NE(series(), first);
}

// A wind that grows slowly keeps its gusts: there is no jump.
TEST(Wind, ChangesWithoutAJump) {
    frond_wind_def def = plain_def();
    auto wind = make_wind(def);
    pass_time(*wind, 1000);
    const Vec3 before = wind_at(*wind, Vec3(0, 10, 0));
    def.velocity.x = 8.008;
    auto changed = make_wind(def);
    changed->travelled = wind->travelled;
    EXPECT_NEAR((wind_at(*changed, Vec3(0, 10, 0)) - before).norm(), 0, 2e-3 * before.norm());
}

TEST(Wind, MayBlowAlongAnyDirectionEvenUp) {
    for (const frond_vec3& velocity : {frond_vec3{0, 5, 0}, frond_vec3{0, -5, 0}, frond_vec3{3, 1, -2}}) {
        frond_wind_def def = plain_def();
        def.velocity = velocity;
        const Vec3 mean(velocity.x, velocity.y, velocity.z), there = wind_at(*make_wind(def), Vec3(0.3, 4, 1));
        EXPECT_TRUE(there.allFinite());
        EXPECT_LT((there - mean).norm(), mean.norm());
        EXPECT_GT((there - mean).norm(), 0);
    }
}

TEST(Wind, FieldOfTheHostsIsGivenTheWindAndMayChangeIt) {
    frond_wind_def def = plain_def();
    def.turbulence = 0;
    const auto wind = make_wind(def);
    wind->field = [](const frond_vec3* points, int count, double time, frond_vec3* velocities, void* user) {
        for (int i = 0; i < count; i++) velocities[i].y += points[i].z + time;
        *static_cast<int*>(user) += count;
    };
    int asked = 0;
    wind->user = &asked;
    std::vector<frond_vec3> out;
    EXPECT_TRUE(wind_velocities(*wind, Vec3::UnitY(), 0.5, {{0, 1, 2}, {0, 1, 3}}, out));
    EXPECT_EQ(asked, 2);
    EXPECT_EQ(out[0].x, 8);
    EXPECT_EQ(out[1].y, 3.5);
    wind->field = [](const frond_vec3*, int, double, frond_vec3* velocities, void*) {
        velocities[0] = {NAN, 0, 0};
        velocities[1] = {1, 1e9, 0};
    };
    EXPECT_FALSE(wind_velocities(*wind, Vec3::UnitY(), 0.5, {{0, 1, 2}, {0, 1, 3}, {0, 0, 0}}, out));
    EXPECT_EQ(out[0].x, 0);
    EXPECT_EQ(out[1].y, 0);
    EXPECT_EQ(out[2].x, 8);
}

TEST(Wind, UpIsAgainstGravity) {
    EXPECT_EQ(up_of(Vec3(0, 0, -9.81)), Vec3(0, 0, 1));
    EXPECT_EQ(up_of(Vec3(0, 0, 0)), Vec3(0, 1, 0));
}

}  // namespace wind_tests

}  // namespace frond::test
