// Vectors of three and 3x3 matrices of lanes; like all of lanes.hpp, they give the same bits in any width.
#pragma once

#include "core/lanes.hpp"

namespace frond {

template <class S>
struct Lanes3 {
    S x, y, z;
};
// 3x3 matrix, by rows.
template <class S>
struct Lanes33 {
    Lanes3<S> r[3];
};

// Load and store numbers i to i + 2 of batched plants, in which each number is stored once a lane.
template <class S>
FROND_INLINE Lanes3<S> load3(const double* from, int i) {
    const double* at = from + LANES<S> * size_t(i);
    return {load<S>(at), load<S>(at + LANES<S>), load<S>(at + 2 * LANES<S>)};
}
template <class S>
FROND_INLINE void store3(const Lanes3<S>& v, double* to, int i) {
    double* at = to + LANES<S> * size_t(i);
    store(v.x, at), store(v.y, at + LANES<S>), store(v.z, at + 2 * LANES<S>);
}

template <class S>
FROND_INLINE Lanes3<S> operator+(const Lanes3<S>& a, const Lanes3<S>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class S>
FROND_INLINE Lanes3<S> operator-(const Lanes3<S>& a, const Lanes3<S>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class S>
FROND_INLINE Lanes3<S> operator-(const Lanes3<S>& a) {
    return {-a.x, -a.y, -a.z};
}
template <class S>
FROND_INLINE Lanes3<S> operator*(const S& a, const Lanes3<S>& b) {
    return {a * b.x, a * b.y, a * b.z};
}
template <class S>
FROND_INLINE Lanes33<S> operator-(const Lanes33<S>& a, const Lanes33<S>& b) {
    return {{a.r[0] - b.r[0], a.r[1] - b.r[1], a.r[2] - b.r[2]}};
}
template <class S>
FROND_INLINE Lanes33<S> operator+(const Lanes33<S>& a, const Lanes33<S>& b) {
    return {{a.r[0] + b.r[0], a.r[1] + b.r[1], a.r[2] + b.r[2]}};
}
template <class S>
FROND_INLINE Lanes33<S> operator-(const Lanes33<S>& a) {
    return {{-a.r[0], -a.r[1], -a.r[2]}};
}
template <class S>
FROND_INLINE S dot(const Lanes3<S>& a, const Lanes3<S>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class S>
FROND_INLINE Lanes3<S> cross(const Lanes3<S>& a, const Lanes3<S>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// Returns the component-wise product.
template <class S>
FROND_INLINE Lanes3<S> scaled(const Lanes3<S>& a, const Lanes3<S>& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class S>
FROND_INLINE Lanes33<S> scaled_rows(const Lanes3<S>& a, const Lanes33<S>& b) {
    return {{a.x * b.r[0], a.y * b.r[1], a.z * b.r[2]}};
}
template <class S>
FROND_INLINE Lanes33<S> transposed(const Lanes33<S>& a) {
    return {{{a.r[0].x, a.r[1].x, a.r[2].x}, {a.r[0].y, a.r[1].y, a.r[2].y}, {a.r[0].z, a.r[1].z, a.r[2].z}}};
}
template <class S>
FROND_INLINE Lanes3<S> operator*(const Lanes33<S>& a, const Lanes3<S>& b) {
    return {dot(a.r[0], b), dot(a.r[1], b), dot(a.r[2], b)};
}
template <class S>
FROND_INLINE Lanes33<S> operator*(const Lanes33<S>& a, const Lanes33<S>& b) {
    Lanes33<S> out;
    for (int i = 0; i < 3; ++i) out.r[i] = a.r[i].x * b.r[0] + a.r[i].y * b.r[1] + a.r[i].z * b.r[2];
    return out;
}
// Returns a^T b.
template <class S>
FROND_INLINE Lanes3<S> transposed_times(const Lanes33<S>& a, const Lanes3<S>& b) {
    return b.x * a.r[0] + b.y * a.r[1] + b.z * a.r[2];
}
template <class S>
FROND_INLINE Lanes33<S> transposed_times(const Lanes33<S>& a, const Lanes33<S>& b) {
    return transposed(a) * b;
}
template <class S>
FROND_INLINE Lanes33<S> operator*(const S& a, const Lanes33<S>& b) {
    return {{a * b.r[0], a * b.r[1], a * b.r[2]}};
}
// Returns the sum of the component-wise products.
template <class S>
FROND_INLINE S dot(const Lanes33<S>& a, const Lanes33<S>& b) {
    return dot(a.r[0], b.r[0]) + dot(a.r[1], b.r[1]) + dot(a.r[2], b.r[2]);
}
template <class S>
FROND_INLINE S trace(const Lanes33<S>& a) {
    return a.r[0].x + a.r[1].y + a.r[2].z;
}
template <class S>
FROND_INLINE void add_to_diagonal(const S& a, Lanes33<S>& to) {
    to.r[0].x += a, to.r[1].y += a, to.r[2].z += a;
}
// Returns a b^T.
template <class S>
FROND_INLINE Lanes33<S> outer(const Lanes3<S>& a, const Lanes3<S>& b) {
    return {{a.x * b, a.y * b, a.z * b}};
}
// Returns the determinant times the transposed inverse.
template <class S>
FROND_INLINE Lanes33<S> cofactor(const Lanes33<S>& a) {
    return {{cross(a.r[1], a.r[2]), cross(a.r[2], a.r[0]), cross(a.r[0], a.r[1])}};
}
template <class Mask, class S>
FROND_INLINE Lanes3<S> select(const Mask& mask, const Lanes3<S>& yes, const Lanes3<S>& no) {
    return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}
template <class Mask, class S>
FROND_INLINE Lanes33<S> select(const Mask& mask, const Lanes33<S>& yes, const Lanes33<S>& no) {
    return {{select(mask, yes.r[0], no.r[0]), select(mask, yes.r[1], no.r[1]), select(mask, yes.r[2], no.r[2])}};
}
// Returns I + a [v] + b [v]^2, [v] being the cross product matrix.
template <class S>
FROND_INLINE Lanes33<S> turning(const Lanes3<S>& v, const S& a, const S& b) {
    const S bx = b * v.x, by = b * v.y, bz = b * v.z;
    const S xx = bx * v.x, yy = by * v.y, zz = bz * v.z, xy = bx * v.y, xz = bx * v.z, yz = by * v.z;
    const Lanes3<S> w = a * v;
    return {{{1.0 - (yy + zz), xy - w.z, xz + w.y},
             {xy + w.z, 1.0 - (xx + zz), yz - w.x},
             {xz - w.y, yz + w.x, 1.0 - (xx + yy)}}};
}

}  // namespace frond
