#include "support/dense.hpp"

#include <Eigen/Dense>

namespace frond::test {

Eigen::MatrixXd dense(const BlockMatrix& A) {
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

VecX eigenvalues_of(const Eigen::MatrixXd& A) {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues();
}

Modes modes_of(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(K, M);
    return {modes.eigenvalues(), modes.eigenvectors()};
}

VecX solve_dense(const Eigen::MatrixXd& A, const VecX& b) {
    return A.partialPivLu().solve(b);
}

Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& A) {
    return A.inverse();
}

}  // namespace frond::test
