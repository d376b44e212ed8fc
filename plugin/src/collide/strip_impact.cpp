// In: two cores before and after a step. Out: when they first come near each other.
#include "collide/advance.hpp"
#include "collide/strip.hpp"

namespace frond {

std::optional<StripImpact> first_impact(const StripCore& a_before, const StripCore& a_after, const StripCore& b_before,
                                       const StripCore& b_after, double near) {
    constexpr double TOLERANCE = 0.01;  // over `near` [-]
    constexpr int MOST_STEPS = 100;
    std::optional<StripImpact> impact;
    const auto gap_now = [&](const StripQuad& a, const StripQuad& b) {
        StripGap gap = gap_between(StripCore{a, a_before.is_line}, StripCore{b, b_before.is_line});
        gap.distance -= near;
        return gap;
    };
    advance(a_before.at, a_after.at, b_before.at, b_after.at, near, TOLERANCE * near, MOST_STEPS, gap_now,
            [&](double time, const StripGap& gap) {
                impact = StripImpact{time, gap};
                impact->gap.distance += near;
            });
    return impact;
}

}  // namespace frond
