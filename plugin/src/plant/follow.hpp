// Follow: how cage and surface are attached to the chain, for mechanics that move the chain. Shared by all plants of a
// model.
#pragma once

#include <vector>

#include "mechanics/attachment.hpp"
#include "mechanics/tet_nodes.hpp"
#include "model/model.hpp"
#include "plant/skin.hpp"

namespace frond {

// Points that a chain carries.
struct Carried {
    std::vector<Attachment> attachments;  // one per point
    VecX modelled;                        // their positions in the modelled shape [m]
};
// The cage's nodes, and the surface.
struct Follow : Carried {
    std::vector<int> nearest;  // chain node to which each cage node is attached most
    Skin skin;                 // how the surface follows
};

// Returns, for each cage node, the chain node at the end of the nearest capsule of its own organs; -1: the chain has
// only roots.
std::vector<int> nearest_capsules(const Model& model, const TetNodes& nodes, const VecX& modelled);
// Attaches each cage node to the nearest capsule of its own organs: to a cubic centre line through the capsule's two
// nodes, along their axes, and across it to both rotations, blended smoothly. So the cage has no kinks where capsules
// meet. Beyond a capsule's ends it is rigid with the node there.
Follow make_follow(const Model& model, const TetNodes& nodes, const VecX& modelled);

// Compute positions and velocities of what is carried from the chain's positions and rotations x and their rates v.
void follow_places(const Carried& carried, const VecX& x, VecX& places);
void follow_velocities(const Carried& carried, const VecX& x, const VecX& v, VecX& velocities);

// Finds each chain node's position and rotation by the points around it alone: quick, and continuous in `places`.
void fit_chain_roughly(const Carried& carried, const Model& model, const VecX& places, VecX& x);
// Find the chain's positions and rotations for which what it carries is nearest to `places`, in the sense of least
// squares: exact if the chain can take that shape. `x` must have its size; it receives the result.
void fit_chain(const Carried& carried, const Model& model, const VecX& places, VecX& x);
void fit_velocities(const Carried& carried, const VecX& x, const VecX& velocities, VecX& v, double damping = 0);

// Finds the rigid motion that takes `from` nearest to `to` (Kabsch 1976): rotation and the image of `origin`. The
// rotation that is passed counts by `weight`, over what the points do. False if the points lie on one line and it does
// not count, which leaves the rotation undetermined; nothing is changed then.
bool fit_rigid(const std::vector<Vec3>& from, const std::vector<Vec3>& to, const Vec3& origin, Mat3& rotation,
               Vec3& image, double weight = 0);

}  // namespace frond
