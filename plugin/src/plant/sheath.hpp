// Sheath: the outline of a plant whose chain moves by itself, for contact with other plants and itself, where the cage
// would be too fat: tets around each capsule, a blade's as wide as the blade and a stem's as thick as the stem.
#pragma once

#include "collide/cage_contact.hpp"
#include "plant/follow.hpp"

namespace frond {

// Shared by all plants of a model. Read-only.
struct Sheath {
    Collider collider;              // its pieces are the capsules
    Follow follow;                  // where the nodes are
    std::vector<Vec3> modelled;     // in the modelled shape [m]
    std::vector<Attachment> holds;  // by which pushes take them: the chain's axis, and a blade's half width as a lever
};

Sheath make_sheath(const Model& model);
// A point of the sheath, to push there.
Attachment sheath_attachment(const Sheath& sheath, const ContactSide& side);

}  // namespace frond
