// Attachment: a point of a plant that follows nodes of its mechanics: the weighted sum of their positions, plus arms
// that rotate with them where nodes rotate (the chain's).
#pragma once

#include "core/types.hpp"
#include "mechanics/block_matrix.hpp"
#include "mechanics/tet_nodes.hpp"

namespace frond {

struct Attachment {
    static constexpr int MOST = 10;                          // a quadratic tet's nodes
    int count = 0;                                           // number of nodes
    bool turns = false;                                      // the node after each is its rotation vector
    std::array<int, MOST> node = {};                         // indices in the mechanics
    std::array<double, MOST> weight = {};                    // [-]
    std::array<Vec3, 2> arm = {Vec3::Zero(), Vec3::Zero()};  // arms of the first two nodes, in the modelled shape [m]
};

Attachment tet_attachment(const TetPlace& place);
// A point that is rigid with a chain node, or beside the cubic centre line of the capsule between two, along their
// axes, and turns with both, blended smoothly.
Attachment node_attachment(int node, const Vec3& arm);
Attachment centre_line_attachment(int begin, int end, const Vec3& axis, double along, const Vec3& across);
bool is_sound(const Attachment& attachment, int node_count);
// Derivative of the point by each node that it follows, positions or rotation vectors.
struct AttachmentDerivative {
    int count = 0;
    std::array<int, Attachment::MOST> node;
    std::array<Mat3, Attachment::MOST> by;
};
AttachmentDerivative derivative_at(const Attachment& attachment, const VecX& x);
Vec3 attachment_place(const Attachment& attachment, const VecX& x);
// Computes the places of many, turned and then shifted.
void attachment_places(const std::vector<Attachment>& attachments, const VecX& x, const Mat3& turn, const Vec3& shift,
                       std::vector<Vec3>& out);
Vec3 attachment_velocity(const Attachment& attachment, const VecX& x, const VecX& v);
// Distributes a force at the point [N] over the nodes.
void add_attachment_force(const Attachment& attachment, const VecX& x, const Vec3& force, VecX& f);
// Adds J^T B J, J the derivative of the point by the nodes at x, B symmetric [N/m] or [N s/m].
void add_attachment_block(const Attachment& attachment, const VecX& x, const Mat3& block, BlockMatrix& A);
// Adds the stiffness that a force at the point gives to arms which turn, times a scale: minus the derivative of
// add_attachment_force().
void add_attachment_turning(const Attachment& attachment, const VecX& x, const Vec3& force, double scale,
                            BlockMatrix& A);
// Adds stiffness [N/m] times J^T J, which is positive semi-definite.
void add_attachment_stiffness(const Attachment& attachment, const VecX& x, double stiffness, BlockMatrix& A);

}  // namespace frond
