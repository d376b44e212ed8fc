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

// How long a plant has been at rest, and how it sleeps.
struct Rest {
    bool asleep = false;
    Vec3f air = Vec3f::Zero();                     // velocity at its middle when it fell asleep [m/s]
    std::shared_ptr<const LastContacts> contacts;  // contacts with which it sleeps; null: none
    double still = 0;                              // time for which no point has moved far from `places` [s]
    VecX places;                                   // reference places of what its mechanics move, or of its modes [m]
};

void wake(PlantBody& body);
// Puts a plant to sleep in its present shape.
void fall_asleep(World& world, PlantBody& body);
// Compresses again the sleepers that were decompressed for reading.
void compress_looked_at(World& world);
frond_vec3 middle_of(const PlantBody& body);  // middle of its box [m]
// Wakes plants whose boxes overlap that of an object which is about to leave.
void wake_neighbours(World& world, const btCollisionObject& leaving);

// Wakes plants by changes of gravity, effects and air, and by bonds to bodies that move. What contacts wake is known
// once they are found (step/touch.cpp).
void wake_by_world(World& world);
// Returns whether a body may push a sleeper.
bool is_moving(btCollisionObject& object);

// Updates how long the plant has been still. Call it after a substep.
void watch(const World& world, PlantBody& body, double h);
// Puts plants to sleep together with all plants that they touch, or not at all.
void put_to_sleep(World& world);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
