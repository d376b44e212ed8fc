// The rotation nearest to a deformation gradient.
#pragma once

#include "core/types.hpp"

namespace frond {

// The proper rotation R that maximises the trace of R^T F; where F is turned inside out, S = R^T F then has its
// smallest value negative. Where several are nearest, one of them. Not a number in, not a number out.
struct Polar {
    Mat3 rotation;
    double trace;        // of S = R^T F
    double gaps;         // (s1+s2)(s1+s3)(s2+s3) of the values of S: how far from where the rotation is not unique
    double determinant;  // of F; negative when turned inside out
};
Polar polar_decomposition(const Mat3& F);
// Slow, and right also where F is turned inside out so far that the rotation is about to jump, or flattened to a line.
Polar polar_by_values(const Mat3& F);

}  // namespace frond
