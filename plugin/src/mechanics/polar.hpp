// The rotation nearest to a deformation gradient.
#pragma once

#include "core/types.hpp"

namespace frond {

// The proper rotation R that maximises the trace of R^T F; if F is inverted, the smallest value of S = R^T F is
// negative. If several rotations are nearest, it is any of them. NaN in, NaN out.
struct Polar {
    Mat3 rotation;
    double trace;        // trace of S = R^T F
    double gaps;         // (s1+s2)(s1+s3)(s2+s3) of the values of S; 0 where the rotation is not unique
    double determinant;  // determinant of F; negative when inverted
};
Polar polar_decomposition(const Mat3& F);
// Slow, but correct also where F is inverted so far that the rotation is about to jump, or flattened to a line.
Polar polar_by_values(const Mat3& F);

}  // namespace frond
