// TreeBatch: factors of a batch of matrices with the pattern of one tree (tree_factor.hpp), each the same to the last
// bit as alone.
#pragma once

#include "solve/tree_factor.hpp"

namespace frond {

struct TreeBatch {
    int lanes = 0;
    NumbersInLines numbers;      // for each pair: its own L', row by row, L' to its parent, and 1 / D
    std::vector<uint8_t> begun;  // scratch
};

// Returns a bit for each lane whose matrix is not positive definite.
unsigned factorize(const TreePlan& plan, const BlockMatrix& A, TreeBatch& factor);
// Computes x = A^-1 b.
void solve(const TreePlan& plan, const TreeBatch& factor, const NumbersInLines& b, NumbersInLines& x);
// Computes |b - A x| / |b| of each lane; `left` is scratch.
void relative_residuals(const BlockMatrix& A, const NumbersInLines& b, const NumbersInLines& x, NumbersInLines& left,
                        double* out);

}  // namespace frond
