// In: corners of a tet. Out: its volume, and the barycentric coordinates of positions.
#include "cage/tet_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace frond {

double tet_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return (b - a).cross(c - a).dot(d - a) / 6;
}

double tet_volume(const std::vector<Vec3>& nodes, const Tet& tet) {
    return tet_volume(nodes[size_t(tet[0])], nodes[size_t(tet[1])], nodes[size_t(tet[2])], nodes[size_t(tet[3])]);
}

double tet_volume(const VecX& x, const Tet& tet) {
    return tet_volume(point(x, tet[0]), point(x, tet[1]), point(x, tet[2]), point(x, tet[3]));
}

std::array<double, 4> tet_weights(const std::vector<Vec3>& nodes, const Tet& tet, const Vec3& place) {
    const Vec3& a = nodes[size_t(tet[0])];
    const Vec3 ab = nodes[size_t(tet[1])] - a, ac = nodes[size_t(tet[2])] - a, ad = nodes[size_t(tet[3])] - a;
    const Vec3 ap = place - a;
    const double whole = ab.dot(ac.cross(ad));
    const double at_b = ap.dot(ac.cross(ad)) / whole, at_c = ap.dot(ad.cross(ab)) / whole,
                 at_d = ap.dot(ab.cross(ac)) / whole;
    return {1 - at_b - at_c - at_d, at_b, at_c, at_d};
}

PlaceInTets deepest_in(const std::vector<Vec3>& nodes, const std::vector<Tet>& tets, const std::vector<int>& some,
                       const Vec3& place) {
    PlaceInTets best = {some.front(), {1, 0, 0, 0}};
    double deepest = -INFINITY;
    for (int tet : some) {
        const auto weights = tet_weights(nodes, tets[size_t(tet)], place);
        const double depth = *std::min_element(weights.begin(), weights.end());
        if (!(depth > deepest)) continue;
        deepest = depth;
        best = {tet, weights};
    }
    return best;
}

}  // namespace frond
