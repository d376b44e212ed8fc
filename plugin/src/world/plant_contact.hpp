// PlantContact: a place where two plants are in each other, or where one is in itself: by their cages, or by their
// sheaths where their chains move by themselves.
#pragma once

#include "collide/cage_contact.hpp"
#include "collide/cover.hpp"
#include "world/contact.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct PlantContact {
    std::array<PlantBody*, 2> plants;  // the same one twice where it touches itself
    std::array<ContactSide, 2> sides;  // of cages or sheaths
    std::array<bool, 2> by_sheath = {};
    std::array<Attachment, 2> attachments;  // what holds those points
    Vec3 between;                           // of the grips' places, the first's less the second's, world frame [m]
    Vec3 point;                             // on the first, world frame [m]
    Vec3 normal;                            // along which the first leaves the second
    double depth;                           // by which it has to [m]; below zero they are apart
    double friction;                        // of both together [-]
    int missed = 0;                         // substeps since the search saw it
    Vec3 impulse = Vec3::Zero();            // on the first; that of the last substep until this one's is known [N s]
};

// Tells whether both sides still are touched by what they were touched by then: what holds its points is of the
// mechanics that they had.
bool is_by_the_same(const PlantContact& contact);
// Takes hold of the points on both sides as they are now.
void take_attachments(PlantContact& contact);
// Tells whether the effects that let its plants touch are on.
bool may_touch(const World& world, const PlantContact& contact);

// Of one plant, with bodies and with plants.
struct LastContacts {
    std::vector<Contact> with_bodies;
    std::vector<PlantContact> with_plants;
};

// Memory that is kept between searches.
struct PlantSearch {
    ContactSearchPtr search = make_contact_search();
    std::vector<CageContact> found;
    // One a plant.
    struct Shape {
        std::vector<Vec3> places;  // of the nodes of cage or sheath at the end of the step, world frame [m]
        std::vector<Vec3> ways;    // by which they get there [m]
        std::vector<Axis> axes;
        std::vector<Capsule> covers;
    };
    std::vector<Shape> shapes;
};

// Bullet's broad phase says which plants may meet, capsules around pieces of their cages which organs do, a spatial
// hash which nodes, edges and tets of those (section 3.3 of the paper). Contacts of the last substep that the search
// does not see go on (remember_contacts.hpp), so that what rests on another plant does not sink into it again and
// again; those that will meet within the step of h, as they move now, are found before.
std::vector<PlantContact> find_plant_contacts(World& world, double h);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
