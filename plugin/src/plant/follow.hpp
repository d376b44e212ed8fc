// Follow: how the cage hangs on the chain, for mechanics that move the chain. Shared by all plants of a model.
#pragma once

#include <vector>

#include "mechanics/attachment.hpp"
#include "mechanics/tet_nodes.hpp"
#include "model/model.hpp"

namespace frond {

struct Follow {
    std::vector<Attachment> attachments;  // one a cage node
    std::vector<int> nearest;             // the chain node that each cage node is bound to most
    VecX modelled;                        // where the cage nodes are in the modelled shape [m]
};

// Each cage node is bound to the nearest capsule of its own organs: to a cubic centre line through the capsule's two
// nodes, along their axes, and across it to both rotations, blended smoothly. So the cage has no kinks where capsules
// meet. Beyond a capsule's ends it is rigid with the node there.
Follow make_follow(const Model& model, const TetNodes& nodes, const VecX& modelled);

// Where the cage nodes are and how they move; x, v of the chain's places and rotations.
void follow_places(const Follow& follow, const VecX& x, VecX& cage_x);
void follow_velocities(const Follow& follow, const VecX& x, const VecX& v, VecX& cage_v);

// The chain's places and rotations for which the cage comes nearest to cage_x, in the sense of least squares: exact
// where the chain can take that shape. x is where the search begins and ends.
void fit_chain(const Follow& follow, const Model& model, const VecX& cage_x, VecX& x);
void fit_velocities(const Follow& follow, const VecX& x, const VecX& cage_v, VecX& v);

// The rigid motion that takes `from` nearest to `to` (Kabsch 1976): rotation and the image of `origin`. False if the
// points lie on one line, so that they do not tell the rotation.
bool fit_rigid(const std::vector<Vec3>& from, const std::vector<Vec3>& to, const Vec3& origin, Mat3& rotation,
               Vec3& image);

}  // namespace frond
