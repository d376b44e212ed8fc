// Dense copies of sparse matrices, for small tests; compiled once, since Eigen's decompositions take long to compile.
#pragma once

#include "mechanics/block_matrix.hpp"

namespace frond::test {

Eigen::MatrixXd dense(const BlockMatrix& A);
// Returns the eigenvalues of a symmetric matrix, in ascending order.
VecX eigenvalues_of(const Eigen::MatrixXd& A);
// Solutions of K v = value M v; shapes are columns, normalised to unit mass.
struct Modes {
    VecX values;
    Eigen::MatrixXd shapes;
};
Modes modes_of(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M);
VecX solve_dense(const Eigen::MatrixXd& A, const VecX& b);
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& A);

}  // namespace frond::test
