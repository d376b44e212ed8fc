// The table of responses: one row for each name in FROND_RESPONSES; what needs impulses alone stands here.
#include <algorithm>

#include "solve/shifts.hpp"

namespace frond {

const ResponseRow& response_row(frond_response which) {
    static const ResponseRow TABLE[] = {
        {"impulse", push_by_impulse, true},
        {"penalty", push_by_penalty, false},
        {"none", nullptr, false},
    };
    static_assert(sizeof TABLE / sizeof TABLE[0] == FROND_RESPONSE_COUNT, "every response needs its row");
    return TABLE[which];
}

// Velocities first. Then places, as if all were at rest and smooth, so that what parts gets no energy of motion.
void push_by_impulse(const std::vector<Touch>& touches, const CouplingTable& coupling, const ResponseSettings& settings,
                     Pushes& out) {
    out.shifts.clear();
    constexpr double MOVES = 1e-5, SHIFTS = 1e-3;  // what is not felt, nor seen [m/s]
    find_impulses(touches, coupling, settings.limits, out.impulses, MOVES);
    const auto overlaps = [](const Touch& touch) { return touch.least_shift > 0; };
    if (std::none_of(touches.begin(), touches.end(), overlaps)) return;
    // Leaves that are pressed from two sides may have no answer at all; what is left is for the next steps.
    constexpr int ROUNDS = 40;
    out.shifts = find_shifts(touches, coupling, std::min(settings.limits.iterations, ROUNDS), settings.limits.tolerance,
                             SHIFTS);
}

}  // namespace frond
