// Products that are the same to the last bit for one plant and for a batch: sums in the order of lane_vectors.hpp.
#pragma once

#include "core/lane_vectors.hpp"
#include "core/types.hpp"

namespace frond {

template <class Vector>
inline Lanes3<double> lanes_of(const Vector& v) {
    return {v[0], v[1], v[2]};
}
inline Lanes33<double> lanes_of(const Mat3& m) {
    return {{{m(0, 0), m(0, 1), m(0, 2)}, {m(1, 0), m(1, 1), m(1, 2)}, {m(2, 0), m(2, 1), m(2, 2)}}};
}
inline Vec3 vector_of(const Lanes3<double>& v) {
    return {v.x, v.y, v.z};
}
inline Vec3 product(const Mat3& m, const Vec3& v) {
    return vector_of(lanes_of(m) * lanes_of(v));
}

}  // namespace frond
