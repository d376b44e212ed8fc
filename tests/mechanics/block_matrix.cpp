// The matrix of 3x3 blocks, compared with a dense copy.
#include "mechanics/block_matrix.hpp"

#include <gtest/gtest.h>

#include "mechanics/mechanics.hpp"
#include "support/dense.hpp"
#include "support/meshes.hpp"

namespace frond::test {
namespace block_matrix_tests {

TEST(BlockMatrix, HasABlockForExactlyThePairsThatShareATet) {
    const Model model = tree_model(4, 3, 2);
    const TetElements elements = make_tet_elements(model);
    for (int i = 0; i < elements.node_count; ++i)
        for (int j = 0; j < elements.node_count; ++j) {
            bool together = i == j;
            for (const Tet& tet : model.cage.tets)
                together |= std::count(tet.begin(), tet.end(), i) && std::count(tet.begin(), tet.end(), j);
            const int slot = elements.pattern.slot(i, j);
            ASSERT_EQ(slot >= 0, together) << i << " " << j;
            EXPECT_EQ(slot, elements.pattern.slot(j, i));
            if (!together) continue;
            EXPECT_EQ(elements.pattern.row[size_t(slot)], std::max(i, j));
        }
}

TEST(BlockMatrix, MultipliesAsItsDenseTwin) {
    const TetElements elements = make_tet_elements(box_model(2, 2, 3, {1, 1, 1}));
    Dice dice(1);
    BlockMatrix A;
    A.set_pattern(elements.pattern);
    for (double& value : A.values) value = dice.uniform(-1, 1);
    for (int j = 0; j < elements.node_count; ++j) {
        auto diagonal = A.block(elements.pattern.start[size_t(j)]);
        diagonal = (diagonal + diagonal.transpose()).eval();
    }
    const VecX x = dice.vector(3 * elements.node_count, 1);
    VecX y;
    A.multiply(x, y);
    EXPECT_NEAR((y - dense(A) * x).norm(), 0, 1e-12);
}

}  // namespace block_matrix_tests

}  // namespace frond::test
