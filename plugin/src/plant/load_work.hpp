// Work of loads: what each load of a step did on a plant.
#pragma once

#include "core/types.hpp"

namespace frond {

struct Plant;

// All [J].
struct LoadWork {
    double forces = 0, grabs = 0, air = 0, pins = 0, contacts = 0;
    double error = 0, air_error = 0;  // estimates of the errors of their sum without the air, and of the air's
};

// Returns the displacement of all nodes in the running step, rotation vectors by the shorter way [m], [rad].
VecX way_of_step(const Plant& plant);

// Computes the work of the loads in a step of h [s] that the plant has just completed, before anything yields: each
// load's force at the step's end times the displacement of what it acts on, as implicit Euler counts it. Grabs give
// what their springs lose, and the elastic force on pins counts by its mean. The estimated errors are half the change
// of other forces, and how far that on pins is halfway from its mean, times displacement.
LoadWork work_of_loads(const Plant& plant, double h);

}  // namespace frond
