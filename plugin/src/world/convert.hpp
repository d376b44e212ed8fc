// Conversion between Bullet's vectors and Eigen's.
#pragma once

#include <LinearMath/btVector3.h>

#include "core/types.hpp"
#include "frond/frond_bullet.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

inline btVector3 to_bullet(const Vec3& v) {
    return btVector3(btScalar(v.x()), btScalar(v.y()), btScalar(v.z()));
}
inline Vec3 from_bullet(const btVector3& v) {
    return Vec3(double(v.x()), double(v.y()), double(v.z()));
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
