// Geometry: vectors, colours and the random generator of the growing rules. Plain arithmetic, so that results do not
// depend on a library's version.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace frond::grow {

constexpr double PI = 3.14159265358979323846;
constexpr double TURN = 2 * PI;

struct Vec {
    double x = 0, y = 0, z = 0;
};
inline Vec operator+(Vec a, Vec b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec operator-(Vec a, Vec b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec operator*(double s, Vec a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline double dot(Vec a, Vec b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec cross(Vec a, Vec b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec a) {
    return std::sqrt(dot(a, a));
}
inline Vec unit(Vec a) {
    const double n = length(a);
    return n > 0 ? (1 / n) * a : Vec{0, 1, 0};
}
// Returns `a` turned about the unit axis (Rodrigues).
inline Vec turned(Vec a, Vec axis, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return c * a + s * cross(axis, a) + ((1 - c) * dot(axis, a)) * axis;
}
// Returns the horizontal direction at an azimuth.
inline Vec heading(double azimuth) {
    return {std::cos(azimuth), 0, std::sin(azimuth)};
}

struct Rgb {
    double r = 0, g = 0, b = 0;
};
inline double mix(double a, double b, double t) {
    return a + (b - a) * t;
}
inline Vec mix(Vec a, Vec b, double t) {
    return a + t * (b - a);
}
inline Rgb mix(Rgb a, Rgb b, double t) {
    return {mix(a.r, b.r, t), mix(a.g, b.g, t), mix(a.b, b.b, t)};
}
inline Rgb scaled(Rgb a, double s) {
    return {a.r * s, a.g * s, a.b * s};
}
inline double clamp01(double t) {
    return std::min(1.0, std::max(0.0, t));
}
// Returns 0 below a, 1 above b, and a smooth value in between.
inline double smooth_step(double a, double b, double t) {
    const double s = clamp01((t - a) / (b - a));
    return s * s * (3 - 2 * s);
}

// SplitMix64 (Steele, Lea, Flood 2014).
struct Random {
    uint64_t state;
    explicit Random(uint64_t seed) : state(seed * 0x9E3779B97F4A7C15ull + 0x1234567ull) {}
    uint64_t bits() {
        uint64_t z = (state += 0x9E3779B97F4A7C15ull);
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
        return z ^ (z >> 31);
    }
    double unit() { return static_cast<double>(bits() >> 11) * (1.0 / 9007199254740992.0); }
    double range(double low, double high) { return low + (high - low) * unit(); }
    // Returns a number between -s and s.
    double spread(double s) { return range(-s, s); }
};

}  // namespace frond::grow
