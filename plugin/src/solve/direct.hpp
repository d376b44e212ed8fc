// Direct: the factor of one matrix by Eigen's simplicial LDLT; the symbolic part is done once.
#pragma once

#include <memory>

#include "mechanics/block_matrix.hpp"

namespace frond {

struct DirectFactor;
struct DirectFactorDeleter {
    void operator()(DirectFactor* factor) const;
};
using DirectFactorPtr = std::unique_ptr<DirectFactor, DirectFactorDeleter>;
DirectFactorPtr make_direct_factor(const BlockPattern& pattern);
// Returns false if a pivot is not above zero: A is not positive definite.
bool factorize(DirectFactor& factor, const BlockMatrix& A);
// Computes x = A^-1 b with the matrix factorized last.
void solve(DirectFactor& factor, const VecX& b, VecX& x);
// Returns the count of numbers below the diagonal of the factor.
int64_t fill_of(const DirectFactor& factor);

}  // namespace frond
