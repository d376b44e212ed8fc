// One tet with straight edges: gradient of its deformation, force and stiffness to its nodes. Shared by the tet
// mechanics.
#pragma once

#include "mechanics/mechanics.hpp"

namespace frond {

// What every row of the tets is given.
inline const TetElements& as_tets(const Elements& elements) {
    return static_cast<const TetElements&>(elements);
}

// Gradient of deformation F = sum over nodes of x b^T, with b the rest gradients of the shape functions.
inline Mat3 deformation_gradient(const TetElements& elements, size_t e, const VecX& x) {
    const Tet& tet = elements.ordered[e];
    const Vec3 x0 = point(x, tet[0]);
    Mat3 edges;
    for (int a = 0; a < 3; ++a) edges.col(a) = point(x, tet[size_t(a) + 1]) - x0;
    return edges * elements.rest_inverse[e];
}

// Adds the nodes' forces -V P b for the stress P (first Piola-Kirchhoff); they add up to nothing.
inline void scatter_force(const TetElements& elements, size_t e, const Mat3& P, VecX& f) {
    const Tet& tet = elements.ordered[e];
    const Mat3 forces = P * elements.rest_inverse[e].transpose() * elements.volume[e];
    for (int a = 0; a < 3; ++a) point(f, tet[size_t(a) + 1]) -= forces.col(a);
    point(f, tet[0]) += forces.col(0) + forces.col(1) + forces.col(2);
}

// Stiffness between nodes 1, 2, 3 of a tet; node 0 follows, since moving all nodes alike gives no force.
struct TetStiffness {
    Mat3 k11, k21, k31, k22, k32, k33;
};

inline void scatter_stiffness(const TetElements& elements, size_t e, const TetStiffness& k, BlockMatrix& K) {
    const std::array<int, 16>& slot = elements.slots[e];
    const Mat3 k10 = -(k.k11 + k.k21.transpose() + k.k31.transpose());
    const Mat3 k20 = -(k.k21 + k.k22 + k.k32.transpose());
    const Mat3 k30 = -(k.k31 + k.k32 + k.k33);
    K.block(slot[0]) -= k10 + k20 + k30;
    K.block(slot[4]) += k10;
    K.block(slot[8]) += k20;
    K.block(slot[12]) += k30;
    K.block(slot[5]) += k.k11;
    K.block(slot[9]) += k.k21;
    K.block(slot[13]) += k.k31;
    K.block(slot[10]) += k.k22;
    K.block(slot[14]) += k.k32;
    K.block(slot[15]) += k.k33;
}

// Stiffness of linear elasticity in a frame turned by R (warped stiffness, R K0 R^T), never negative.
inline TetStiffness warped_stiffness(const TetElements& elements, size_t e, const Mat3& R, double scale) {
    const Mat3& B = elements.rest_inverse[e];
    const double mu = scale * elements.volume[e] * elements.mu[e];
    const double lambda = scale * elements.volume[e] * elements.lambda[e];
    const Mat3 G = R * B.transpose();  // columns: the rest gradients, turned
    const auto block = [&](int a, int b) {
        Mat3 k = G.col(a) * (lambda * G.col(b)).transpose() + G.col(b) * (mu * G.col(a)).transpose();
        k.diagonal().array() += mu * B.row(a).dot(B.row(b));
        return k;
    };
    return {block(0, 0), block(1, 0), block(2, 0), block(1, 1), block(2, 1), block(2, 2)};
}

}  // namespace frond
