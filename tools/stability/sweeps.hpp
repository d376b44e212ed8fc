// Sweeps: things that come at a plant at any speed, and whether they pass through it.
#pragma once

#include <string>
#include <vector>

#include "stability/stability.hpp"

namespace frond::stability {

// What meets: a standing plant, and what comes at it along x.
enum class Meeting { STEM, ITSELF, LEAF, WALL, BALL, WIRE, PLATE, COUNT };
const char* name_of(Meeting meeting);

struct Sweep {
    Meeting meeting;
    frond_mechanics mechanics;
    double speed, dt;  // [m/s], [s]
};

// Returns whether the thing went through the plant, or comes out on its other side. What moves farther than half of the
// plant's size beyond it within one step may do so, if the world reports FROND_TROUBLE_PASSED.
bool may_pass(const Sweep& sweep);
// Green: it did not pass; grey: it passed, as it may; red: it passed in silence or without need, or worse.
Verdict run_sweep(const Sweep& sweep);
// Returns whether a body is known to pass now and then, and to say so: kinematic ones from 7 cm in a step on.
bool is_known_to_pass(const Sweep& sweep);

// The whole table, 0.1 to 100 m/s, or the quick sample of it.
std::vector<Sweep> sweeps(bool quick);
struct SweptCell {
    Sweep sweep;
    Verdict verdict;
};
std::vector<SweptCell> run_sweeps(bool quick, const Limits& limits, const std::function<void(int done)>& tell);
// A row for each meeting, mechanics and step, a column for each speed.
std::string text_of(const std::vector<SweptCell>& cells);

}  // namespace frond::stability
