// Interleaves the numbers of several plants for a batch, each number once a lane, and separates them again.
#pragma once

#include "core/lanes.hpp"

namespace frond {

// The pointer lists, `from` here and `to` in put_apart(), have one entry a lane.
template <class S>
FROND_INLINE void put_side_by_side(const double* const* from, size_t count, double* to) {
    constexpr int MANY = LANES<S>;
    size_t i = 0;
    if constexpr (MANY >= 4)
        for (; i + 4 <= count; i += 4)
            for (int lane = 0; lane < MANY; lane += 4) {
                const auto of = [&](int k) { return load<FourLanes>(from[lane + k] + i); };
                FourLanes turned[4];
                turn_over(of(0), of(1), of(2), of(3), turned);
                for (size_t k = 0; k < 4; k++) store(turned[k], to + size_t(MANY) * (i + k) + lane);
            }
    for (; i < count; i++)
        for (int lane = 0; lane < MANY; lane++) to[size_t(MANY) * i + size_t(lane)] = from[lane][i];
}
template <class S>
FROND_INLINE void put_apart(const double* from, size_t count, double* const* to) {
    constexpr int MANY = LANES<S>;
    size_t i = 0;
    if constexpr (MANY >= 4)
        for (; i + 4 <= count; i += 4)
            for (int lane = 0; lane < MANY; lane += 4) {
                const auto of = [&](size_t k) { return load<FourLanes>(from + size_t(MANY) * (i + k) + lane); };
                FourLanes turned[4];
                turn_over(of(0), of(1), of(2), of(3), turned);
                for (int k = 0; k < 4; k++) store(turned[k], to[lane + k] + i);
            }
    for (; i < count; i++)
        for (int lane = 0; lane < MANY; lane++) to[lane][i] = from[size_t(MANY) * i + size_t(lane)];
}

}  // namespace frond
