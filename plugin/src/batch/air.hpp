// Air around plants that are stepped as a batch.
#pragma once

#include "batch/batch_step.hpp"
#include "plant/plant_step.hpp"

namespace frond {

// Memory for it: every number of a vector is stored once per lane.
struct AirBatch {
    std::shared_ptr<const AirPieces> pieces;
    NumbersInLines chain;                // positions of cages' chain nodes, model frame [m]
    NumbersInLines places, wind;         // positions of chain nodes, and wind there, world frame [m], [m/s]
    NumbersInLines passing, velocities;  // air relative to chain nodes, and their velocities, model frame [m/s]
    NumbersInLines resistance, lag;      // six numbers per chain node [N s/m]
    NumbersInLines to_world, position;   // plants' frames: nine numbers, row by row, and three [m]
};

// Sets the drags of `step`, whose x and v are set, as gather_air() does; lanes beyond the plants repeat the last one.
// Returns the plants whose wind was unsound, a bit each.
unsigned gather_air(AirBatch& air, Batch& step, Plant* const* plants, int plant_count, const Surroundings& surroundings,
                    frond_effects effects, double h);
// Computes the force of the drags at the end of the step, model frames, three numbers [N].
void air_forces(const Batch& step, NumbersInLines& out);
// Takes out the drags of one lane, as gather_air() leaves them.
void take_drags(const Batch& step, int lane, std::vector<Drag>& out);

}  // namespace frond
