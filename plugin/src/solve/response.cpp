// The table of responses: one row for each name in FROND_RESPONSES; and the response by impulses.
#include "solve/impulses.hpp"

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

void push_by_impulse(const std::vector<Touch>& touches, const CouplingTable& coupling, const ResponseSettings& settings,
                     std::vector<Vec3>& impulses) {
    constexpr double MOVES = 1e-5;  // change of velocity that is neglected [m/s]
    find_impulses(touches, coupling, settings.limits, impulses, MOVES);
}

}  // namespace frond
