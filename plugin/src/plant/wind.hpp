// Wind: the motion of a world's air as a function of place, time and a seed.
#pragma once

#include <memory>
#include <mutex>

#include "core/types.hpp"
#include "frond/frond.h"

namespace frond {

// A wave of one component of the gusts, carried along by the mean wind: size cos 2 pi (waves . (travelled - place) +
// phase).
struct Gust {
    double size;   // amplitude at the reference height [m/s]
    Vec3 waves;    // wave vector along, across and above the mean wind [1/m]
    double phase;  // [-]
};

struct Wind {
    frond_wind_def def;
    std::array<std::vector<Gust>, 3> gusts;  // components along, across and above the mean wind
    double travelled = 0;                    // distance of the mean wind so far, along itself [m]
    Vec3 origin = Vec3::Zero();              // the world's, in the frame in which the gusts were made [m]
    frond_wind_field_fn* field = nullptr;    // the host's own
    mutable std::mutex field_mutex;          // it is called from one thread at a time
    void* user = nullptr;
};

// Makes a wind; the caller has checked `def`.
std::unique_ptr<Wind> make_wind(const frond_wind_def& def);
// Moves the world's origin to `origin`: gusts and ground stay where they are.
void shift_origin(Wind& wind, const Vec3& up, const Vec3& origin);
// Continues the gusts of the wind before in a new one.
void take_over(Wind& wind, const Vec3& up, const Wind& before);
// Advances the mean wind by h [s].
void pass_time(Wind& wind, double h);
// Finds velocities at points [m/s], world frame; `up` is against gravity, length one. False if the host's field gave
// impossible ones; they are zero then.
bool wind_velocities(const Wind& wind, const Vec3& up, double time, const std::vector<frond_vec3>& points,
                     std::vector<frond_vec3>& out);
// Returns the direction against gravity; y if there is none.
Vec3 up_of(const Vec3& gravity);

}  // namespace frond
