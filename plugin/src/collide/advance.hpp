// Conservative advancement (Mirtich 1996, "Impulse-based Dynamic Simulation of Rigid Body Systems") of moving shapes:
// at their gap, motion bounds the time for which they certainly stay apart, so that time never steps over a contact.
#pragma once

#include <algorithm>
#include <array>

#include "core/types.hpp"

namespace frond {

template <size_t COUNT>
using Points = std::array<Vec3, COUNT>;

template <size_t COUNT>
Points<COUNT> at_time(const Points<COUNT>& before, const Points<COUNT>& after, double time) {
    Points<COUNT> now;
    for (size_t k = 0; k < COUNT; ++k) now[k] = before[k] + time * (after[k] - before[k]);
    return now;
}

// A bound for shapes whose corners move along straight lines: they stay apart as long as all corners of the one stay
// beyond all corners of the other along the line between the nearest points.
// Returns the time until which no corner of a is nearer than `radius` to one of b along the normal; beyond 1 if none
// ever is.
template <size_t A, size_t B>
double apart_until(double time, const Vec3& normal, double radius, const Points<A>& a_now, const Points<A>& a_after,
                   const Points<B>& b_now, const Points<B>& b_after) {
    double until = 2;
    for (size_t i = 0; i < A; ++i)
        for (size_t j = 0; j < B; ++j) {
            const double now = normal.dot(a_now[i] - b_now[j]), then = normal.dot(a_after[i] - b_after[j]);
            if (then >= radius) continue;
            until = std::min(until, time + (1 - time) * (now - radius) / (now - then));
        }
    return until;
}

// Advances to the first time at which gap_at(time).distance is at most `tolerance`, and calls found(time, gap) then.
// Returns whether there is one. until(time, gap): the time until which they stay apart for certain. Where shapes slide
// past each other at hardly more, steps become short; after `most` of them they count as touching, which errs on the
// safe side.
template <class GapAt, class Until, class Found>
bool advance(double tolerance, int most, GapAt&& gap_at, Until&& until, Found&& found) {
    double time = 0;
    for (int step = 0;; ++step) {
        const auto gap = gap_at(time);
        if (gap.distance <= tolerance || step == most) {
            found(time, gap);
            return true;
        }
        time = std::max(time, until(time, gap));
        if (!(time <= 1)) return false;
    }
}

}  // namespace frond
