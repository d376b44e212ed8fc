// Conversions between values of the C API and those of the library.
#pragma once

#include "core/types.hpp"
#include "frond/frond.h"

namespace frond {

inline Vec3 to_vec(const frond_vec3& p) {
    return Vec3(p.x, p.y, p.z);
}
inline frond_vec3 from_vec(const Vec3& p) {
    return {p.x(), p.y(), p.z()};
}
inline Quat to_quat(const frond_quat& q) {
    return Quat(q.w, q.x, q.y, q.z);
}
inline frond_quat from_quat(const Quat& q) {
    return {q.x(), q.y(), q.z(), q.w()};
}

}  // namespace frond
