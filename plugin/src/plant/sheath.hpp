// Sheath: the outline of a plant whose mechanics move the chain, for contact with other plants and itself, where the
// cage would be too fat: tets around each capsule, a blade's as wide as the blade and a stem's as thick as the stem.
#pragma once

#include "collide/cage_contact.hpp"
#include "plant/follow.hpp"

namespace frond {

// Shared by all plants of a model. Read-only.
struct Sheath {
    Collider collider;           // its regions are the capsules
    Follow follow;               // how the nodes follow the chain
    std::vector<Vec3> modelled;  // positions in the modelled shape [m]
    std::vector<Attachment>
        holds;  // attachments of the nodes for pushes: the chain's axis, with a blade's half width as lever
};

Sheath make_sheath(const Model& model);
// Returns the attachment of a point of the sheath, for pushes there.
Attachment sheath_attachment(const Sheath& sheath, const ContactSide& side);

}  // namespace frond
