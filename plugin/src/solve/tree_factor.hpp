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

// Factors of one matrix, or of several of one pattern, one a lane; each the same to the last bit as alone. Pairs are
// eliminated from the last to the first; a row of the factor is one of a pair's six numbers, in that order.
struct TreeFactor {
    // Offsets and count of a pair's numbers: its own L', row by row, zero up to its unit diagonal; L' to its parent;
    // and 1 / D.
    static constexpr int OWN = 0, TO_PARENT = SIX * SIX, INVERSE = 2 * SIX * SIX, NUMBERS = INVERSE + SIX;
    int lanes = 1;
    NumbersInLines numbers;        // of each pair, each once a lane
    VecX pivot;                    // D, of one matrix only
    std::vector<uint8_t> begun;    // scratch: one a pair, whether a child was eliminated
    std::vector<uint8_t> reached;  // scratch of half-solves; zero between them
    Columns3 sparse;               // likewise
};

// Returns a bit for each lane of which a pivot is not above zero: A is not positive definite.
unsigned factorize(const TreePlan& plan, const BlockMatrix& A, TreeFactor& factor);
// Turns right-hand sides into solutions of A x = b with the matrices factorized last.
void solve(const TreePlan& plan, const TreeFactor& factor, double* x);
// See half_solve() in block_factor.hpp; of one matrix only.
void half_solve(const TreePlan& plan, TreeFactor& factor, const std::vector<NodeBlock>& right_side,
                NodeCompliance& compliance);

}  // namespace frond
