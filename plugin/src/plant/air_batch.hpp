// Air around plants that are stepped abreast.
#pragma once

#include "plant/plant.hpp"
#include "solve/batch.hpp"

namespace frond {

// Room for it: of each vector every number is there once a lane.
struct AirBatch {
    std::shared_ptr<const AirPieces> pieces;
    NumbersInLines chain;                // where chain nodes of cages are, model frame [m]
    NumbersInLines places, wind;         // of chain nodes, and there, world frame [m], [m/s]
    NumbersInLines passing, velocities;  // of the air past chain nodes, and of these, model frame [m/s]
    NumbersInLines resistance, lag;      // six numbers a chain node [N s/m]
    NumbersInLines to_world, position;   // of plants: nine numbers, row by row, and three [m]
};

// Sets the drags of `step`, whose x and v are set, as gather_air() does; lanes beyond the plants take the last one
// again. Plants whose wind was unsound are told of, a bit each.
unsigned gather_air(AirBatch& air, Batch& step, Plant* const* plants, int plant_count, const Surroundings& surroundings,
                    frond_effects effects, double h);
// Force of the drags at the end of the step, model frames, three numbers [N]; lanes in which there are any, a bit each.
unsigned air_forces(const Batch& step, NumbersInLines& out);
// Those of one lane, as gather_air() leaves them.
void take_drags(const Batch& step, int lane, std::vector<Drag>& out);

}  // namespace frond
