// Stiffness of linear elasticity in a frame turned by R (warped stiffness, R K0 R^T), never negative.
#pragma once

#include "mechanics/tet_element.hpp"

namespace frond {

inline TetStiffness warped_stiffness(const TetShare& tet, const Mat3& R, double scale) {
    const Mat3& B = tet.rest_inverse;
    const double mu = scale * tet.volume * tet.mu, lambda = scale * tet.volume * tet.lambda;
    const Mat3 G = R * B.transpose();  // columns: the rest gradients, turned
    const auto block = [&](int a, int b) {
        Mat3 k = G.col(a) * (lambda * G.col(b)).transpose() + G.col(b) * (mu * G.col(a)).transpose();
        k.diagonal().array() += mu * B.row(a).dot(B.row(b));
        return k;
    };
    return {block(0, 0), block(1, 0), block(2, 0), block(1, 1), block(2, 1), block(2, 2)};
}

}  // namespace frond
