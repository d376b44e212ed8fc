// PlantContact: a contact of two plants, or of a plant with itself, between their sheaths or their cages.
#pragma once

#include "collide/cage_contact.hpp"
#include "collide/cover.hpp"
#include "world/contact.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct PlantContact {
    std::array<PlantBody*, 2> plants;                   // the same one twice where it touches itself
    std::array<ContactSide, 2> sides;                   // points of cages or sheaths
    std::array<bool, 2> by_sheath = {}, on_chain = {};  // what touched, and whether the mechanics moved the chain
    std::array<Attachment, 2> attachments;              // attachments of those points
    Vec3 between;                 // place of the first attachment less that of the second, world frame [m]
    Vec3 point;                   // point on the first, world frame [m]
    Vec3 normal;                  // exit direction of the first from the second
    double depth;                 // depth of the overlap [m]; below zero they are apart
    double lacking = 0;           // by how much the response found so far in this step left it too near [m]
    double lacking_place = 0;     // likewise, the correction of positions
    double friction;              // combined coefficient of both [-]
    bool by_strips = false;       // found by the distance of their cores, not by overlapping tets
    bool may_ask = true;          // for what is lacking, as far as no energy comes from it
    int missed = 0;               // substeps since the search last found it
    Vec3 impulse = Vec3::Zero();  // impulse on the first; the last substep's until this one's is known [N s]
};

// Returns whether the mechanics of both sides still move what they moved when the contact was found: its attachments
// are of that time.
bool is_by_the_same(const PlantContact& contact);
// Contacts of one plant, with bodies and with plants.
struct LastContacts {
    std::vector<Contact> with_bodies;
    std::vector<PlantContact> with_plants;
};

// Strips of two plants of an island, or of one.
struct StripPair {
    int a, strip_a, b, strip_b;
};

// Memory that is kept between searches.
struct PlantSearch {
    ContactSearchPtr search = make_contact_search();
    std::vector<CageContact> found;
    // One per plant.
    struct Shape {
        std::vector<Vec3> places;  // nodes of cage or sheath at the end of the step, world frame [m]
        std::vector<Vec3> ways;    // displacements of the nodes in the step [m]
        std::vector<Axis> axes;
        std::vector<Capsule> covers;
    };
    std::vector<Shape> shapes;
    std::vector<std::array<std::vector<Vec3>, 2>> corners;  // of strips, before and after the step, one per plant
    std::vector<VecX> placed;                               // states of the plants that those before the step belong to
    std::vector<PlantBody*> island;
    std::vector<std::vector<Vec3>> foreseen;  // corners after the step, as they were when pairs were found
    std::vector<StripPair> pairs;             // that come near each other within the step
    std::vector<Vec3> normals;                // of the gaps of pairs before it; zero: not known
    std::vector<std::array<int, 4>> crossed;  // organs that have gone through each other, as OrganPair
};

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
