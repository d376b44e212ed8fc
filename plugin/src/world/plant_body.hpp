// PlantBody: a plant as Bullet sees it, a soft body whose shape is a compound of capsules. It has no nodes of its own.
#pragma once

#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletSoftBody/btSoftBody.h>

#include <map>
#include <tuple>

#include "frond/frond_bullet.hpp"
#include "plant/touch.hpp"
#include "world/sleep.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct World;
struct Rigid;

// What a plant stood in when it came into the world, ground and pots, does not push it out: how deep, by capsule, body
// and the body's number in the broad phase, which tells it from a later one in the same memory [m].
using GrownIn = std::map<std::tuple<int, const btCollisionObject*, int>, double>;

struct PlantBody : btSoftBody {
    BT_DECLARE_ALIGNED_ALLOCATOR();

    std::unique_ptr<Plant> plant;
    World* world;
    frond_plant handle = {};
    bool is_new = true;  // has not stepped yet
    Rest rest;
    GrownIn grown_in;
    int number = 0;  // among the world's plants, in the running substep
    std::shared_ptr<const Collider> collider;  // null until other plants, or it itself, may touch it
    std::vector<Rigid*> fragment_bodies;  // the world's, one for each of plant->fragments
    std::vector<std::unique_ptr<btCapsuleShape>> capsules;  // in the order of Model::capsules

    PlantBody(btSoftBodyWorldInfo* info, World* world, std::unique_ptr<Plant> plant);
    ~PlantBody() override;
    btCompoundShape* compound() { return static_cast<btCompoundShape*>(getCollisionShape()); }
    // Bullet's broad phase pairs plants, but its narrow phase need not look at them.
    bool checkCollideWithOverride(const btCollisionObject* other) const override {
        return !of(other) && btSoftBody::checkCollideWithOverride(other);
    }
    // The body that a collision object is; null if it is none.
    static PlantBody* of(btCollisionObject* object) { return dynamic_cast<PlantBody*>(object); }
    static const PlantBody* of(const btCollisionObject* object) { return dynamic_cast<const PlantBody*>(object); }
};

// Moves the capsules to where the chain is.
void move_capsules(PlantBody& body);
// Makes ready for contact of cages. The broad phase then sees the plant as wide as its cage.
void take_collider(PlantBody& body);
// The frame of a capsule, whose axis is y, between two points.
btTransform capsule_frame(const Vec3& begin, const Vec3& end);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
