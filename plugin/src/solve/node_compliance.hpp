// NodeCompliance: a plant's velocities by impulses at a few of its nodes, after a step.
#pragma once

#include "core/types.hpp"

namespace frond {

// A node's block of a matrix with three columns, one for each direction of an impulse.
struct NodeBlock {
    int node;
    Mat3 block;
};

// Columns of three numbers and a zero, which fill the lanes of a register.
using Columns3 = Eigen::Matrix4Xd;

// With A the matrix of the step and B, C blocks of a few nodes: the velocity at C by impulses at B, C' A^-1 B, is the
// sum of left(C) times right(B) over the rows that both have. If the solver has a factor, rows are the factor's, and
// there are few; else left has the nodes' own rows, and right has all rows.
struct NodeCompliance {
    std::vector<int> rows;  // row of each column of `left`, ascending
    Columns3 left, right;   // transposed, one column a row [1/sqrt kg] or [1] and [1/kg]
};

// Adds to blocks[i] the velocity at at[i] by an impulse at `by` [1/kg]. All are of one plant. `spread` is scratch, all
// zero between calls.
void add_compliances(const std::vector<const NodeCompliance*>& at, const NodeCompliance& by, Columns3& spread,
                     std::vector<Mat3>& blocks);

}  // namespace frond
