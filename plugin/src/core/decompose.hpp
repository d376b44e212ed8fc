// Decompose: small matrices by their principal axes, and the turn between two directions. Eigen's decompositions take
// seconds to compile, so they are compiled here, once.
#pragma once

#include "core/types.hpp"

namespace frond {

// A = vectors diag(values) vectors^T of a symmetric A; values ascend, vectors are columns.
struct SymmetricParts {
    Vec3 values;
    Mat3 vectors;
};
SymmetricParts symmetric_parts(const Mat3& A);
// The values alone.
Vec3 symmetric_values(const Mat3& A);
// By a closed form, quicker and with fewer digits (Eigen's computeDirect).
Vec3 symmetric_values_direct(const Mat3& A);

// The same in the plane.
struct SymmetricParts2 {
    Eigen::Vector2d values;
    Eigen::Matrix2d vectors;
};
SymmetricParts2 symmetric_parts_2(const Eigen::Matrix2d& A);

// A = U diag(values) V^T, values descend; U and V may mirror.
struct SingularParts {
    Mat3 U;
    Vec3 values;
    Mat3 V;
};
SingularParts singular_parts(const Mat3& A);

// The shortest turn that takes one direction to another; opposite ones are half a turn apart, about any axis across.
// Lengths do not matter.
Quat turn_between(const Vec3& from, const Vec3& to);

}  // namespace frond
