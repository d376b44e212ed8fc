// Contact: a point at which a body of the Bullet world touches a segment of a plant, a capsule or a plate, or is about
// to touch it within the step.
#pragma once

#include "world/plant_body.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct World;

struct Contact {
    PlantBody* plant;
    int capsule;
    double along;   // position along the capsule, 0..1 [-]
    double across;  // distance from a plate's axis towards its wide side [m]; 0 for capsules
    btCollisionObject* other;
    Vec3 on_plant, on_other;      // world frame [m]
    Vec3 normal;                  // direction from the other body to the plant
    double gap;                   // distance of the two along the normal; below zero they overlap [m]
    double friction;              // combined coefficient of both [-]
    Vec3 impulse = Vec3::Zero();  // impulse on the plant, once it is known [N s]
};

// Returns the attachment of the touched point of the plant.
Attachment attachment_of(const Contact& contact);

// Finds contacts from Bullet's manifolds, by sweeps of bodies so fast that they would tunnel before Bullet detects
// them, and with planes.
std::vector<Contact> find_contacts(World& world, double h);

// Returns whether an object pushes plants: triggers and the like do not, characters do.
bool pushes(const btCollisionObject& object);
// Returns whether bodies may push the plant; false for null.
bool takes_part(const World& world, const PlantBody* body);
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
