// PlantBody: a plant as Bullet sees it, a soft body whose shape is a compound of capsules, and of plates for blades. It
// has no nodes of its own.
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

// Overlaps of a new plant with bodies at rest, such as ground and pots, which do not push it out: depth by capsule,
// body and the body's number in the broad phase, which distinguishes it from a later one at the same address [m].
// A plant as a whole also lets bodies through (contact/let_through.hpp).
constexpr int WHOLE_PLANT = -1;
using GrownIn = std::map<std::tuple<int, const btCollisionObject*, int>, double>;

// Collision shapes that all plants of a model share in a world. A capsule is narrower than its blade and far thicker,
// so a flat segment has a plate besides, which bodies touch instead.
struct Hull {
    std::vector<std::unique_ptr<btCapsuleShape>> capsules;   // in the order of Model::capsules
    std::vector<Flat> flats;                                 // one per capsule
    std::vector<std::unique_ptr<btConvexHullShape>> plates;  // plates of flat segments: x is wide, y along and z thin
    std::vector<int> plate_capsule;                          // capsule of each plate
    std::vector<double> organ_borne;                         // mass of each organ with all that it bears [kg]
    // Half heights and radii of capsules; half widths and lengths, and margins, of plates; padded for lanes [m].
    std::vector<double> capsule_halves, capsule_radii, plate_halves[2], plate_margins;
    std::vector<btTransform> modelled;      // frames of capsules, then of plates
    std::unique_ptr<btCompoundShape> rest;  // the modelled shape, shared by plants that sleep in it
    double wider_by_cage = 0,
           wider_by_sheath = 0;  // by how much those are wider than the capsules [m]; 0: not computed
    // Returns the capsule that a child of the compound is or replaces; -1 if there is no such child.
    int capsule_of(int child) const;
};

// How much of a plant is simulated now.
struct Level {
    frond_detail now = FROND_DETAIL_FULL;
    frond_mechanics own;    // mechanics of FROND_DETAIL_FULL
    uint8_t every = 1;      // substeps per step
    bool is_due = true;     // is stepped in the running substep
    float distance = 0;     // distance that counts for detail [m], by size [-]
    double pending = 0;     // time not yet stepped [s]
    double disturbed = 0;   // time until which it is simulated at any distance [s]
    float ms = 0;           // average time of recent steps [ms]
    float ms_capsules = 0;  // time for the capsules in the last step [ms]
};

// Small members stand together to save memory: fields have thousands of plants.
struct PlantBody : btSoftBody {
    BT_DECLARE_ALIGNED_ALLOCATOR();

    std::unique_ptr<Plant> plant;
    World* world;
    frond_plant handle = {};
    Rest rest;
    std::unique_ptr<GrownIn> grown_in;  // null: none
    bool starts_asleep = false;         // asleep when it is made, or reset
    bool is_hidden = false;             // hidden from sleepers and static bodies: it sleeps, and nothing touches it
    bool is_taken_back = false;         // Frond itself deletes it, not the host
    bool is_looked_at = false;          // asleep, but decompressed for reading
    uint32_t troubled_in = UINT32_MAX;  // lower half of the substep of which `trouble` tells; at first none
    uint64_t met_in = UINT64_MAX;       // substep in which something last came near it; at first none
    uint16_t trouble = 0;               // FROND_TROUBLE_*
    // Substeps in which overlaps are still recorded in grown_in; 2 if it starts asleep, as it then wakes without pairs.
    int16_t new_for = 1;
    int filter_group = 0, filter_mask = 0;  // the host's filter, while it is hidden
    int index = 0;                          // index among the world's plants
    int number = -1;                        // index among those that take part in the running substep; -1: it does not
    int place = 0;                          // index in its contact island
    Level level;
    std::shared_ptr<Hull> hull;
    // What other plants, or it itself, touch; null until they may, and by the mechanics.
    std::shared_ptr<const Sheath> sheath;
    std::shared_ptr<const SheathInCage> in_cage;
    std::vector<Rigid*> fragment_bodies;  // the world's, one for each of plant->fragments

    PlantBody(btSoftBodyWorldInfo* info, World* world, std::unique_ptr<Plant> plant);
    ~PlantBody() override;
    btCollisionShape*& shape() { return m_collisionShape; }
    const std::vector<std::unique_ptr<btCapsuleShape>>& capsules() const { return hull->capsules; }
    btCompoundShape* compound() { return static_cast<btCompoundShape*>(getCollisionShape()); }
    const Sheath& touched() const { return plant->follow ? *sheath : in_cage->sheath; }
    // Excludes other plants, and infinite planes in a step, from Bullet's narrow phase; its broad phase still pairs
    // them.
    bool checkCollideWithOverride(const btCollisionObject* other) const override;
    // Returns the plant's body that a collision object is; null if it is none.
    static PlantBody* of(btCollisionObject* object) {
        return object && object->getInternalType() == CO_SOFT_BODY ? dynamic_cast<PlantBody*>(object) : nullptr;
    }
    static const PlantBody* of(const btCollisionObject* object) { return of(const_cast<btCollisionObject*>(object)); }
};

// Returns whether a plant has been stepped in the running substep.
inline bool has_step(const PlantBody& body) {
    return body.level.is_due && !body.rest.asleep && !body.plant->state.modal &&
           body.plant->step.x_good.size() == body.plant->state.motion.x.size();
}
// Returns whether contacts may still change that step.
inline bool awaits_contacts(const PlantBody& body) {
    return has_step(body) && waits(*body.plant);
}
// Returns the mass that the organ of a capsule bears, its own included [kg].
double borne_at(const PlantBody& body, int capsule);
// Returns whether the object is an infinite plane.
bool is_plane(const btCollisionObject& object);
// Forgets a plant whose object the host deletes.
void host_deleted(PlantBody& body);
// Switch to the hull's shape as modelled, or to one of the plant's own that moves.
void share_shape(PlantBody& body);
void take_own_shape(PlantBody& body);
// Hide a sleeper that nothing touches from pairs with other sleepers and static bodies, and show it with the host's
// filter.
void hide(PlantBody& body);
void show_again(PlantBody& body);
// Enters the broad phase as if new in the world, without the pairs that it had.
void enter_anew(PlantBody& body);
// Moves the capsules to where the chain is.
void move_capsules(PlantBody& body);
void move_capsules(PlantBody* const* bodies, int count);  // at most MOST_LANES
// Prepares contact of the plant's cage, or of its sheath. The broad phase then sees the plant as wide as that.
void take_collider(PlantBody& body);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
