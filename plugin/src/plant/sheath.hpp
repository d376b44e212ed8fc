// Sheath: the outline of a plant for contact with other plants and itself, where the cage would be too fat: tets around
// each capsule, a blade's as wide as the blade and a stem's as thick as the stem.
#pragma once

#include "collide/cage_contact.hpp"
#include "collide/strip.hpp"
#include "plant/follow.hpp"

namespace frond {

// Shared by all plants of a model. Read-only.
struct Sheath {
    Collider collider;           // its regions are the capsules
    Follow follow;               // how the nodes follow the chain
    std::vector<Vec3> modelled;  // positions in the modelled shape [m]
    std::vector<int> capsules;   // capsule for which each node was made
    std::vector<Attachment>
        holds;  // attachments of the nodes for pushes: the chain's axis, with a blade's half width as lever
    // Strips between holds: their corners are nodes. Empty for a cage as a sheath, which has none.
    std::vector<Strip> strips;
    std::vector<int> corners;              // the nodes that are corners of strips, each once
    std::vector<Attachment> corner_holds;  // their attachments
};

// A sheath that follows a cage: its nodes, and the points at which it is pushed, are points of the tets around their
// own part of the plant. Shared by all plants of a model with elements of one order.
struct SheathInCage {
    Sheath sheath;
    std::vector<Attachment> attachments;         // of the sheath's nodes
    std::vector<std::vector<int>> capsule_tets;  // tets that carry the surface of each capsule
    std::vector<Attachment> corners;             // of the holds of the sheath's corners
};

// Makes a sheath of blades that are that many strips wide: a chain's are rigid across, a cage's are not.
Sheath make_sheath(const Model& model, int strips = 1);
SheathInCage make_sheath_in_cage(const Model& model, const TetNodes& nodes);
// Returns the cage itself as a sheath, whose nodes are the cage's own.
SheathInCage cage_as_sheath(const Model& model);
// Returns the attachment of a point of the sheath, for pushes there.
Attachment sheath_attachment(const Sheath& sheath, const ContactSide& side);
Attachment sheath_attachment(const SheathInCage& in_cage, const Model& model, const TetNodes& nodes,
                             const ContactSide& side);

}  // namespace frond
