// Bounds of a surface. In: positions. Out: the corners of the smallest axis-parallel box [m].
#include "surface/surface.hpp"

namespace frond {

Vec3 Surface::lower() const {
    if (positions.empty()) return Vec3::Zero();
    Vec3 corner = positions.front();
    for (const Vec3& position : positions) corner = corner.cwiseMin(position);
    return corner;
}

Vec3 Surface::upper() const {
    if (positions.empty()) return Vec3::Zero();
    Vec3 corner = positions.front();
    for (const Vec3& position : positions) corner = corner.cwiseMax(position);
    return corner;
}

}  // namespace frond
