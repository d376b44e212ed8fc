// TreeFactor: factors L D L^T of a matrix over pairs of nodes connected as a tree, as in a chain.
#pragma once

#include <optional>

#include "mechanics/block_matrix.hpp"
#include "solve/node_compliance.hpp"

namespace frond {

// Slots of such a tree's blocks in a BlockMatrix. Pair i is the nodes 2i and 2i+1; parents come before children.
struct TreePlan {
    struct Pair {
        int parent;               // parent pair; -1: a root
        std::array<int, 3> own;   // slots of the blocks (0, 0), (1, 0), (1, 1); -1: zero
        std::array<int, 4> link;  // slots of its nodes (rows) with its parent's, by columns; -1: zero
    };
    std::vector<Pair> pairs;
};
// Makes the plan; none if the pattern is no such tree.
std::optional<TreePlan> make_tree_plan(const BlockPattern& pattern);

constexpr int SIX = 6;  // numbers of a pair

// Pairs are eliminated from the last to the first; a row of the factor is one of a pair's six numbers, in that order.
struct TreeFactor {
    // Row by row: a pair's own L', zero up to its unit diagonal, L' to its parent, and D.
    struct Pair {
        double own[6][6], to_parent[6][6];
        double pivot[6], inverse[6];
    };
    std::vector<Pair> pairs;
    std::vector<uint8_t> reached;  // scratch of half-solves; zero between them
    Eigen::Matrix3Xd sparse;       // likewise
};

// Returns false if a pivot is not above zero: A is not positive definite.
bool factorize(const TreePlan& plan, const BlockMatrix& A, TreeFactor& factor);
// Computes x = A^-1 b with the matrix factorized last.
void solve(const TreePlan& plan, const TreeFactor& factor, const VecX& b, VecX& x);
// See half_solve() in block_factor.hpp.
void half_solve(const TreePlan& plan, TreeFactor& factor, const std::vector<NodeBlock>& right_side,
                NodeCompliance& compliance);

}  // namespace frond
