// Limits of a plant's numbers, wherever they come from.
#pragma once

namespace frond {

// The limit of a place or a speed [m, m/s], or of any other vector that a caller gives, in its unit.
constexpr double LARGEST_COORDINATE = 1e9;

}  // namespace frond
