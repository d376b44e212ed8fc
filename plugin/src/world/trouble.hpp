// What a host can ask of one plant after a substep: what went wrong with it, and what moved it without a force.
#pragma once

#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Notes bits of FROND_TROUBLE_* of the running substep: of a plant alone, or of a plant and in the world's report.
inline void note_of_plant(const World& world, PlantBody& body, uint32_t bits) {
    static_assert(FROND_TROUBLE_CHANGED_DETAIL <= UINT16_MAX);
    if (body.troubled_in != uint32_t(world.substep)) body.trouble = 0;
    body.troubled_in = uint32_t(world.substep);
    body.trouble = uint16_t(body.trouble | bits);
}
inline void note_trouble(World& world, PlantBody& body, uint32_t bits) {
    note_of_plant(world, body, bits);
    world.report.trouble |= bits;
}

// Returns the bits of the last substep.
inline uint32_t trouble_of(const PlantBody& body) {
    return body.troubled_in == uint32_t(body.world->substep) ? body.trouble : 0;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
