// Contact: a point at which a body of the Bullet world touches a segment of a plant, a capsule or a plate, or is about
// to touch it within the step.
#pragma once

#include "world/plant_body.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct World;

// By how much responses in a step fell short of what a contact asks, since plants respond less to a push than their
// linear response, and what it asks of the next one beyond that.
struct Shortfall {
    double lacking = 0;      // what is asked in all [m]
    double asked = 0;        // what was asked last [m]
    double left = INFINITY;  // by how much the last response fell short [m]
    // Asks for what `now` is left [m], by as much more as the last response did less than it was asked for. Returns
    // whether that is of use.
    bool ask_for(double now);
};

struct Contact {
    PlantBody* plant;
    int capsule;
    double along;   // position along the capsule, 0..1 [-]
    double across;  // distance from a plate's axis towards its wide side [m]; 0 for capsules
    btCollisionObject* other;
    Vec3 on_plant, on_other;  // world frame [m]
    Vec3 normal;              // direction from the other body to the plant
    double gap;               // distance of the two along the normal when the step begins; below zero they overlap [m]
    Shortfall shortfall;      // of the responses found so far in this step
    double friction = 0;      // combined coefficient of both [-]
    double restitution = 0;   // likewise [-]
    Vec3 impulse = Vec3::Zero();    // impulse on the plant, once it is known [N s]
    Vec3 pushed_on = Vec3::Zero();  // velocity of the other body there, once it is pushed [m/s]
    bool is_inside = false;         // the plant's point is on a segment's round end, within another one
};

// Returns the attachment of the touched point of the plant.
Attachment attachment_of(const Contact& contact);

// Finds contacts from Bullet's manifolds, with planes, and of whatever moves so fast that it would pass through before
// Bullet detects it. `last`: those of the last step.
std::vector<Contact> find_contacts(World& world, const std::vector<Contact>& last, double h);

// A body that may be swept against plants, no plane; `is_new`: it was not there in the last substep.
struct Sweeper {
    btCollisionObject* object;
    bool is_new;
};
// Adds the contacts of bodies and plants that would pass through each other in the step, and drops those that would
// push them on. Puts a free body that has passed a plant back to where they met.
void add_swept_contacts(World& world, const std::vector<Sweeper>& bodies, const std::vector<Contact>& last, double h,
                        std::vector<Contact>& contacts);

// Returns whether the impulses on a plant act on bodies as well: one whose step fails is rewound, and then pushes
// nothing.
bool pushes_back(const World& world, const PlantBody& body);
// Returns whether an object pushes plants: triggers and the like do not, characters do.
bool pushes(const btCollisionObject& object);
// Returns whether bodies may push the plant; false for null.
bool takes_part(const World& world, const PlantBody* body);
// Returns whether neither side ignores the other, apart from their groups and PlantBody's own exclusions.
bool may_collide(const PlantBody& body, const btCollisionObject& object);
// Returns whether a body passes over the joints of a stem's segments, as a free rigid body does. Bodies that something
// leads, kinematic ones and links, push whatever they meet, so that nothing slips through them.
bool slides(const btCollisionObject& object);
// Returns whether the object is an infinite plane.
bool is_plane(const btCollisionObject& object);
// Adds the contacts of an infinite plane with the plants that Bullet's broad phase pairs with it; its narrow phase
// skips these pairs.
void add_plane_contacts(World& world, btCollisionObject& plane, double h, std::vector<Contact>& contacts);

// Computes the impulses of the world's contacts, of plants with bodies and with each other, and applies them to both
// sides. Call it between the two halves of all plants' steps.
void respond_to_contacts(World& world, double h);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
