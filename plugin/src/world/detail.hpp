// Detail: how much of each plant of a world is simulated, by its distance and the time available.
#pragma once

#include "core/types.hpp"
#include "frond/frond.h"
#include "frond/frond_bullet.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct World;
struct PlantBody;

struct Detail {
    frond_detail_def def;
    Vec3 viewer = Vec3::Zero();
    bool has_viewer = false;
    // Measured step times.
    double ms_of[2] = {0.05, 0.05};  // time of a plant's step in full and as rods [ms]
    double overhead = 1.3;           // time of a substep over the sum of its plants' steps [-]
    double room = 1;                 // factor on the planned budget, for what the other three do not predict [-]
};

// Sets the distances of detail; null ends it. The caller has checked `def`.
void set_detail(World& world, const frond_detail_def* def);
// Returns whether a sleeping plant is so far away that nothing wakes it.
bool is_still(const World& world, const PlantBody& body);
// Ends a plant's modal motion: it is simulated until its detail is chosen again.
void end_sway(PlantBody& body);
// Notes that a body or the host moves a plant: for a while it is simulated at any distance, in every substep.
void disturb(PlantBody& body);
// Gives each plant that is awake its detail. Call it before plants are stepped.
void choose_details(World& world);
// Updates the measured times. Call it after a substep.
void learn_times(World& world);
// Returns the detail that the plant has, or should have when it wakes.
frond_detail detail_of(const World& world, const PlantBody& body);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
