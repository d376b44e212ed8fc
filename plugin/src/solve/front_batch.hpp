// FrontBatch: factors of the matrices of several plants abreast, of the pattern of one plan (fronts.hpp), to the last
// bit as of each alone.
#pragma once

#include "solve/fronts.hpp"

namespace frond {

struct FrontBatch {
    int lanes = 0;
    // As in FrontFactor, where columns hold anything above the four rows of their diagonal.
    NumbersInLines columns, pivot, inverse;
    NumbersInLines ordered, front;
};

// Returns the lanes whose matrix is not positive definite, a bit each.
unsigned factorize(const FrontPlan& plan, const BlockMatrix& A, FrontBatch& factor);
// x = A^-1 b
void solve(const FrontPlan& plan, FrontBatch& factor, const NumbersInLines& b, NumbersInLines& x);
// Of lanes that have a place to go to, each one's own.
void take_apart(const FrontBatch& factor, FrontFactor* const* out);

}  // namespace frond
