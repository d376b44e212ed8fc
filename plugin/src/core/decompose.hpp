// Decompose: eigen- and singular value decompositions of small matrices, and the rotation between two directions.
// Eigen's decompositions take seconds to compile, so they are compiled here, once.
#pragma once

#include "core/types.hpp"

namespace frond {

// Eigendecomposition of a symmetric A = vectors diag(values) vectors^T; values ascend, eigenvectors are columns.
struct SymmetricParts {
    Vec3 values;
    Mat3 vectors;
};
SymmetricParts symmetric_parts(const Mat3& A);
// Returns the eigenvalues alone.
Vec3 symmetric_values(const Mat3& A);
// Returns the largest eigenvalue by a closed form, faster and with fewer digits: Smith, "Eigenvalues of a symmetric 3x3
// matrix", 1961.
double largest_symmetric_value(const Mat3& A);

// The same for 2x2 matrices.
struct SymmetricParts2 {
    Eigen::Vector2d values;
    Eigen::Matrix2d vectors;
};
SymmetricParts2 symmetric_parts_2(const Eigen::Matrix2d& A);

// Singular value decomposition A = U diag(values) V^T; values descend, U and V may be reflections.
struct SingularParts {
    Mat3 U;
    Vec3 values;
    Mat3 V;
};
SingularParts singular_parts(const Mat3& A);

// Returns the shortest rotation that takes one direction to another, about any perpendicular axis if they are opposite.
// Lengths do not matter.
Quat turn_between(const Vec3& from, const Vec3& to);

}  // namespace frond
