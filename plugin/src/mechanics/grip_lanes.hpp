// Grips that do not turn, of several plants side by side.
#pragma once

#include "core/lanes.hpp"
#include "mechanics/grip.hpp"

namespace frond {

// What the point has of what its nodes have: as grip_place() and grip_velocity().
template <class S>
FROND_INLINE Lanes3<S> grip_sum(const Grip& grip, const double* of_nodes) {
    Lanes3<S> sum = {};
    for (size_t k = 0; k < size_t(grip.count); ++k)
        sum = sum + constant<S>(grip.weight[k]) * load3<S>(of_nodes, 3 * grip.node[k]);
    return sum;
}

}  // namespace frond
