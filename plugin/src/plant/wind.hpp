// Wind: how the air of a world moves, as a function of place, time and a seed.
#pragma once

#include <memory>
#include <mutex>

#include "core/types.hpp"
#include "frond/frond.h"

namespace frond {

// A wave of one component of the gusts, carried along by the mean wind: size cos 2 pi (waves . (travelled - place) +
// phase).
struct Gust {
    double size;   // at the reference height [m/s]
    Vec3 waves;    // along, across and above the mean wind [1/m]
    double phase;  // [-]
};

struct Wind {
    frond_wind_def def;
    std::array<std::vector<Gust>, 3> gusts;  // of the velocity along, across and above the mean wind
    double travelled = 0;                    // way of the mean wind so far, along itself [m]
    Vec3 origin = Vec3::Zero();              // of the world in that in which the gusts were made [m]
    frond_wind_field_fn* field = nullptr;    // the host's own
    mutable std::mutex field_mutex;          // it is asked from one thread at a time
    void* user = nullptr;
};

// `def` has been checked by the caller.
std::unique_ptr<Wind> make_wind(const frond_wind_def& def);
// The world's origin moves to this place of it: gusts and ground stay where they are.
void shift_origin(Wind& wind, const Vec3& up, const Vec3& origin);
// Has the gusts of a new wind go on where those of the one before are.
void take_over(Wind& wind, const Vec3& up, const Wind& before);
// The mean wind goes on for h [s].
void pass_time(Wind& wind, double h);
// Velocities at points [m/s], world frame; `up` is against gravity, length one. False if the host's field gave some
// that cannot be; they are zero then.
bool wind_velocities(const Wind& wind, const Vec3& up, double time, const std::vector<frond_vec3>& points,
                     std::vector<frond_vec3>& out);
// Against gravity; y where there is none.
Vec3 up_of(const Vec3& gravity);

}  // namespace frond
