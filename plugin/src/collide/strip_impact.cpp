// In: two cores before and after a step. Out: when they first come near each other. Of each part by itself, which is
// convex; a quad that is bent along its diagonal is not.
#include "collide/advance.hpp"
#include "collide/strip.hpp"
#include "collide/strip_cull.hpp"
#include "core/assert.hpp"

namespace frond {

static StripCore at_time(const StripCore& before, const StripCore& after, double time) {
    return {at_time(before.at, after.at, time), before.is_line};
}

std::optional<StripImpact> first_impact(const StripCore& a_before, const StripCore& a_after, const StripCore& b_before,
                                        const StripCore& b_after, double near, const StripGap& now) {
    constexpr double TOLERANCE = 0.01;  // over `near` [-]
    constexpr int MOST_STEPS = 100;     // of an advancement at most
    constexpr double NEVER = 2;         // a time after the step, which ends at 1 [-]
    std::optional<StripImpact> impact;
    const double beyond = (1 + TOLERANCE) * near;
    if (stay_apart_along(now.normal, a_before.at, a_after.at, b_before.at, b_after.at, beyond)) return impact;
    for (int i = 0; i < part_count(a_before); ++i)
        for (int k = 0; k < part_count(b_before); ++k) {
            const Points<3> from_a = part_of(a_before, i), from_b = part_of(b_before, k);
            const Points<3> to_a = part_of(a_after, i), to_b = part_of(b_after, k);
            if (stay_apart_along(now.normal, from_a, to_a, from_b, to_b, beyond)) continue;
            const auto gap_at = [&](double time) {
                StripGap gap = gap_of_parts(at_time(a_before, a_after, time), i, at_time(b_before, b_after, time), k);
                gap.distance -= near;
                return gap;
            };
            const auto keep_first = [&](double time, const StripGap& gap) {
                FROND_ASSERT(time >= 0 && time <= 1);
                if (impact && impact->time <= time) return;
                impact = StripImpact{time, gap};
                impact->gap.distance += near;
            };
            const auto until = [&](double time, const StripGap& gap) {
                const double apart = apart_until(time, gap.normal, near, at_time(from_a, to_a, time), to_a,
                                                 at_time(from_b, to_b, time), to_b);
                return impact && apart > impact->time ? NEVER : apart;  // others meet before
            };
            advance(TOLERANCE * near, MOST_STEPS, gap_at, until, keep_first);
        }
    return impact;
}

}  // namespace frond
