// BlockMatrix: a symmetric sparse matrix of 3x3 blocks, one for each pair of nodes that share an element.
#pragma once

#include <memory>

#include "core/types.hpp"

namespace frond {

// Lower triangle by columns of nodes: rows of column j are row[start[j]] .. row[start[j+1]-1], the diagonal first.
struct BlockPattern {
    int node_count = 0;
    std::vector<int> start, row;
    int slot(int i, int j) const;  // of the block of nodes i and j (either order); -1 if they share no element
};

struct BlockMatrix {
    const BlockPattern* pattern = nullptr;
    std::vector<double> values;  // 9 a block, column-major; block (i, j) of the lower triangle, i >= j
    void set_zero();
    // y = A x
    void multiply(const VecX& x, VecX& y) const;
};

}  // namespace frond
