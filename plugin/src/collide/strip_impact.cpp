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
    constexpr int MOST_STEPS = 100;
    std::optional<StripImpact> impact;
    if (stay_apart_along(now.normal, a_before, a_after, b_before, b_after, (1 + TOLERANCE) * near)) return impact;
    for (int i = 0; i < part_count(a_before); ++i)
        for (int k = 0; k < part_count(b_before); ++k) {
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
                const Points<3> of_a = part_of(a_after, i), of_b = part_of(b_after, k);
                return apart_until(time, gap.normal, near, at_time(part_of(a_before, i), of_a, time), of_a,
                                   at_time(part_of(b_before, k), of_b, time), of_b);
            };
            advance(TOLERANCE * near, MOST_STEPS, gap_at, until, keep_first);
        }
    return impact;
}

}  // namespace frond
