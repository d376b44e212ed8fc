// Looks that speak for a kind of organ.
#pragma once

#include "surface/surface.hpp"

namespace frond {

// Returns what a colour (linear) looks like; bright ones are neither green nor brown.
bool is_green(const std::array<float, 4>& color);
bool is_brown(const std::array<float, 4>& color);
bool is_bright(const std::array<float, 4>& color);

}  // namespace frond
