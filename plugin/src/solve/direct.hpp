// Direct solver: an elimination order found once for a pattern, and a factor that is filled anew for each matrix.
#pragma once

#include <memory>

#include "mechanics/block_matrix.hpp"
#include "solve/answer.hpp"
#include "solve/tree_factor.hpp"

namespace frond {

// Shared by all matrices of a pattern.
struct DirectPlan {
    std::optional<TreePlan> tree;  // where the pattern is one, a solver of its own needs nothing of what follows
    std::vector<int> order;  // nodes, in the order in which they are eliminated
    std::vector<int> place;  // of each node in that order
    std::vector<int> start, row,
        source;  // upper triangle of the ordered matrix by columns; value k is values[source[k]]
};
DirectPlan make_direct_plan(const BlockPattern& pattern);

// Room for the factor of one matrix, with its symbolic part done.
struct DirectFactor;
struct DirectFactorDeleter {
    void operator()(DirectFactor* factor) const;
};
using DirectFactorPtr = std::unique_ptr<DirectFactor, DirectFactorDeleter>;
DirectFactorPtr make_direct_factor(const DirectPlan& plan);  // the plan must live longer
// False if a pivot is not above zero: A is not positive definite.
bool factorize(DirectFactor& factor, const BlockMatrix& A);
// x = A^-1 b with the matrix factorized last.
void solve(DirectFactor& factor, const VecX& b, VecX& x);
// Half of a solve: with A = P' L D L' P and a right side B of few nodes, L^-1 P B where it is not zero, and that over D.
void half_solve(DirectFactor& factor, const std::vector<NodeBlock>& right_side, Answer& answer);
// Numbers below the diagonal of the factor.
int64_t fill_of(const DirectFactor& factor);

}  // namespace frond
