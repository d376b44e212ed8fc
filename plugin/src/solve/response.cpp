// The table of responses: one row for each name in FROND_RESPONSES; what needs impulses alone stands here.
#include "solve/position_correction.hpp"

namespace frond {

const ResponseRow& response_row(frond_response which) {
    static const ResponseRow TABLE[] = {
        {"impulse", push_by_impulse},
        {"penalty", push_by_penalty},
        {"none", nullptr},
    };
    static_assert(sizeof TABLE / sizeof TABLE[0] == FROND_RESPONSE_COUNT, "every response needs its row");
    return TABLE[which];
}

// Velocities first. Then places, as if all were at rest and smooth, so that what parts gets no energy of motion.
void push_by_impulse(const std::vector<Touch>& touches, const CouplingTable& coupling, const ResponseSettings& settings,
                     Pushes& out) {
    out.corrections.clear();
    constexpr double MOVES = 1e-5;  // what is not felt [m/s]
    find_impulses(touches, coupling, settings.limits, out.impulses, MOVES);
    correct_positions(touches, coupling, settings, out.corrections);
}

}  // namespace frond
