// Sleep: a plant that has come to rest stands still, at no cost, until something moves it.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <memory>

#include "core/types.hpp"
#include "frond/frond_bullet.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct World;
struct PlantBody;
struct LastContacts;

// The known history of a plant's rest.
struct Rest {
    bool asleep = false;
    std::shared_ptr<const LastContacts> contacts;  // with which it sleeps; null: none
    double still = 0;                              // for how long nothing of it has gone far from `places` [s]
    VecX places;                                   // of what its mechanics move
    Vec3 air = Vec3::Zero();                       // at its middle when it fell asleep [m/s]
};

void wake(PlantBody& body);
// Stands still where it is from now on.
void fall_asleep(World& world, PlantBody& body);
// Folds again those that sleep and that somebody has looked at.
void compress_looked_at(World& world);
frond_vec3 middle_of(const PlantBody& body);  // of its box [m]
// Plants whose boxes meet that of an object which is about to leave.
void wake_neighbours(World& world, const btCollisionObject& leaving);

// What of a substep wakes plants. First gravity, effects, the air, and bonds to bodies that move; then what was found
// to touch them. Contacts of plants that sleep on are taken out.
void wake_by_world(World& world);
void wake_touched(World& world, double h);
// Tells whether a body may push what sleeps.
bool is_moving(btCollisionObject& object);

// After a substep: how long has the plant been still?
void watch(const World& world, PlantBody& body, double h);
// Plants fall asleep together with all that they touch, or not at all.
void put_to_sleep(World& world);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
