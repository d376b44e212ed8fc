// CageContact: a place where two cages, or two regions of one, overlap, and the displacement by which they separate.
#pragma once

#include <memory>

#include "collide/overlap.hpp"

namespace frond {

enum ContactKind : uint8_t {
    CONTACT_NODE_IN_TET,   // a is a node, b the tet around it
    CONTACT_EDGE_ON_EDGE,  // both are boundary edges, which have passed each other
    CONTACT_EDGE_IN_FACE   // a is an edge, b a face that it passes through
};

// A point of a cage: the sum of weights[k] * place of nodes[k]. Entries from node_count on are zero.
struct ContactSide {
    int body;   // index in the bodies given to find_cage_contacts
    int organ;  // organ, as in Cage::tet_organ
    int piece;  // region, as in Collider::tet_piece
    int node_count;
    std::array<int, 4> nodes;
    std::array<double, 4> weights;  // add up to one
};

// Both points are at one place or lie along the normal from each other, so that opposite forces on them have no torque.
struct CageContact {
    ContactKind kind;
    ContactSide a, b;
    Vec3 point;    // point of a [m]
    Vec3 normal;   // exit direction of a from b, length one
    double depth;  // distance that a has to move along it [m], > 0
};

// Memory that is kept between searches.
struct ContactSearch;
using ContactSearchPtr = std::unique_ptr<ContactSearch, void (*)(ContactSearch*)>;
ContactSearchPtr make_contact_search();

// Finds contacts of all bodies with each other, and with themselves where their with_itself is set. The order is by
// bodies and then by their nodes and edges; results do not depend on the settings. A node within a tet gets depth and
// normal from the points where its edges enter, and deeper nodes get theirs from their neighbours (Heidelberger,
// Teschner, Keiser, Mueller, Gross 2004, "Consistent Penetration Depth Estimation for Deformable Collision Response").
// An edge that passes through without a node inside leaves across the adjacent boundary edge of the other cage, deeper
// ones as their neighbours do.
struct SearchTimes {
    double ms_hash = 0, ms_narrow = 0;  // overlaps of boxes; exact tests, depths and exits
};
SearchTimes find_cage_contacts(ContactSearch& search, const std::vector<CollisionBody>& bodies,
                               const HashSettings& settings, std::vector<CageContact>& out);

}  // namespace frond
