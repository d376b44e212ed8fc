// Fronts: factors L D L^T of a matrix of 3x3 blocks, by dense fronts (Duff, Reid 1983, "The multifrontal solution of
// indefinite sparse symmetric linear equations").
#pragma once

#include "core/lines.hpp"
#include "mechanics/block_matrix.hpp"
#include "solve/node_compliance.hpp"

namespace frond {

// A front is a dense matrix of the nodes that it eliminates and of those whose rows this changes. The rest of it, its
// update, is added to the front of its parent, which comes later.
struct Front {
    int first, own;          // its nodes are at places first .. first + own - 1 in elimination order
    int row, rows;           // further rows: places FrontPlan::rows[row .. row + rows - 1]
    int parent;              // -1: none
    int child, children;     // FrontPlan::children[child .. child + children - 1]
    int entry, entries;      // FrontPlan::entries[entry .. entry + entries - 1]
    size_t columns, update;  // offsets of its columns in FrontFactor, and of its update in factorize()'s scratch
};

// Shared by all matrices of a pattern.
struct FrontPlan {
    // A block of the matrix, which is stored by columns, and the offset of its first number in a front's columns.
    struct Entry {
        int slot, to;
        bool is_turned;
    };
    // A row of an update: its node in the parent's front, and the count of rows from here on that are consecutive.
    struct Landing {
        int to, count;
    };
    std::vector<int> order, place;  // nodes in elimination order, and the place of each
    std::vector<Front> fronts;      // children before parents
    std::vector<int> rows;          // ascending in each front
    std::vector<Landing> landings;  // one a row
    std::vector<int> children;
    std::vector<Entry> entries;
    std::vector<int> front_of;  // front of each place
    // Sizes of all columns, of the updates at a time, of the largest front's columns and of the longest column.
    size_t column_size = 0, update_size = 0, largest = 0, longest = 0;
};
FrontPlan make_front_plan(const BlockPattern& pattern);

// Length of a front's column: its own rows, then the further ones, both padded with zeros to a multiple of four.
inline int padded(int nodes) {
    return (3 * nodes + 3) / 4 * 4;
}
inline int stride_of(const Front& front) {
    return padded(front.own) + padded(front.rows);
}

// Factors of one matrix, or of several of one pattern, one a lane; each the same to the last bit as alone.
struct FrontFactor {
    int lanes = 1;
    NumbersInLines columns;         // L below its unit diagonal, zero in the four rows above; each number once a lane
    NumbersInLines pivot, inverse;  // D and 1/D, in elimination order
    NumbersInLines ordered, front;  // scratch of solves: the whole vector, and one front's rows
    Columns3 sparse;                // scratch of half-solves; zero between them
    std::vector<uint8_t> reached;
};

// Returns a bit for each lane of which a pivot is not above zero: A is not positive definite.
unsigned factorize(const FrontPlan& plan, const BlockMatrix& A, FrontFactor& factor);
// Turns right-hand sides into solutions of A x = b with the matrices factorized last.
void solve(const FrontPlan& plan, FrontFactor& factor, double* x);
// Copies each lane's factor to its own place in `out`, if it has one.
void take_apart(const FrontFactor& factor, FrontFactor* const* out);
// See half_solve() in block_factor.hpp; of one matrix only.
void half_solve(const FrontPlan& plan, FrontFactor& factor, const std::vector<NodeBlock>& right_side,
                NodeCompliance& compliance);

}  // namespace frond
