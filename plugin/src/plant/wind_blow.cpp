// In: a wind, points and a time. Out: the velocity of the air there: mean, gusts carried along with it (Taylor 1938), and
// what the host's own field makes of them.
#include <algorithm>
#include <cmath>

#include "plant/wind.hpp"

namespace frond {

namespace {

// cos 2 pi x within 6e-8, without a branch and the same on every machine: the compiler does several at a time.
inline double cosine_of_turns(double x) {
    constexpr double ROUND = 6755399441055744.0;  // 1.5 2^52: adding it leaves no digits behind the point
    const double r = x - ((x + ROUND) - ROUND);
    const double q = 2 * M_PI * (0.25 - std::abs(r)), s = q * q;
    return q * (1 + s * (-1.0 / 6 + s * (1.0 / 120 + s * (-1.0 / 5040 + s * (1.0 / 362880 - s / 39916800)))));
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

void add_gusts(const Wind& wind, const Mat3& frame, const std::vector<frond_vec3>& points,
               std::vector<frond_vec3>& out) {
    // By blocks that stay in registers and cache.
    constexpr size_t BLOCK = 32;
    double place[3][BLOCK], sum[3][BLOCK];
    for (size_t begin = 0; begin < points.size(); begin += BLOCK) {
        const size_t count = std::min(BLOCK, points.size() - begin);
        for (size_t i = 0; i < BLOCK; i++) {
            const frond_vec3& p = points[begin + std::min(i, count - 1)];
            for (int c = 0; c < 3; c++) {
                place[c][i] = frame(c, 0) * p.x + frame(c, 1) * p.y + frame(c, 2) * p.z;
                sum[c][i] = 0;
            }
        }
        for (size_t c = 0; c < 3; c++)
            for (const Gust& gust : wind.gusts[c]) {
                const double now = gust.waves[0] * wind.travelled + gust.phase;
                const double along = gust.waves[0], across = gust.waves[1], above = gust.waves[2], size = gust.size;
                for (size_t i = 0; i < BLOCK; i++)
                    sum[c][i] += size * cosine_of_turns(now - along * place[0][i] - across * place[1][i] -
                                                        above * place[2][i]);
            }
        for (size_t i = 0; i < count; i++) {
            frond_vec3& v = out[begin + i];
            const Vec3 gust = frame.transpose() * Vec3(sum[0][i], sum[1][i], sum[2][i]);
            v = {v.x + gust.x(), v.y + gust.y(), v.z + gust.z()};
        }
    }
}

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
        if (!wind.gusts[0].empty()) add_gusts(wind, wind_frame(mean, up), points, out);
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
