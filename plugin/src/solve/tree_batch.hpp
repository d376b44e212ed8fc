// TreeBatch: factors of the matrices of several plants abreast, of the pattern of one tree (tree_factor.hpp), to the
// last bit as of each alone.
#pragma once

#include "solve/tree_factor.hpp"

namespace frond {

struct TreeBatch {
    int lanes = 0;
    NumbersInLines numbers;      // of a pair: L' of its own, row by row, L' to its parent, and 1 / D
    std::vector<uint8_t> begun;  // room
};

// Returns the lanes whose matrix is not positive definite, a bit each.
unsigned factorize(const TreePlan& plan, const BlockMatrix& A, TreeBatch& factor);
// x = A^-1 b
void solve(const TreePlan& plan, const TreeBatch& factor, const NumbersInLines& b, NumbersInLines& x);
// |b - A x| / |b| of each lane; `left` is room.
void relative_residuals(const BlockMatrix& A, const NumbersInLines& b, const NumbersInLines& x, NumbersInLines& left,
                        double* out);

}  // namespace frond
