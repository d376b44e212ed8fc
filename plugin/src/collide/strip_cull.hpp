// Quick: whether two cores stay apart on their straight ways.
#pragma once

#include <algorithm>

#include "collide/strip.hpp"

namespace frond {

// Returns whether all corners of two cores, or of parts of them, stay farther apart than `near` [m] along a line, from
// b to a and of any length: then so do the cores.
template <size_t COUNT>
bool stay_apart_along(const Vec3& between, const std::array<Vec3, COUNT>& a_before,
                      const std::array<Vec3, COUNT>& a_after, const std::array<Vec3, COUNT>& b_before,
                      const std::array<Vec3, COUNT>& b_after, double near) {
    const double distance = between.norm();
    const auto is_beyond = [&](const std::array<Vec3, COUNT>& a, const std::array<Vec3, COUNT>& b) {
        double low = INFINITY, high = -INFINITY;
        for (size_t k = 0; k < COUNT; ++k) {
            low = std::min(low, between.dot(a[k]));
            high = std::max(high, between.dot(b[k]));
        }
        return low - high > near * distance;
    };
    return is_beyond(a_before, b_before) && is_beyond(a_after, b_after);
}

inline Vec3 middle_of(const StripCore& core) {
    return 0.25 * (core.at[0] + core.at[1] + core.at[2] + core.at[3]);
}

// The same along the line between their middles before the step. False where that line does not tell.
inline bool stay_apart(const StripCore& a_before, const StripCore& a_after, const StripCore& b_before,
                       const StripCore& b_after, double near) {
    return stay_apart_along(middle_of(a_before) - middle_of(b_before), a_before.at, a_after.at, b_before.at, b_after.at,
                            near);
}

// The same along what of that line is across their way to each other.
inline bool pass_by(const StripCore& a_before, const StripCore& a_after, const StripCore& b_before,
                    const StripCore& b_after, double near) {
    const Vec3 between = middle_of(a_before) - middle_of(b_before);
    const Vec3 way = middle_of(a_after) - middle_of(b_after) - between;
    const double square = way.squaredNorm();
    const Vec3 across = between - between.dot(way) / square * way;
    return square > 0 && stay_apart_along(across, a_before.at, a_after.at, b_before.at, b_after.at, near);
}

}  // namespace frond
