// The known solutions, recomputed by quadrature, series and finite differences, and compared with published digits.
#include "study/known.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace frond::study;

namespace known_tests {

struct Digits {
    double load, down, short_by, degrees;
};

TEST(Known, ElasticaUnderAnEndLoadHasThePublishedDigits) {
    for (const Digits& d : {Digits{0.25, 0.08275, 0.00412, 7.121}, Digits{1, 0.30172, 0.05643, 26.434},
                            Digits{2, 0.49346, 0.16064, 44.791}, Digits{5, 0.71379, 0.38763, 69.635},
                            Digits{10, 0.81061, 0.55500, 81.949}}) {
        const Droop droop = droop_of(d.load, 0);
        EXPECT_NEAR(droop.down, d.down, 6e-6);
        EXPECT_NEAR(1 - droop.along, d.short_by, 6e-6);
        EXPECT_NEAR(droop.angle * 180 / M_PI, d.degrees, 6e-4);
    }
}

// For a given angle f of the end: curvature^2 = 2 a (sin f - sin t), so the length is an integral over t, which must be
// 1.
TEST(Known, ElasticaUnderAnEndLoadMeetsItsIntegral) {
    for (double a : {0.25, 1.0, 2.0, 5.0, 10.0}) {
        const Droop droop = droop_of(a, 0);
        const double f = droop.angle;
        EXPECT_NEAR(droop.along, std::sqrt(2 * std::sin(f) / a), 1e-9);
        double length = 0, down = 0;
        const int slices = 20000;
        for (int i = 0; i < slices; i++) {
            // t = f - u^2 removes the singularity of the integrand.
            const double u = std::sqrt(f) * (i + 0.5) / slices, t = f - u * u;
            const double part = 2 * u * std::sqrt(f) / slices / std::sqrt(2 * a * (std::sin(f) - std::sin(t)));
            length += part;
            down += std::sin(t) * part;
        }
        EXPECT_NEAR(length, 1, 1e-6);
        EXPECT_NEAR(down, droop.down, 1e-6);
    }
}

TEST(Known, ElasticaUnderItsWeightHasThePublishedDigits) {
    for (const Digits& d : {Digits{1, 0.12347, 0.00875, 0}, Digits{5, 0.49591, 0.15334, 0},
                            Digits{20, 0.82988, 0.55477, 0}, Digits{50, 0.90792, 0.75499, 0}}) {
        const Droop droop = droop_of(0, d.load);
        EXPECT_NEAR(droop.down, d.down, 6e-6);
        EXPECT_NEAR(1 - droop.along, d.short_by, 6e-6);
    }
}

TEST(Known, SmallLoadsBendAsTheLinearFormulaSays) {
    EXPECT_NEAR(droop_of(1e-3, 0).down / small_droop(1e-3, 0), 1, 1e-6);
    EXPECT_NEAR(droop_of(0, 1e-3).down / small_droop(0, 1e-3), 1, 1e-6);
    EXPECT_NEAR(droop_of(1e-3, 2e-3).down / small_droop(1e-3, 2e-3), 1, 1e-6);
}

TEST(Known, AMomentRollsUpToACircle) {
    EXPECT_NEAR(arc_of(2 * M_PI).down, 0, 1e-15);
    EXPECT_NEAR(arc_of(2 * M_PI).along, 0, 1e-15);
    EXPECT_NEAR(arc_of(M_PI).down, 2 / M_PI, 1e-15);
    EXPECT_NEAR(arc_of(1e-6).down, 0.5e-6, 1e-12);
    EXPECT_EQ(arc_of(0).along, 1);
}

TEST(Known, FrequenciesHaveThePublishedDigits) {
    EXPECT_NEAR(wave_number(0), 1.87510, 6e-6);
    EXPECT_NEAR(wave_number(1), 4.69409, 6e-6);
    EXPECT_NEAR(wave_number(2), 7.85476, 6e-6);
    EXPECT_NEAR(wave_number(0, 0.1), 1.72274, 6e-6);
    EXPECT_NEAR(wave_number(0, 1), 1.24792, 6e-6);
    EXPECT_NEAR(wave_number(0, 10), 0.73578, 6e-6);
    EXPECT_NEAR(frequency(0, 2, 8, 3), std::pow(1.87510, 2) / (2 * M_PI * 9) * 0.5, 1e-6);
}

// The Rayleigh quotient of the mode shapes, by finite differences, reproduces the wave numbers.
TEST(Known, ModeShapesBelongToTheirFrequencies) {
    for (int mode = 0; mode < 3; mode++) {
        EXPECT_NEAR(mode_shape(mode, 0), 0, 1e-9);
        EXPECT_NEAR(mode_shape(mode, 1), 1, 1e-12);
        const int n = 4000;
        const double h = 1.0 / n;
        double bent = 0, moved = 0;
        for (int i = 0; i < n; i++) {
            const double s = (i + 0.5) * h;
            const double w = mode_shape(mode, s);
            const double curvature = (mode_shape(mode, s + 1e-4) - 2 * w + mode_shape(mode, s - 1e-4)) / 1e-8;
            bent += curvature * curvature * h;
            moved += w * w * h;
        }
        EXPECT_NEAR(std::sqrt(std::sqrt(bent / moved)), wave_number(mode), 1e-3);
    }
}

TEST(Known, SwayStartsWhereItWasLetGoAndReturns) {
    for (double end_mass : {0.0, 0.01, 1.0}) {
        const Sway sway(end_mass);
        EXPECT_NEAR(sway.at(0), 1, 2e-4) << end_mass;
        // At rest at the start: symmetric in time; nearly back after one period.
        EXPECT_DOUBLE_EQ(sway.at(0.01), sway.at(-0.01));
        const double period = 2 * M_PI / std::pow(wave_number(0, end_mass), 2);
        EXPECT_NEAR(sway.at(period), 1, 0.07) << end_mass;
    }
    EXPECT_NEAR(
        Sway().at(0.3),
        [] {
            double sum = 0;
            for (int mode = 0; mode < 6; mode++)
                sum += 12 / std::pow(wave_number(mode), 4) * std::cos(std::pow(wave_number(mode), 2) * 0.3);
            return sum;
        }(),
        1e-5);
}

// The column's equation has the power series 1 - w/6 + w^2/180 ..., whose first zero is the buckling weight.
TEST(Known, GreenhillsNumberIsTheZeroOfItsSeries) {
    const double w = greenhill_number();
    EXPECT_NEAR(w, 7.83735, 6e-6);
    double term = 1, sum = 1;
    for (int k = 1; k < 40; k++) {
        term *= -w / (3.0 * k * (3.0 * k - 1));
        sum += term;
    }
    EXPECT_NEAR(sum, 0, 1e-8);
    EXPECT_LT(greenhill_number(0.1), w);
}

// Solves Prandtl's stress function of the unit square by successive over-relaxation.
TEST(Known, TorsionOfTheSquareMeetsAFiniteDifferenceSolution) {
    const int n = 64;
    const double h = 1.0 / n;
    std::vector<double> stress(size_t((n + 1) * (n + 1)), 0);
    const auto at = [&](int i, int j) -> double& { return stress[size_t(i * (n + 1) + j)]; };
    for (int sweep = 0; sweep < 600; sweep++)
        for (int i = 1; i < n; i++)
            for (int j = 1; j < n; j++) {
                const double wanted = 0.25 * (at(i - 1, j) + at(i + 1, j) + at(i, j - 1) + at(i, j + 1) + 2 * h * h);
                at(i, j) += 1.9 * (wanted - at(i, j));
            }
    double sum = 0;
    for (double value : stress) sum += value;
    EXPECT_NEAR(2 * sum * h * h, torsion_of_square(), 2e-4);  // of order h^2
    EXPECT_NEAR(torsion_of_square(), 0.1406, 5e-5);
}

// Implicit Euler on x'' = -x, whose amplification factor is 1 / (1 - i z).
TEST(Known, ImplicitEulerDampsAsItsFormulaSays) {
    const double z = 2 * M_PI / 60;
    double x = 1, v = 0;
    const int steps = 300;
    for (int i = 0; i < steps; i++) {
        v = (v - z * x) / (1 + z * z);
        x += z * v;
    }
    const double zeta = implicit_euler_damping(z), kept = std::sqrt(x * x + v * v);
    EXPECT_NEAR(std::log(kept), -steps * zeta * std::atan(z), 1e-9);
    EXPECT_NEAR(zeta, 0.0521, 5e-4);
}

// The curve of Gosselin, de Langre, Machado-Almeida 2010; if bent far, drag grows as speed^(4/3).
TEST(Known, ReconfigurationHasThePublishedDigits) {
    const struct {
        double C, R;
    } digits[] = {{1, 0.9748},   {3.162, 0.8311}, {10, 0.5236}, {31.62, 0.3011},
                  {100, 0.1918}, {1000, 0.0890},  {1e4, 0.0413}};
    for (const auto& d : digits) EXPECT_NEAR(reconfiguration_of(d.C), d.R, 6e-5) << d.C;
    EXPECT_NEAR(reconfiguration_of(1e-4), 1, 1e-6);
    const double vogel = 2 * std::log(reconfiguration_of(1e5) / reconfiguration_of(1e4)) / std::log(10.0);
    EXPECT_NEAR(vogel, -2.0 / 3, 0.01);
}

}  // namespace known_tests
