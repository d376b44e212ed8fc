// In: a wind, points and a time. Out: the velocity of the air there, as changed by the host's own field.
#include <algorithm>

#include "plant/wind_lanes.hpp"

namespace frond {

namespace {

struct BlowAt {
    const WindNow& now;
    const std::vector<frond_vec3>& points;
    std::vector<frond_vec3>& out;
    template <class S>
    FROND_INLINE void run() const {
        constexpr int MOST = 4;  // groups whose numbers stay in registers and cache
        for (size_t begin = 0; begin < points.size(); begin += size_t(MOST * LANES<S>)) {
            const int count = int(std::min(size_t(MOST * LANES<S>), points.size() - begin));
            const int groups = (count + LANES<S> - 1) / LANES<S>;
            Lanes3<S> places[MOST], air[MOST];
            for (int i = 0; i < groups; i++) {
                const auto point = [&](int lane) -> const frond_vec3& {
                    return points[begin + size_t(std::min(i * LANES<S> + lane, count - 1))];
                };
                places[i] = {gather<S>([&](int l) { return point(l).x; }), gather<S>([&](int l) { return point(l).y; }),
                             gather<S>([&](int l) { return point(l).z; })};
            }
            wind_at(now, places, groups, air);
            for (int i = 0; i < count; i++) {
                const Lanes3<S>& of = air[i / LANES<S>];
                const int lane = i % LANES<S>;
                out[begin + size_t(i)] = {of.x[lane], of.y[lane], of.z[lane]};
            }
        }
    }
};

// Sets velocities that no wind can have to zero; false if there were any.
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

bool blow_by_field(const Wind& wind, double time, const std::vector<frond_vec3>& points,
                   std::vector<frond_vec3>& velocities) {
    std::lock_guard<std::mutex> lock(wind.field_mutex);
    wind.field(points.data(), int(points.size()), time, velocities.data(), wind.user);
    return sort_out(velocities);
}

WindNow wind_now(const Wind& wind, const Vec3& up) {
    const Vec3 mean(wind.def.velocity.x, wind.def.velocity.y, wind.def.velocity.z);
    WindNow now = {wind, Mat3::Identity(), up, !mean.isZero(0)};
    if (!now.blows) return now;
    const Vec3 along = mean.normalized(), across = up.cross(along);
    now.frame.row(0) = along;
    now.frame.row(1) = across.norm() > 1e-6 ? across.normalized() : along.unitOrthogonal();
    now.frame.row(2) = along.cross(Vec3(now.frame.row(1)));
    return now;
}

static void shift_gusts(Wind& wind, const Vec3& up, const Vec3& origin) {
    wind.origin += origin;
    const Vec3 moved = wind_now(wind, up).frame * origin;
    for (std::vector<Gust>& gusts : wind.gusts)
        for (Gust& gust : gusts) gust.phase -= gust.waves.dot(moved);
}

void shift_origin(Wind& wind, const Vec3& up, const Vec3& origin) {
    shift_gusts(wind, up, origin);
    wind.def.ground_height -= up.dot(origin);
}

void take_over(Wind& wind, const Vec3& up, const Wind& before) {
    wind.travelled = before.travelled;
    wind.field = before.field;
    wind.user = before.user;
    shift_gusts(wind, up, before.origin);
}

bool wind_velocities(const Wind& wind, const Vec3& up, double time, const std::vector<frond_vec3>& points,
                     std::vector<frond_vec3>& out) {
    out.resize(points.size());
    run_in_lanes(BlowAt{wind_now(wind, up), points, out});
    return !wind.field || blow_by_field(wind, time, points, out);
}

}  // namespace frond
