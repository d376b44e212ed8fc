// In: a mean wind, its turbulence and a seed. Out: the waves whose sum its gusts are.
//
// Spectra after Kaimal et al. 1972 and coherence as in IEC 61400-1 (2005), annex B:
//   f S(f) / sigma^2 = 4 n / (1 + 6 n)^(5/3), n = f L / U, for each component, and between two points r apart
//   exp(-12 r sqrt((f / U)^2 + (0.12 / L)^2)), L that of the component along the wind.
// The energy below n is 1 - (1 + 6 n)^(-2/3). Each wave has the energy of its own band of frequencies, so that all of
// them together have sigma^2 and every band has its share of the spectrum, for any seed. Wave vectors across the wind
// are drawn from Cauchy's distribution in the plane, whose characteristic function is the exponential of the coherence
// (sums of waves: Shinozuka, Deodatis 1991).
#include <cmath>

#include "core/elementary.hpp"
#include "plant/wind.hpp"

namespace frond {

namespace {

// Random numbers from a counter: splitmix64 (Steele, Lea, Flood 2014). The same on every machine.
struct Numbers {
    uint64_t state;
    double next() {  // 0 .. 1
        uint64_t z = state += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }
};

struct Component {
    int count;      // number of waves
    double size;    // standard deviation over that along the wind [-]
    double length;  // length scale over that along the wind [-]
};
constexpr Component COMPONENTS[3] = {{20, 1, 1}, {12, 0.8, 2.7 / 8.1}, {10, 0.5, 0.66 / 8.1}};

double energy_below(double n) {
    return 1 - frond::pow(1 + 6 * n, -2.0 / 3);
}
double frequency_of_energy(double energy) {
    return (frond::pow(1 - energy, -1.5) - 1) / 6;
}

// Returns the spread of wave vectors across the wind, from the coherence [1/m].
double spread_of(double along, double length) {
    return 12 / (2 * PI) * frond::hypot(along, 0.12 / length);
}

}  // namespace

std::unique_ptr<Wind> make_wind(const frond_wind_def& def) {
    auto wind = std::make_unique<Wind>();
    wind->def = def;
    const double speed = Vec3(def.velocity.x, def.velocity.y, def.velocity.z).norm();
    if (!(speed > 0) || !(def.turbulence > 0)) return wind;
    constexpr double LEAST = 0.01, MOST = 20;  // range of n in which the bands are even in its logarithm
    constexpr double FARTHEST = 0.97;          // share of Cauchy's distribution that is drawn from
    Numbers numbers = {def.seed};
    for (size_t c = 0; c < 3; c++) {
        const Component& component = COMPONENTS[c];
        const double length = def.length_scale * component.length, sigma = def.turbulence * speed * component.size;
        double below = 0;
        for (int i = 0; i < component.count; i++) {
            const bool last = i + 1 == component.count;
            const double end = LEAST * frond::pow(MOST / LEAST, double(i) / (component.count - 2));
            const double above = last ? 1 : energy_below(end);
            // The last band has no upper end: its wave is drawn from the slower half of its energy.
            const double energy = below + (above - below) * numbers.next() * (last ? 0.5 : 1);
            Gust gust;
            const double along = frequency_of_energy(energy) / length;
            gust.size = sigma * std::sqrt(2 * (above - below));
            const double share = 1 - FARTHEST * numbers.next(), angle = 2 * PI * numbers.next();
            const double across = spread_of(along, def.length_scale) * std::sqrt(1 / (share * share) - 1);
            gust.waves = Vec3(along, across * frond::cos(angle), across * frond::sin(angle));
            gust.phase = numbers.next();
            wind->gusts[c].push_back(gust);
            below = above;
        }
    }
    return wind;
}

}  // namespace frond
