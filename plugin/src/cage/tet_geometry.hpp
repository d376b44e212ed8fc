// A tet from its corners: volume, and weights of a position in it.
#pragma once

#include "core/types.hpp"

namespace frond {

// Computes the volume [m^3], positive if a b c run anticlockwise seen from d.
double tet_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
double tet_volume(const std::vector<Vec3>& nodes, const Tet& tet);
double tet_volume(const VecX& x, const Tet& tet);
Vec3 tet_centre(const std::vector<Vec3>& nodes, const Tet& tet);
// Computes the weights of the four corners whose sum is the position; they add up to one, and are not finite in a flat
// tet.
std::array<double, 4> tet_weights(const std::vector<Vec3>& nodes, const Tet& tet, const Vec3& place);

}  // namespace frond
