// TreeFactor: factors L D L^T of a matrix whose nodes are pairs that hang together as a tree, as those of a chain do.
#pragma once

#include <optional>

#include "mechanics/block_matrix.hpp"
#include "solve/node_compliance.hpp"

namespace frond {

// Where a BlockMatrix has the blocks of such a tree. Pair i is the nodes 2i and 2i+1; parents come before children.
struct TreePlan {
    struct Pair {
        int parent;               // pair; -1: a root
        std::array<int, 3> own;   // slots of the blocks (0, 0), (1, 0), (1, 1); -1: zero
        std::array<int, 4> link;  // of its nodes (rows) with its parent's, by columns; -1: zero
    };
    std::vector<Pair> pairs;
};
// None if the pattern is no such tree.
std::optional<TreePlan> make_tree_plan(const BlockPattern& pattern);

constexpr int SIX = 6;  // numbers of a pair

// Pairs are eliminated from the last one to the first; a row of the factor is one of a pair's six numbers, in that
// order.
struct TreeFactor {
    // Row by row: L' of a pair's own six numbers, zero up to its diagonal of ones, L' to its parent, and D.
    struct Pair {
        double own[6][6], to_parent[6][6];
        double pivot[6], inverse[6];
    };
    std::vector<Pair> pairs;
    std::vector<uint8_t> reached;  // of half solves; between them none is
    Eigen::Matrix3Xd sparse;       // likewise, all zero
};

// False if a pivot is not above zero: A is not positive definite.
bool factorize(const TreePlan& plan, const BlockMatrix& A, TreeFactor& factor);
// x = A^-1 b with the matrix factorized last.
void solve(const TreePlan& plan, const TreeFactor& factor, const VecX& b, VecX& x);
// As half_solve() in block_factor.hpp.
void half_solve(const TreePlan& plan, TreeFactor& factor, const std::vector<NodeBlock>& right_side,
                NodeCompliance& compliance);

}  // namespace frond
