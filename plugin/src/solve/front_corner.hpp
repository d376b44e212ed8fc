// Corner: the factorized triangle of three columns of a front; of one matrix, or of one a lane.
#pragma once

#include "core/lanes.hpp"

namespace frond {

template <class S>
struct Corner {
    S below[3];  // unscaled: (1, 0), (2, 0), (2, 1)
    S pivot[3], inverse[3];
};

constexpr double LARGEST_PIVOT = 1e300;  // also refuses what is not finite

// Factorizes the triangle on and below the diagonal, given column by column.
template <class S>
FROND_INLINE Corner<S> corner_of(const S& a00, const S& a10, const S& a20, const S& a11, const S& a21, const S& a22) {
    const S i0 = 1.0 / a00, l10 = a10 * i0, l20 = a20 * i0;
    const S left = a21 - l20 * a10;
    const S d1 = a11 - l10 * a10, i1 = 1.0 / d1;
    const S d2 = (a22 - l20 * a20) - left * i1 * left;
    return {{a10, a20, left}, {a00, d1, d2}, {i0, i1, S(1.0 / d2)}};
}

}  // namespace frond
