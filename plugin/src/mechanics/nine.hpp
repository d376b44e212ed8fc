// Nine: a 3x3 block of one lane, by columns.
#pragma once

#include "core/lane_vectors.hpp"

namespace frond {

struct Nine {
    FourLanes low, high;
    double last;
};
FROND_INLINE Nine operator+(const Nine& a, const Nine& b) {
    return {a.low + b.low, a.high + b.high, a.last + b.last};
}
FROND_INLINE Nine operator*(double a, const Nine& b) {
    return {a * b.low, a * b.high, a * b.last};
}
FROND_INLINE void add_to(double* block, const Nine& a) {
    store(FourLanes(load<FourLanes>(block) + a.low), block);
    store(FourLanes(load<FourLanes>(block + 4) + a.high), block + 4);
    block[8] += a.last;
}

// Splits the block of four lanes into one block a lane.
FROND_INLINE void lane_by_lane(const Lanes33<FourLanes>& k, Nine (&out)[4]) {
    FourLanes low[4], high[4];
    turn_over(k.r[0].x, k.r[1].x, k.r[2].x, k.r[0].y, low);
    turn_over(k.r[1].y, k.r[2].y, k.r[0].z, k.r[1].z, high);
    for (int l = 0; l < 4; ++l) out[l] = {low[l], high[l], k.r[2].z[l]};
}

}  // namespace frond
