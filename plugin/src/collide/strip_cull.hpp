// Quick: whether two cores stay apart on their straight ways.
#pragma once

#include <algorithm>

#include "collide/strip.hpp"

namespace frond {

// Returns whether all corners of two cores stay farther apart than `near` [m] along a line, from b to a and of any
// length: then so do the cores.
inline bool stay_apart_along(const Vec3& between, const StripCore& a_before, const StripCore& a_after,
                             const StripCore& b_before, const StripCore& b_after, double near) {
    const double distance = between.norm();
    const auto is_beyond = [&](const StripQuad& a, const StripQuad& b) {
        double low = INFINITY, high = -INFINITY;
        for (size_t k = 0; k < 4; ++k) {
            low = std::min(low, between.dot(a[k]));
            high = std::max(high, between.dot(b[k]));
        }
        return low - high > near * distance;
    };
    return is_beyond(a_before.at, b_before.at) && is_beyond(a_after.at, b_after.at);
}

// The same along the line between their middles before the step. False where that line does not tell.
inline bool stay_apart(const StripCore& a_before, const StripCore& a_after, const StripCore& b_before,
                       const StripCore& b_after, double near) {
    const auto middle = [](const StripQuad& q) { return Vec3(0.25 * (q[0] + q[1] + q[2] + q[3])); };
    return stay_apart_along(middle(a_before.at) - middle(b_before.at), a_before, a_after, b_before, b_after, near);
}

}  // namespace frond
