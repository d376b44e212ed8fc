// Arithmetic of the vectors of the C API.
#pragma once

#include <cmath>

#include "frond/frond.h"

namespace frond::tools {

inline frond_vec3 operator+(const frond_vec3& a, const frond_vec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline frond_vec3 operator-(const frond_vec3& a, const frond_vec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline frond_vec3 operator*(double s, const frond_vec3& a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline double dot(const frond_vec3& a, const frond_vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline frond_vec3 cross(const frond_vec3& a, const frond_vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const frond_vec3& a) {
    return std::sqrt(dot(a, a));
}

}  // namespace frond::tools
