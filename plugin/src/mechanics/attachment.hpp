// Grip: a point of a plant that follows the nodes of its mechanics, as sums of weight times place, and where nodes turn
// (the chain's) of arms that turn with them.
#pragma once

#include "core/types.hpp"
#include "mechanics/block_matrix.hpp"
#include "mechanics/tet_nodes.hpp"

namespace frond {

struct Attachment {
    static constexpr int MOST = 10;                          // a quadratic tet's nodes
    int count = 0;                                           // of nodes
    bool turns = false;                                      // the node after each is its rotation vector
    std::array<int, MOST> node = {};                         // of the mechanics
    std::array<double, MOST> weight = {};                    // [-]
    std::array<Vec3, 2> arm = {Vec3::Zero(), Vec3::Zero()};  // of the first two nodes, in the modelled shape [m]
};

Attachment tet_attachment(const TetPlace& place);
bool is_sound(const Attachment& attachment, int node_count);
// The point's derivative by each node of the mechanics, of places or of rotation vectors.
struct AttachmentDerivative {
    int count = 0;
    std::array<int, Attachment::MOST> node;
    std::array<Mat3, Attachment::MOST> by;
};
AttachmentDerivative derivative_at(const Attachment& attachment, const VecX& x);
Vec3 attachment_place(const Attachment& attachment, const VecX& x);
Vec3 attachment_velocity(const Attachment& attachment, const VecX& x, const VecX& v);
// Distributes a force at the point [N] over the nodes.
void add_attachment_force(const Attachment& attachment, const VecX& x, const Vec3& force, VecX& f);
// Adds J^T B J, J the derivative of the point by the nodes at x, B symmetric [N/m] or [N s/m].
void add_attachment_block(const Attachment& attachment, const VecX& x, const Mat3& block, BlockMatrix& A);
// Adds stiffness [N/m] times J^T J: never negative.
void add_attachment_stiffness(const Attachment& attachment, const VecX& x, double stiffness, BlockMatrix& A);

}  // namespace frond
