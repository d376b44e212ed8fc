// Answer: how a plant's velocities answer to impulses at a few of its nodes, after a step.
#pragma once

#include "core/types.hpp"

namespace frond {

// Of a matrix with three columns, one for each direction of an impulse.
struct NodeBlock {
    int node;
    Mat3 block;
};

// With pushes B, B a few nodes' blocks, and A the matrix of the step: the velocity at C by impulses at B, C' A^-1 B, is
// the sum of left(C) times right(B) over the rows that both have. Where the solver has a factor, a row is one of its
// own, and there are few; else left has the nodes' own rows, and right has all rows.
struct NodeCompliance {
    std::vector<int> rows;         // of `left`, ascending
    Eigen::Matrix3Xd left, right;  // transposed, a column a row [1/sqrt kg] or [1] and [1/kg]
};

// Adds to blocks[i] the velocity at answer i by an impulse at `by` [1/kg]. All are of one plant. `spread` is memory,
// all zero between calls.
void add_compliances(const std::vector<const NodeCompliance*>& at, const NodeCompliance& by, Eigen::Matrix3Xd& spread,
                     std::vector<Mat3>& blocks);

}  // namespace frond
