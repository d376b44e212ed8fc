// First contact of moving capsules and triangles: shapes before and after a step come in, the first time of contact
// goes out.
#include "collide/advance.hpp"
#include "collide/capsule.hpp"
#include "core/assert.hpp"

namespace frond {

static Capsule capsule_of(const Points<2>& ends, double radius) {
    return {ends[0], ends[1], radius};
}

// `radius` is the sum of both shapes' radii; gap_now(a, b) returns their gap. Shapes touch below a millionth of their
// sizes.
template <size_t A, size_t B, class GapNow>
static std::optional<Impact> impact_of(const Points<A>& a_before, const Points<A>& a_after, const Points<B>& b_before,
                                       const Points<B>& b_after, double radius, GapNow&& gap_now) {
    constexpr double TOLERANCE = 1e-6;
    constexpr int MOST_STEPS = 1000;
    const double size = radius + (a_before[A - 1] - a_before[0]).norm() + (b_before[B - 1] - b_before[0]).norm();
    std::optional<Impact> impact;
    const auto gap_at = [&](double time) {
        return gap_now(at_time(a_before, a_after, time), at_time(b_before, b_after, time));
    };
    advance(a_before, a_after, b_before, b_after, radius, TOLERANCE * size, MOST_STEPS, gap_at,
            [&](double time, const Gap& gap) {
                FROND_ASSERT(time >= 0 && time <= 1);
                impact = Impact{time, gap};
            });
    return impact;
}

std::optional<Impact> first_impact(const Capsule& a_before, const Capsule& a_after, const Capsule& b_before,
                                   const Capsule& b_after) {
    return impact_of(Points<2>{a_before.begin, a_before.end}, Points<2>{a_after.begin, a_after.end},
                     Points<2>{b_before.begin, b_before.end}, Points<2>{b_after.begin, b_after.end},
                     a_before.radius + b_before.radius, [&](const Points<2>& a, const Points<2>& b) {
                         return gap_between(capsule_of(a, a_before.radius), capsule_of(b, b_before.radius));
                     });
}

std::optional<Impact> first_impact(const Capsule& a_before, const Capsule& a_after, const Corners& b_before,
                                   const Corners& b_after) {
    return impact_of(Points<2>{a_before.begin, a_before.end}, Points<2>{a_after.begin, a_after.end}, b_before, b_after,
                     a_before.radius, [&](const Points<2>& a, const Corners& b) {
                         return gap_between(capsule_of(a, a_before.radius), b);
                     });
}

}  // namespace frond
