// Velocity of the air at many points at once: mean wind and gusts carried along with it (Taylor 1938). The host's own
// field is applied after that.
#pragma once

#include "core/lane_functions.hpp"
#include "core/lane_vectors.hpp"
#include "plant/wind.hpp"

namespace frond {

// Values of a wind that are the same everywhere.
struct WindNow {
    const Wind& wind;
    Mat3 frame;  // along, across and above the mean wind, as rows
    Vec3 up;
    bool blows;  // there is a mean wind
};
WindNow wind_now(const Wind& wind, const Vec3& up);
// Applies the host's own field to velocities at points. False if it gave impossible ones; they are zero then.
bool blow_by_field(const Wind& wind, double time, const std::vector<frond_vec3>& points,
                   std::vector<frond_vec3>& velocities);

// Returns cos 2 pi x within 4e-9.
template <class S>
FROND_INLINE S cosine_of_turns(const S& x) {
    // sin(2 pi y) / y in powers of y^2, for y up to a quarter: the odd polynomial of least error (Remez).
    constexpr double SINE[] = {6.2831851600897226565, -41.341655031479418784, 81.601004077356553391,
                               -76.549782387613466232, 39.536706762014835694};
    const S y = 0.25 - magnitude(S(x - whole<S>(x)));
    return y * polynomial(SINE, S(y * y));
}

constexpr double LOWEST = 1e-100;  // with wind [m]
// Returns mean wind and gusts at heights over those at the reference height [-].
template <class S>
FROND_INLINE S wind_profile(const frond_wind_def& def, const S& height) {
    if (def.profile == FROND_WIND_PROFILE_UNIFORM) return constant<S>(1);
    if (def.profile == FROND_WIND_PROFILE_POWER) {
        const auto is_above = height > LOWEST;
        const S over = select(is_above, S(height / def.reference_height), constant<S>(1));
        return select(is_above, exponential<S>(def.exponent * logarithm(over)), S{});
    }
    const auto is_above = height > def.roughness;
    const S over = select(is_above, S(height / def.roughness), constant<S>(1));
    return logarithm(over) / logarithm(constant<S>(def.reference_height / def.roughness));
}

// Finds velocities [m/s] in groups of places [m].
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
