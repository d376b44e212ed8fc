// Checks which patterns are trees of node pairs.
#include "solve/tree_factor.hpp"

#include <gtest/gtest.h>

#include "mechanics/mechanics.hpp"
#include "solve/block_factor.hpp"
#include "support/meshes.hpp"

namespace frond::test {
namespace tree_factor_tests {

TEST(TreeFactor, IsForTreesOnly) {
    EXPECT_FALSE(make_tree_plan(make_block_pattern(0, std::vector<Tet>{})));
    EXPECT_FALSE(make_tree_plan(make_block_pattern(3, std::vector<Tet>{{0, 1, 2, 2}})));
    // A ring of three pairs.
    const std::vector<Tet> ring = {{0, 1, 2, 3}, {2, 3, 4, 5}, {0, 1, 4, 5}};
    EXPECT_FALSE(make_tree_plan(make_block_pattern(6, ring)));
    EXPECT_TRUE(make_tree_plan(make_block_pattern(6, std::vector<Tet>(ring.begin(), ring.begin() + 2))));
    EXPECT_FALSE(make_block_plan(make_tet_elements(tree_model(6, 5, 3)).pattern).tree);
}

}  // namespace tree_factor_tests

}  // namespace frond::test
