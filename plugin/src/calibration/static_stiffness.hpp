// The stiffness of a cage whose root is held, and its factor, for calibration and the rest shape.
#pragma once

#include "mechanics/mechanics.hpp"
#include "solve/block_factor.hpp"

namespace frond {

struct StaticStiffness {
    BlockMatrix K;
    BlockPlan plan;
    BlockFactor factor;
    explicit StaticStiffness(const BlockPattern& pattern);
    // Fills and factorizes it at x; false if it is not positive definite, so that x is not stable.
    bool set(const Elements& elements, const std::vector<uint8_t>& held, frond_mechanics which, Tangent tangent,
             const VecX& x);
    bool set(const Elements& elements, const std::vector<uint8_t>& held, const Mechanics& row, Tangent tangent,
             const VecX& x);
};

}  // namespace frond
