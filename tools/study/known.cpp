#include "study/known.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace frond::study {
namespace {

constexpr int STEPS = 2000;  // steps of the Runge-Kutta method over the beam's length

// Returns the zero of f between low and high, where its sign changes.
double bisect(double low, double high, const std::function<double(double)>& f) {
    const bool rises = f(low) < 0;
    for (int i = 0; i < 200 && high - low > 1e-15 * (std::abs(low) + std::abs(high)); i++) {
        const double middle = 0.5 * (low + high);
        ((f(middle) < 0) == rises ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

// Angle of the tangent, its derivative, and the position reached.
struct Tangent {
    double angle, rate, along, down;
};
Tangent operator+(const Tangent& a, const Tangent& b) {
    return {a.angle + b.angle, a.rate + b.rate, a.along + b.along, a.down + b.down};
}
Tangent operator*(double s, const Tangent& a) {
    return {s * a.angle, s * a.rate, s * a.along, s * a.down};
}

// Integrates angle'' = bend(s, angle) from the clamp to the end.
Tangent march(double rate, const std::function<double(double, double)>& bend) {
    const auto slope = [&](double s, const Tangent& t) {
        return Tangent{t.rate, bend(s, t.angle), std::cos(t.angle), std::sin(t.angle)};
    };
    const double h = 1.0 / STEPS;
    Tangent t = {0, rate, 0, 0};
    for (int i = 0; i < STEPS; i++) {
        const double s = i * h;
        const Tangent k1 = slope(s, t), k2 = slope(s + h / 2, t + h / 2 * k1), k3 = slope(s + h / 2, t + h / 2 * k2),
                      k4 = slope(s + h, t + h * k3);
        t = t + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return t;
}

}  // namespace

Droop droop_of(double a, double k) {
    const auto bend = [=](double s, double angle) { return -(a + k * (1 - s)) * std::cos(angle); };
    // The moment vanishes at the end. Of the curvatures at the clamp that satisfy this, all below that of the straight
    // beam, the largest belongs to a hanging beam; the others stand up in coils.
    const auto end_rate = [&](double rate) { return march(rate, bend).rate; };
    const double most = std::min(a + k / 2, std::sqrt(2 * (a + k))) + 1e-9;
    constexpr int SLICES = 64;
    int slice = SLICES;
    while (slice > 1 && end_rate(most * (slice - 1) / SLICES) > 0) slice--;
    const double rate = bisect(most * (slice - 1) / SLICES, most * slice / SLICES, end_rate);
    const Tangent end = march(rate, bend);
    return {end.down, end.along, end.angle};
}

double small_droop(double a, double k) {
    return a / 3 + k / 8;
}

Droop arc_of(double m) {
    if (std::abs(m) < 1e-12) return {m / 2, 1, m};
    return {2 * std::pow(std::sin(m / 2), 2) / m, std::sin(m) / m, m};
}

double torsion_of_square() {
    double sum = 0;
    for (int n = 1; n < 200; n += 2) sum += std::tanh(n * M_PI / 2) / std::pow(n, 5);
    return 1.0 / 3 - 64 / std::pow(M_PI, 5) * sum;
}

double wave_number(int mode, double end_mass) {
    // Divided by cosh, so that high modes stay finite.
    const auto f = [=](double x) {
        const double c = std::cos(x), s = std::sin(x), t = std::tanh(x);
        return 1 / std::cosh(x) + c + end_mass * x * (c * t - s);
    };
    return bisect(mode * M_PI + 1e-6, (mode + 1) * M_PI, f);
}

double frequency(int mode, double EI, double mass_per_length, double length, double end_mass) {
    const double b = wave_number(mode, end_mass);
    return b * b / (2 * M_PI * length * length) * std::sqrt(EI / mass_per_length);
}

double mode_shape(int mode, double s, double end_mass) {
    const double b = wave_number(mode, end_mass);
    const double share = (std::cos(b) + std::cosh(b)) / (std::sin(b) + std::sinh(b));
    const auto shape = [=](double x) { return std::cosh(x) - std::cos(x) - share * (std::sinh(x) - std::sin(x)); };
    return shape(b * s) / shape(b);
}

Sway::Sway(double end_mass) {
    constexpr int SLICES = 400;
    for (int mode = 0; mode < MODES; mode++) {
        const double b = wave_number(mode, end_mass);
        double mass = end_mass;
        for (int i = 0; i < SLICES; i++) mass += std::pow(mode_shape(mode, (i + 0.5) / SLICES, end_mass), 2) / SLICES;
        rate[mode] = b * b;
        share[mode] = 3 / (std::pow(b, 4) * mass);
    }
}

double Sway::at(double time) const {
    double sum = 0;
    for (int mode = 0; mode < MODES; mode++) sum += share[mode] * std::cos(rate[mode] * time);
    return sum;
}

double greenhill_number(double end_weight) {
    // The smallest weight for which a slightly tilted column has no moment at its end.
    return bisect(0.1, 8, [=](double w) {
        return march(1, [=](double s, double angle) { return -w * (1 - s + end_weight) * angle; }).rate;
    });
}

double reconfiguration_of(double C) {
    // From the free end down: angle from upright, its derivative, and the force of all above, along the wind and
    // upwards.
    using State = std::array<double, 4>;
    const auto slope = [=](const State& y) -> State {
        const double across = std::cos(y[0]), along = std::sin(y[0]), load = C * across * std::abs(across);
        return {-y[1], y[2] * across - y[3] * along, load * across, -load * along};
    };
    const auto to_foot = [&](double angle) {
        const double h = 1.0 / STEPS;
        const auto at = [](const State& y, double s, const State& k) {
            State out;
            for (size_t i = 0; i < 4; i++) out[i] = y[i] + s * k[i];
            return out;
        };
        State y = {angle, 0, 0, 0};
        for (int i = 0; i < STEPS; i++) {
            const State k1 = slope(y), k2 = slope(at(y, h / 2, k1)), k3 = slope(at(y, h / 2, k2)),
                        k4 = slope(at(y, h, k3));
            for (size_t n = 0; n < 4; n++) y[n] += h / 6 * (k1[n] + 2 * k2[n] + 2 * k3[n] + k4[n]);
        }
        return y;
    };
    // Strong flow has other, curled solutions too; the observed one ends nearest to the direction of the flow.
    const auto at_foot = [&](double end) { return to_foot(end)[0]; };
    double off = 1e-9, before = 0;
    while (off < M_PI / 2 && at_foot(M_PI / 2 - off) > 0) {
        before = off;
        off *= 1.2;
    }
    const double angle = bisect(M_PI / 2 - std::min(off, M_PI / 2), M_PI / 2 - before, at_foot);
    return to_foot(angle)[2] / C;
}

double implicit_euler_damping(double z) {
    return std::log(1 + z * z) / (2 * std::atan(z));
}

}  // namespace frond::study
