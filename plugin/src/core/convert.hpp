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

}  // namespace frond
