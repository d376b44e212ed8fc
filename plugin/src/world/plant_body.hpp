// PlantBody: a plant as Bullet sees it, a soft body whose shape is a compound of capsules, and of plates where these
// stand for blades. It has no nodes of its own.
#pragma once

#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletSoftBody/btSoftBody.h>

#include <map>
#include <tuple>

#include "frond/frond_bullet.hpp"
#include "plant/flat.hpp"
#include "plant/touch.hpp"
#include "world/sleep.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct World;
struct Rigid;

// What a plant stood in when it came into the world, ground and pots, does not push it out: how deep, by capsule, body
// and the body's number in the broad phase, which tells it from a later one in the same memory [m].
using GrownIn = std::map<std::tuple<int, const btCollisionObject*, int>, double>;

// The collision shapes that all plants of a model have in common in a world. A capsule is narrower than the blade for
// which it stands and far thicker, so a flat piece has a plate besides: bodies touch that instead.
struct Hull {
    std::vector<std::unique_ptr<btCapsuleShape>> capsules;   // in the order of Model::capsules
    std::vector<Flat> flats;                                 // one a capsule
    std::vector<std::unique_ptr<btConvexHullShape>> plates;  // of the flat ones: x is wide, y along and z thin
    std::vector<int> plate_capsule;                          // of each plate
    // Half a capsule's height and its radius, half a plate's width and length and its margin, as far as several go on
    // [m].
    std::vector<double> capsule_halves, capsule_radii, plate_halves[2], plate_margins;
    std::vector<btTransform> modelled;              // capsules, then plates
    std::unique_ptr<btCompoundShape> rest;          // capsules, then plates, as modelled: of plants that sleep so
    double wider_by_cage = 0, wider_by_sheath = 0;  // what those are wider than the capsules [m]; 0: not asked
    // Of the compound's children, the capsule that a child is or stands for; -1 if there is no such child.
    int capsule_of(int child) const;
};

// How much of the plant is simulated now.
struct Level {
    frond_detail now = FROND_DETAIL_FULL;
    frond_mechanics own;    // of FROND_DETAIL_FULL
    uint8_t every = 1;      // substeps that are taken as one
    bool is_due = true;     // is stepped in the running substep
    float distance = 0;     // as it counts
    double pending = 0;     // time that is not yet stepped [s]
    double touched = 0;     // until when it was touched lately [s]
    float ms = 0;           // that a step took, lately
    float ms_capsules = 0;  // of the last one
};

// Small ones are side by side: fields have thousands of plants.
struct PlantBody : btSoftBody {
    BT_DECLARE_ALIGNED_ALLOCATOR();

    std::unique_ptr<Plant> plant;
    World* world;
    frond_plant handle = {};
    Rest rest;
    std::unique_ptr<GrownIn> grown_in;  // null: in nothing
    bool starts_asleep = false;         // when it is made, or reset
    bool is_hidden = false;             // from what sleeps and from what is static: asleep with nothing touching it
    bool is_looked_at = false;          // asleep, but unfolded for somebody to look
    int16_t new_for = 1;  // substeps in which what it stands in is yet to be found out; woken from a start asleep: none
    int filter_group = 0, filter_mask = 0;  // of the broad phase, while it is hidden
    int index = 0;                          // among the world's plants
    int number = -1;                        // among those that take part in the running substep; -1: it does not
    int place = 0;                          // among those of its island of contacts
    Level level;
    std::shared_ptr<Hull> hull;
    std::shared_ptr<const Collider> collider;  // of its cage; null until other plants, or it itself, may touch it
    std::shared_ptr<const Sheath> sheath;      // likewise, where its chain moves by itself
    std::vector<Rigid*> fragment_bodies;       // the world's, one for each of plant->fragments

    PlantBody(btSoftBodyWorldInfo* info, World* world, std::unique_ptr<Plant> plant);
    ~PlantBody() override;
    btCollisionShape*& shape() { return m_collisionShape; }
    const std::vector<std::unique_ptr<btCapsuleShape>>& capsules() const { return hull->capsules; }
    btCompoundShape* compound() { return static_cast<btCompoundShape*>(getCollisionShape()); }
    // Of its cage or its sheath, whichever it is that others touch now.
    const Collider& touched_collider() const { return plant->follow ? sheath->collider : *collider; }
    // Bullet's broad phase pairs plants with each other and with infinite planes, but its narrow phase need not look at
    // them.
    bool checkCollideWithOverride(const btCollisionObject* other) const override;
    // The body that a collision object is; null if it is none.
    static PlantBody* of(btCollisionObject* object) { return dynamic_cast<PlantBody*>(object); }
    static const PlantBody* of(const btCollisionObject* object) { return dynamic_cast<const PlantBody*>(object); }
};

// Takes the hull's shape as modelled, or one of its own that moves.
void share_shape(PlantBody& body);
void take_own_shape(PlantBody& body);
// Sleepers that nothing touches make no pairs with each other and with what is static. A host's filter is kept.
void hide(PlantBody& body);
void show_again(PlantBody& body);
// Into the broad phase as if it came into the world, without the pairs that it had.
void enter_anew(PlantBody& body);
// Moves the capsules to where the chain is.
void move_capsules(PlantBody& body);
void move_capsules(PlantBody* const* bodies, int count);  // at most MOST_LANES
// Makes ready for contact of cages, or of sheaths. The broad phase then sees the plant as wide as those.
void take_collider(PlantBody& body);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
