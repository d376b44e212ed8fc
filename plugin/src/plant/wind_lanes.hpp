// The velocity of the air in many places at once: mean and gusts carried along with it (Taylor 1938). What the host's
// own field makes of them comes after that.
#pragma once

#include <cmath>

#include "core/lane_functions.hpp"
#include "plant/wind.hpp"

namespace frond {

// What of a wind is the same everywhere.
struct WindNow {
    const Wind& wind;
    Mat3 frame;  // along, across and above the mean wind, as rows
    Vec3 up;
    bool blows;  // at all
};
WindNow wind_now(const Wind& wind, const Vec3& up);
// What the host's own field makes of velocities at points. False if it gave some that cannot be; they are zero then.
bool blow_by_field(const Wind& wind, double time, const std::vector<frond_vec3>& points,
                   std::vector<frond_vec3>& velocities);

// cos 2 pi x within 6e-8.
template <class S>
FROND_INLINE S cosine_of_turns(const S& x) {
    const S r = x - whole<S>(x), size = select(r < 0.0, S(-r), r);
    const S q = 2 * M_PI * (0.25 - size), s = q * q;
    return q * (1.0 + s * (-1.0 / 6 + s * (1.0 / 120 + s * (-1.0 / 5040 + s * (1.0 / 362880 - s * (1.0 / 39916800))))));
}

// Mean wind and gusts at heights over those at the reference height [-].
template <class S>
FROND_INLINE S wind_profile(const frond_wind_def& def, const S& height) {
    if (def.profile == FROND_WIND_UNIFORM) return constant<S>(1);
    if (def.profile == FROND_WIND_POWER)
        return gather<S>([&](int lane) {
            return height[lane] > 0 ? std::pow(height[lane] / def.reference_height, def.exponent) : 0;
        });
    const auto is_above = height > def.roughness;
    const S over = select(is_above, S(height / def.roughness), constant<S>(1));
    return logarithm(over) / logarithm(constant<S>(def.reference_height / def.roughness));
}

// Velocities [m/s] at so many groups of places [m].
template <int MOST, class S>
FROND_INLINE void wind_at(const WindNow& now, const Lanes3<S> (&places)[MOST], int groups, Lanes3<S> (&out)[MOST]) {
    const frond_wind_def& def = now.wind.def;
    const Lanes3<S> mean = {constant<S>(def.velocity.x), constant<S>(def.velocity.y), constant<S>(def.velocity.z)};
    for (int i = 0; i < groups; i++) out[i] = mean;
    if (!now.blows) return;
    Lanes33<S> frame;
    for (int r = 0; r < 3; r++)
        frame.r[r] = {constant<S>(now.frame(r, 0)), constant<S>(now.frame(r, 1)), constant<S>(now.frame(r, 2))};
    Lanes3<S> along[MOST];
    S sums[3][MOST] = {};
    for (int i = 0; i < groups; i++) along[i] = frame * places[i];
    for (size_t c = 0; c < 3; c++)
        for (const Gust& gust : now.wind.gusts[c]) {
            const S begin = constant<S>(gust.waves[0] * now.wind.travelled + gust.phase);
            for (int i = 0; i < groups; i++)
                sums[c][i] += gust.size * cosine_of_turns<S>(begin - gust.waves[0] * along[i].x -
                                                             gust.waves[1] * along[i].y - gust.waves[2] * along[i].z);
        }
    const Lanes3<S> up = {constant<S>(now.up[0]), constant<S>(now.up[1]), constant<S>(now.up[2])};
    for (int i = 0; i < groups; i++) {
        const Lanes3<S> gust = {sums[0][i], sums[1][i], sums[2][i]};
        const S share = wind_profile<S>(def, dot(up, places[i]) - def.ground_height);
        out[i] = share * (mean + transposed_times(frame, gust));
    }
}

}  // namespace frond
