// Contact: a point of a body of the host's that touches a capsule of a plant, or the flat piece that it stands for, or
// is about to within the step.
#pragma once

#include "world/plant_body.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct World;

struct Contact {
    PlantBody* plant;
    int capsule;
    double along;   // of the capsule, 0..1
    double across;  // of a flat one, from its axis to its wide side [m]; else 0
    btCollisionObject* other;
    Vec3 on_plant, on_other;      // world frame [m]
    Vec3 normal;                  // from the other to the plant
    double gap;                   // between the two along the normal; below zero they overlap [m]
    double friction;              // of both together [-]
    Vec3 impulse = Vec3::Zero();  // on the plant, once it is known [N s]
};

// From Bullet's manifolds, and from sweeps of bodies that are so fast that they would be through before Bullet sees
// them.
std::vector<Contact> find_contacts(World& world, double h);

// Triggers and the like push nothing; characters do though Bullet lets them through.
bool pushes(const btCollisionObject& object);
// Tells whether bodies may push it; null: no.
bool takes_part(const World& world, const PlantBody* body);
// Tells whether it has no end.
bool is_plane(const btCollisionObject& object);
// Adds the contacts of an infinite plane with the plants that Bullet's broad phase pairs with it: its narrow phase
// leaves them to this.
void add_plane_contacts(World& world, btCollisionObject& plane, double h, std::vector<Contact>& contacts);

// Between the two halves of all plants' steps: impulses for the world's contacts, of plants with bodies and with each
// other, given to both sides.
void respond_to_contacts(World& world, double h);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
