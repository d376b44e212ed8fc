// Detail: how much of each plant of a world is simulated, by its distance and by what time there is.
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
    // The measured time that steps take.
    double ms_of[2] = {0.05, 0.05};  // a plant in full, as rods [ms]
    double overhead = 1.3;           // time of a substep over that of its plants' steps [-]
    double room = 1;                 // of the budget that is planned with: what the other three cannot tell [-]
};

// Null ends it. `def` has been checked by the caller.
void set_detail(World& world, const frond_detail_def* def);
// Tells whether a plant that sleeps is so far away that nothing wakes it.
bool is_still(const World& world, const PlantBody& body);
// A plant is simulated again, until its detail is chosen anew.
void end_sway(PlantBody& body);
// Before plants are stepped: gives those that are awake their detail.
void choose_details(World& world);
// After a substep: how long it took.
void learn_times(World& world);
// Returns the detail that the plant has, or should have when it wakes.
frond_detail detail_of(const World& world, const PlantBody& body);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
