// In: a wind, points and a time. Out: the velocity of the air there: mean, gusts carried along with it (Taylor 1938), and
// what the host's own field makes of them.
#include <algorithm>
#include <cmath>

#include "core/lanes.hpp"
#include "plant/wind.hpp"

namespace frond {

namespace {

// cos 2 pi x within 6e-8.
template <class S>
FROND_INLINE S cosine_of_turns(const S& x) {
    const S r = x - whole<S>(x), size = select(r < 0.0, S(-r), r);
    const S q = 2 * M_PI * (0.25 - size), s = q * q;
    return q * (1.0 + s * (-1.0 / 6 + s * (1.0 / 120 + s * (-1.0 / 5040 + s * (1.0 / 362880 - s * (1.0 / 39916800))))));
}

// Mean wind and gusts at a height over those at the reference height [-].
double profile_at(const frond_wind_def& def, double height) {
    if (def.profile == FROND_WIND_UNIFORM) return 1;
    if (def.profile == FROND_WIND_POWER)
        return height > 0 ? std::pow(height / def.reference_height, def.exponent) : 0;
    return height > def.roughness ? std::log(height / def.roughness) / std::log(def.reference_height / def.roughness)
                                  : 0;
}

// Along, across and above the mean wind, as rows.
Mat3 wind_frame(const Vec3& mean, const Vec3& up) {
    Mat3 frame;
    const Vec3 along = mean.normalized(), across = up.cross(along);
    frame.row(0) = along;
    frame.row(1) = across.norm() > 1e-6 ? across.normalized() : along.unitOrthogonal();
    frame.row(2) = along.cross(Vec3(frame.row(1)));
    return frame;
}

struct AddGusts {
    const Wind& wind;
    const Mat3& frame;
    const std::vector<frond_vec3>& points;
    std::vector<frond_vec3>& out;

    static constexpr int BLOCK = 16;  // points that stay in registers and cache
    template <class S>
    FROND_INLINE static void add(const Gust& gust, double travelled, int groups, const S (&along)[BLOCK / LANES<S>],
                                 const S (&across)[BLOCK / LANES<S>], const S (&above)[BLOCK / LANES<S>],
                                 S (&sum)[BLOCK / LANES<S>]) {
        const S now = constant<S>(gust.waves[0] * travelled + gust.phase);
        for (int i = 0; i < groups; i++)
            sum[i] += gust.size * cosine_of_turns<S>(now - gust.waves[0] * along[i] - gust.waves[1] * across[i] -
                                                     gust.waves[2] * above[i]);
    }
    template <class S>
    FROND_INLINE void run() const {
        constexpr int MANY = BLOCK / LANES<S>;
        for (size_t begin = 0; begin < points.size(); begin += BLOCK) {
            const int count = int(std::min(size_t(BLOCK), points.size() - begin));
            S place[3][MANY], sum[3][MANY] = {};
            for (int i = 0; i < BLOCK; i++) {
                const frond_vec3& p = points[begin + size_t(std::min(i, count - 1))];
                for (int c = 0; c < 3; c++)
                    place[c][i / LANES<S>][i % LANES<S>] = frame(c, 0) * p.x + frame(c, 1) * p.y + frame(c, 2) * p.z;
            }
            for (size_t c = 0; c < 3; c++)
                for (const Gust& gust : wind.gusts[c])
                    add<S>(gust, wind.travelled, (count + LANES<S> - 1) / LANES<S>, place[0], place[1], place[2], sum[c]);
            for (int i = 0; i < count; i++) {
                const auto at = [&](int c) { return sum[c][i / LANES<S>][i % LANES<S>]; };
                frond_vec3& v = out[begin + size_t(i)];
                const Vec3 gust = frame.transpose() * Vec3(at(0), at(1), at(2));
                v = {v.x + gust.x(), v.y + gust.y(), v.z + gust.z()};
            }
        }
    }
};

// Takes out what no wind can be.
bool sort_out(std::vector<frond_vec3>& velocities) {
    constexpr double FASTEST = 1000;  // [m/s]
    bool sound = true;
    for (frond_vec3& v : velocities) {
        if (v.x * v.x + v.y * v.y + v.z * v.z <= FASTEST * FASTEST) continue;
        v = {0, 0, 0};
        sound = false;
    }
    return sound;
}

}  // namespace

void pass_time(Wind& wind, double h) {
    const frond_vec3& mean = wind.def.velocity;
    wind.travelled += h * Vec3(mean.x, mean.y, mean.z).norm();
}

Vec3 up_of(const Vec3& gravity) {
    return gravity.squaredNorm() > 0 ? Vec3(-gravity.normalized()) : Vec3(Vec3::UnitY());
}

bool wind_velocities(const Wind& wind, const Vec3& up, double time, const std::vector<frond_vec3>& points,
                     std::vector<frond_vec3>& out) {
    const frond_wind_def& def = wind.def;
    const Vec3 mean(def.velocity.x, def.velocity.y, def.velocity.z);
    out.assign(points.size(), def.velocity);
    if (!mean.isZero(0)) {
        if (!wind.gusts[0].empty()) {
            const Mat3 frame = wind_frame(mean, up);
            run_in_lanes(AddGusts{wind, frame, points, out});
        }
        for (size_t i = 0; i < points.size(); i++) {
            const double height = up.dot(Vec3(points[i].x, points[i].y, points[i].z)) - def.ground_height;
            const double share = profile_at(def, height);
            out[i] = {share * out[i].x, share * out[i].y, share * out[i].z};
        }
    }
    if (!wind.field) return true;
    std::lock_guard<std::mutex> lock(wind.field_mutex);
    wind.field(points.data(), int(points.size()), time, out.data(), wind.user);
    return sort_out(out);
}

}  // namespace frond
