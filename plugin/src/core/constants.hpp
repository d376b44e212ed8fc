// Mathematical constants.
#pragma once

namespace frond {

constexpr double PI = 3.14159265358979323846;
constexpr double SQRT2 = 1.41421356237309504880;

}  // namespace frond
