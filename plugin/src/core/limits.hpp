// What no plant's numbers are beyond, wherever they come from.
#pragma once

namespace frond {

// Of a place or a speed [m, m/s], or of any other vector that a caller gives, in its unit.
constexpr double LARGEST_COORDINATE = 1e9;

}  // namespace frond
