// Dense twins of sparse things, for small tests.
#pragma once

#include <Eigen/Dense>

#include "mechanics/block_matrix.hpp"

namespace frond::test {

inline Eigen::MatrixXd dense(const BlockMatrix& A) {
    const BlockPattern& pattern = *A.pattern;
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * pattern.node_count, 3 * pattern.node_count);
    for (int j = 0; j < pattern.node_count; ++j)
        for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; ++k) {
            const int i = pattern.row[size_t(k)];
            out.block<3, 3>(3 * i, 3 * j) = A.block(k);
            if (i != j) out.block<3, 3>(3 * j, 3 * i) = A.block(k).transpose();
        }
    return out;
}

}  // namespace frond::test
