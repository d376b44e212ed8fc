// Dense twins of sparse things, for small tests; compiled once, since Eigen's decompositions take long.
#pragma once

#include "mechanics/block_matrix.hpp"

namespace frond::test {

Eigen::MatrixXd dense(const BlockMatrix& A);
// Of a symmetric matrix, in ascending order.
VecX eigenvalues_of(const Eigen::MatrixXd& A);
// K v = value M v; shapes are columns, of unit mass.
struct Modes {
    VecX values;
    Eigen::MatrixXd shapes;
};
Modes modes_of(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M);
VecX solve_dense(const Eigen::MatrixXd& A, const VecX& b);
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& A);

}  // namespace frond::test
