// Finding the contacts of plants with the bodies of the Bullet world.
#pragma once

#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

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

// Finds, by Bullet's broad phase, the plants that such bodies may be in the way of though they are not swept.
void find_plants_among_bodies(World& world);
// Adds those that solved plants then whipped through, or beside, to what is swept.
void sweep_what_whipped(World& world, double h);

// Drops contacts by which a static or kinematic body pushes a held stem along its own axis: they would only stretch the
// stem, or compress it where it passes through the body and is held beyond. Contacts farther up the stem go with them.
void drop_what_draws_out(std::vector<Contact>& contacts);

// Returns whether the impulses on a plant act on bodies as well: one whose step fails is rewound, and then pushes
// nothing.
bool pushes_back(const World& world, const PlantBody& body);
// Returns whether an object pushes plants: triggers and the like do not, characters do.
bool pushes(const btCollisionObject& object);
// Returns whether bodies may push the plant; false for null.
bool takes_part(const World& world, const PlantBody* body);
// Returns whether neither side ignores the other, apart from their groups and PlantBody's own exclusions.
bool may_collide(const PlantBody& body, const btCollisionObject& object);
// Returns whether a body passes over the joints of a stem's segments, as rigid ones do. Links of a multi-body, which
// many points press at once, push whatever they meet.
bool slides(const btCollisionObject& object);
// Adds the contacts of an infinite plane with the plants that Bullet's broad phase pairs with it; its narrow phase
// skips these pairs.
void add_plane_contacts(World& world, btCollisionObject& plane, double h, std::vector<Contact>& contacts);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
