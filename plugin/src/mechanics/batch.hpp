// Helpers of the rows of BatchMechanics.
#pragma once

#include <algorithm>

#include "mechanics/mechanics.hpp"

namespace frond {

// Share of a limit beyond which a lane is left to its plant's own check: rounding differs between lanes and one by one.
constexpr double NEARLY = 1 - 1e-9;

// Returns the number of lanes of batched node data.
inline int lanes_of(const Elements& body, const NumbersInLines& x) {
    return int(x.size()) / (3 * body.node_count);
}

// Zeroes the blocks of batched matrices that nothing was added to.
inline void leave_no_gaps(int lanes, const std::vector<uint8_t>& filled, BlockMatrix& A) {
    for (size_t slot = 0; slot < filled.size(); ++slot)
        if (!filled[slot]) std::fill_n(A.values.begin() + std::ptrdiff_t(9 * slot) * lanes, 9 * lanes, 0.0);
}

}  // namespace frond
