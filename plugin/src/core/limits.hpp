// Limits of a plant's numbers, whatever their source.
#pragma once

namespace frond {

// Largest coordinate or velocity component [m, m/s], or component of any other vector from a caller, in its unit.
constexpr double LARGEST_COORDINATE = 1e9;

}  // namespace frond
