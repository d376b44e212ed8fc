// BlockMatrix: a symmetric sparse matrix of 3x3 blocks, one for each pair of nodes that share an element.
#pragma once

#include <memory>

#include "core/lines.hpp"
#include "core/types.hpp"

namespace frond {

// Lower triangle by columns of nodes: rows of column j are row[start[j]] .. row[start[j+1]-1], the diagonal first.
struct BlockPattern {
    int node_count = 0;
    std::vector<int> start, row;
    int slot(int i, int j) const;  // index of the block of nodes i and j (either order); -1 if they share no element
    int block_count() const { return int(row.size()); }
};

// Makes the pattern with a diagonal block for each node and a block for each two nodes that share an element. Elements
// are arrays of four or of ten nodes.
template <size_t N>
BlockPattern make_block_pattern(int node_count, const std::vector<std::array<int, N>>& elements);
extern template BlockPattern make_block_pattern(int, const std::vector<std::array<int, 4>>&);
extern template BlockPattern make_block_pattern(int, const std::vector<std::array<int, 10>>&);

struct BlockMatrix {
    const BlockPattern* pattern = nullptr;
    NumbersInLines values;  // 9 a block, column-major; block (i, j) of the lower triangle, i >= j
    // Returns how many matrices these are: a batch has each value once a lane.
    int lanes() const { return int(values.size() / (9 * size_t(pattern->block_count()))); }
    // Sets the pattern and resizes the values; allocates only the first time.
    void set_pattern(const BlockPattern& new_pattern);
    void set_zero();
    Eigen::Map<Mat3> block(int slot) { return Eigen::Map<Mat3>(values.data() + 9 * size_t(slot)); }
    Eigen::Map<const Mat3> block(int slot) const { return Eigen::Map<const Mat3>(values.data() + 9 * size_t(slot)); }
    // Computes y = A x.
    void multiply(const VecX& x, VecX& y) const;
};

}  // namespace frond
