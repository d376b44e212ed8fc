// Ledger: the energy of a world's plants, and the work done on them, from the host's first request on.
#pragma once

#include <cstdint>
#include <map>
#include <memory>

#include "core/types.hpp"
#include "frond/frond_bullet.hpp"

namespace frond {
struct System;
inline namespace FROND_BULLET_PRECISION {

struct World;

struct Ledger {
    struct Entry {
        frond_energy energy = {};  // as last counted [J]
        VecX x;                    // positions before the running step, model frame [m]
        size_t fragments = 0;
        bool is_modal = false;                 // does not count
        bool is_asleep = false;                // may have been changed since it was counted
        std::shared_ptr<const System> system;  // of which `modelled` is the elastic energy in the modelled shape [J]
        double modelled = 0;
        bool is_there = false;  // scratch
    };
    frond_energy_ledger sums = {};     // all but `now` and `dissipated`
    std::map<uint64_t, Entry> plants;  // by handle
};

// Begins accounting if it has not begun; returns the ledger as it is now.
frond_energy_ledger ledger_now(World& world);
// Steps of accounting within a substep, in their order: what the host's calls changed since the last one; where plants
// are before they are solved; the work done on them by loads, contacts and bonds; what came off.
void count_calls(World& world);
void begin_work(World& world);
void count_work(World& world);
void count_what_came_off(World& world);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
