// Conversion between Bullet's vectors and Eigen's, and motion of Bullet's frames.
#pragma once

#include <LinearMath/btTransform.h>

#include <algorithm>

#include "core/elementary.hpp"
#include "core/types.hpp"
#include "frond/frond_bullet.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

inline btVector3 to_bullet(const Vec3& v) {
    return btVector3(btScalar(v.x()), btScalar(v.y()), btScalar(v.z()));
}
inline btQuaternion to_bullet(const Quat& q) {
    return btQuaternion(btScalar(q.x()), btScalar(q.y()), btScalar(q.z()), btScalar(q.w()));
}
inline Vec3 from_bullet(const btVector3& v) {
    return Vec3(double(v.x()), double(v.y()), double(v.z()));
}

// Moves a frame by a share of a way and of a rotation vector, as btTransformUtil::integrateTransform does, but by our
// own sine and cosine; like there the angle is an eighth of a turn at most.
inline btTransform moved(const btTransform& from, const Vec3& way, const Vec3& turn, double share) {
    constexpr double MOST = 0.25 * PI, SMALL = 1e-9;  // angles [rad]; below the second, sine is its angle
    const double whole = turn.norm(), half = 0.5 * std::min(share * whole, MOST);
    const Vec3 axis = turn * (whole < SMALL ? 0.5 * share : frond::sin(half) / whole);
    const btVector3 v = to_bullet(axis);
    btQuaternion rotation = btQuaternion(v.x(), v.y(), v.z(), btScalar(frond::cos(half))) * from.getRotation();
    rotation.safeNormalize();
    return btTransform(rotation, from.getOrigin() + btScalar(share) * to_bullet(way));
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
