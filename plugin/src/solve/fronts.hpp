// Fronts: factors L D L^T of a matrix of 3x3 blocks, dense piece by dense piece (Duff, Reid 1983, "The multifrontal
// solution of indefinite sparse symmetric linear equations").
#pragma once

#include "core/lanes.hpp"
#include "mechanics/block_matrix.hpp"
#include "solve/node_compliance.hpp"

namespace frond {

// A front is a dense matrix: the nodes that it eliminates, and those whose rows that changes. What is left of it then,
// its update, is added to the front of its parent, which comes later.
struct Front {
    int first, own;          // its nodes are those at places first .. first + own - 1 in the order of elimination
    int row, rows;           // further rows: places FrontPlan::rows[row .. row + rows - 1]
    int parent;              // -1: none
    int child, children;     // FrontPlan::children[child .. child + children - 1]
    int entry, entries;      // FrontPlan::entries[entry .. entry + entries - 1]
    size_t columns, update;  // where its columns are in FrontFactor, and its update in the memory of factorize()
};

// Shared by all matrices of a pattern.
struct FrontPlan {
    // A block of the matrix, which is stored by columns, and where its first number is among a front's columns.
    struct Entry {
        int slot, to;
        bool is_turned;
    };
    // A row of an update: its node in the parent's front, and how many rows from here on follow each other there.
    struct Landing {
        int to, count;
    };
    std::vector<int> order, place;  // nodes in the order of elimination, and the place of each
    std::vector<Front> fronts;      // children before parents
    std::vector<int> rows;          // ascending in each front
    std::vector<Landing> landings;  // one a row
    std::vector<int> children;
    std::vector<Entry> entries;
    std::vector<int> front_of;  // one a place
    // Numbers of all columns, of the updates at a time, of the largest front's columns and of the longest one.
    size_t column_size = 0, update_size = 0, largest = 0, longest = 0;
};
FrontPlan make_front_plan(const BlockPattern& pattern);

// Numbers of a column of a front: its own rows, then the further ones, both filled up with zeros to a multiple of four.
inline int padded(int nodes) {
    return (3 * nodes + 3) / 4 * 4;
}
inline int stride_of(const Front& front) {
    return padded(front.own) + padded(front.rows);
}

// The numbers of quads one after the other.
inline double* numbers_of(std::vector<Quad>& quads) {
    return reinterpret_cast<double*>(quads.data());
}
inline const double* numbers_of(const std::vector<Quad>& quads) {
    return reinterpret_cast<const double*>(quads.data());
}

struct FrontFactor {
    std::vector<Quad> columns;  // L below its diagonal of ones, zero elsewhere
    VecX pivot, inverse;        // D and 1/D, in the order of elimination
    VecX ordered, front;        // of solves: the whole, and the rows of one front
    Eigen::Matrix3Xd sparse;    // of half solves; between them all zero
    std::vector<uint8_t> reached;
};

// False if a pivot is not above zero: A is not positive definite.
bool factorize(const FrontPlan& plan, const BlockMatrix& A, FrontFactor& factor);
// x = A^-1 b with the matrix factorized last.
void solve(const FrontPlan& plan, FrontFactor& factor, const VecX& b, VecX& x);
// As half_solve() in block_factor.hpp.
void half_solve(const FrontPlan& plan, FrontFactor& factor, const std::vector<NodeBlock>& right_side,
                NodeCompliance& compliance);

}  // namespace frond
