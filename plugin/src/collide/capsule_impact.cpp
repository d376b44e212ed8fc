// First contact of moving capsules and triangles: shapes before and after a step come in, the first time of contact
// goes out. Conservative advancement (Mirtich 1996, "Impulse-based Dynamic Simulation of Rigid Body Systems") along the
// line between the nearest points: shapes stay apart as long as all corners of the one stay beyond all corners of the
// other along that line, and the corners' straight paths give the time at which that ends. So time never steps over a
// contact.
#include <array>

#include "collide/capsule.hpp"

namespace frond {

template <size_t COUNT>
using Points = std::array<Vec3, COUNT>;

template <size_t COUNT>
static Points<COUNT> at_time(const Points<COUNT>& before, const Points<COUNT>& after, double time) {
    Points<COUNT> now;
    for (size_t k = 0; k < COUNT; ++k) now[k] = before[k] + time * (after[k] - before[k]);
    return now;
}

static Capsule capsule_of(const Points<2>& ends, double radius) {
    return {ends[0], ends[1], radius};
}

// Returns the time until which no corner of a is nearer than `radius` to one of b along the normal; beyond 1 if none
// ever is.
template <size_t A, size_t B>
static double apart_until(double time, const Vec3& normal, double radius, const Points<A>& a_now,
                          const Points<A>& a_after, const Points<B>& b_now, const Points<B>& b_after) {
    double until = 2;
    for (size_t i = 0; i < A; ++i)
        for (size_t j = 0; j < B; ++j) {
            const double now = normal.dot(a_now[i] - b_now[j]), then = normal.dot(a_after[i] - b_after[j]);
            if (then >= radius) continue;
            until = std::min(until, time + (1 - time) * (now - radius) / (now - then));
        }
    return until;
}

// Advances to the first contact. `radius` is the sum of both shapes' radii; gap_now(a, b) returns their gap.
template <size_t A, size_t B, class GapNow>
static std::optional<Impact> advance(const Points<A>& a_before, const Points<A>& a_after, const Points<B>& b_before,
                                     const Points<B>& b_after, double radius, GapNow&& gap_now) {
    // Shapes touch below this gap, over their sizes. Where they slide past each other at hardly more, steps become
    // short; after MOST_STEPS of them the shapes count as touching, which errs on the safe side.
    constexpr double TOLERANCE = 1e-6;
    constexpr int MOST_STEPS = 1000;
    const double size = radius + (a_before[A - 1] - a_before[0]).norm() + (b_before[B - 1] - b_before[0]).norm();
    double time = 0;
    for (int step = 0;; ++step) {
        const Points<A> a_now = at_time(a_before, a_after, time);
        const Points<B> b_now = at_time(b_before, b_after, time);
        const Gap gap = gap_now(a_now, b_now);
        if (gap.distance <= TOLERANCE * size || step == MOST_STEPS) return Impact{time, gap};
        time = apart_until(time, gap.normal, radius, a_now, a_after, b_now, b_after);
        if (time > 1) return std::nullopt;
    }
}

std::optional<Impact> first_impact(const Capsule& a_before, const Capsule& a_after, const Capsule& b_before,
                                   const Capsule& b_after) {
    return advance(Points<2>{a_before.begin, a_before.end}, Points<2>{a_after.begin, a_after.end},
                   Points<2>{b_before.begin, b_before.end}, Points<2>{b_after.begin, b_after.end},
                   a_before.radius + b_before.radius, [&](const Points<2>& a, const Points<2>& b) {
                       return gap_between(capsule_of(a, a_before.radius), capsule_of(b, b_before.radius));
                   });
}

std::optional<Impact> first_impact(const Capsule& a_before, const Capsule& a_after, const Corners& b_before,
                                   const Corners& b_after) {
    return advance(Points<2>{a_before.begin, a_before.end}, Points<2>{a_after.begin, a_after.end}, b_before, b_after,
                   a_before.radius, [&](const Points<2>& a, const Corners& b) {
                       return gap_between(capsule_of(a, a_before.radius), b);
                   });
}

}  // namespace frond
