// Follow: how cage and surface are attached to the chain, for mechanics that move the chain. Shared by all plants of a
// model.
#pragma once

#include <vector>

#include "mechanics/attachment.hpp"
#include "mechanics/tet_nodes.hpp"
#include "model/model.hpp"
#include "plant/skin.hpp"

namespace frond {

struct Follow {
    std::vector<Attachment> attachments;  // one per cage node
    std::vector<int> nearest;             // chain node to which each cage node is attached most
    VecX modelled;                        // positions of the cage nodes in the modelled shape [m]
    Skin skin;                            // how the surface follows
};

// Returns, for each cage node, the chain node at the end of the nearest capsule of its own organs; -1: the chain has
// only roots.
std::vector<int> nearest_capsules(const Model& model, const TetNodes& nodes, const VecX& modelled);
// Attaches each cage node to the nearest capsule of its own organs: to a cubic centre line through the capsule's two
// nodes, along their axes, and across it to both rotations, blended smoothly. So the cage has no kinks where capsules
// meet. Beyond a capsule's ends it is rigid with the node there.
Follow make_follow(const Model& model, const TetNodes& nodes, const VecX& modelled);

// Compute positions and velocities of the cage nodes from the chain's positions and rotations x and their rates v.
void follow_places(const Follow& follow, const VecX& x, VecX& cage_x);
void follow_velocities(const Follow& follow, const VecX& x, const VecX& v, VecX& cage_v);

// Find the chain's positions and rotations for which the cage is nearest to cage_x, in the sense of least squares:
// exact if the chain can take that shape. `x` must have its size; it receives the result.
void fit_chain(const Follow& follow, const Model& model, const VecX& cage_x, VecX& x);
void fit_velocities(const Follow& follow, const VecX& x, const VecX& cage_v, VecX& v);

// Finds the rigid motion that takes `from` nearest to `to` (Kabsch 1976): rotation and the image of `origin`. False if
// the points lie on one line, which leaves the rotation undetermined.
bool fit_rigid(const std::vector<Vec3>& from, const std::vector<Vec3>& to, const Vec3& origin, Mat3& rotation,
               Vec3& image);

}  // namespace frond
