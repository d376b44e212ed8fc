// A tet from its corners: volume, and weights of a position in it.
#pragma once

#include "core/types.hpp"

namespace frond {

// Computes the volume [m^3], positive if a b c run anticlockwise seen from d.
double tet_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
double tet_volume(const std::vector<Vec3>& nodes, const Tet& tet);
double tet_volume(const VecX& x, const Tet& tet);
// Computes the weights of the four corners whose sum is the position; they add up to one, and are not finite in a flat
// tet.
std::array<double, 4> tet_weights(const std::vector<Vec3>& nodes, const Tet& tet, const Vec3& place);

struct PlaceInTets {
    int tet;
    std::array<double, 4> weights;
};
// Finds the tet of some of a cage's in which a position lies deepest: that with the largest least weight, and of equal
// ones the first.
PlaceInTets deepest_in(const std::vector<Vec3>& nodes, const std::vector<Tet>& tets, const std::vector<int>& some,
                       const Vec3& place);

}  // namespace frond
