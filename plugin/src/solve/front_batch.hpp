// FrontBatch: factors of a batch of matrices with the pattern of one plan (fronts.hpp), each the same to the last bit
// as alone.
#pragma once

#include "solve/fronts.hpp"

namespace frond {

struct FrontBatch {
    int lanes = 0;
    // See FrontFactor; but numbers of a column above the four rows of its diagonal are arbitrary.
    NumbersInLines columns, pivot, inverse;
    NumbersInLines ordered, front;
};

// Returns a bit for each lane whose matrix is not positive definite.
unsigned factorize(const FrontPlan& plan, const BlockMatrix& A, FrontBatch& factor);
// Computes x = A^-1 b.
void solve(const FrontPlan& plan, FrontBatch& factor, const NumbersInLines& b, NumbersInLines& x);
// Copies each lane's factor to its own place in `out`, if it has one.
void take_apart(const FrontBatch& factor, FrontFactor* const* out);

}  // namespace frond
