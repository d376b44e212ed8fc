// World: the plants of one Bullet world, stepped inside each of its substeps by an action, the only hook that every
// kind of Bullet world runs at the same place and that is not the host's.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <functional>
#include <list>
#include <map>

#include "solve/impulses.hpp"
#include "world/bond.hpp"
#include "world/contact.hpp"
#include "world/detail.hpp"
#include "world/events.hpp"
#include "world/gravity_ahead.hpp"
#include "world/ledger.hpp"
#include "world/lent.hpp"
#include "world/near_children.hpp"
#include "world/plant_contact.hpp"
#include "world/rigid.hpp"
#include "world/swept_body.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

class LinkLoads;
struct OwnBullet;
struct Robot;

// Release the handles of what the host deletes in its Bullet world; set by the C API, which knows them.
struct Release {
    void (*plant)(PlantBody&) = nullptr;
    void (*rigid)(const Rigid&) = nullptr;
    void (*robot)(const Robot&) = nullptr;
};

struct World final : btActionInterface {
    std::unique_ptr<OwnBullet> own;  // null when attached
    btDynamicsWorld* bullet;
    btSoftBodyWorldInfo soft_info;  // an argument of btSoftBody's constructor; not otherwise used
    frond_effects effects;
    double max_substep;  // [s]
    HashSettings hash;
    frond_response response;
    ResponseSettings response_settings;
    std::unique_ptr<Wind> wind;  // null: there is no air
    LackingShape lacking;        // before `bodies`, whose shapes forget themselves there
    std::map<const Model*, std::weak_ptr<Hull>> hulls;
    std::vector<std::unique_ptr<PlantBody>> bodies;
    std::vector<PlantBody*> awake;        // by index, except those that woke since the last substep
    std::vector<PlantBody*> taking_part;  // in the running substep, by number: awake plants and sleepers beside them
    std::vector<PlantBody*> looked_at;    // asleep, but decompressed since the last substep
    // Bullet's objects that are plants, at their indices among all objects, so that thousands need not be checked anew.
    std::vector<const btCollisionObject*> plants_at;
    std::vector<const btCollisionObject*> others_before;  // the others of the last substep, by address
    frond_parallel_for_fn* parallel_for;                  // null: the host provides no threads
    void* parallel_user;
    std::vector<std::unique_ptr<Rigid>> rigids;  // rigid bodies made by Frond
    std::vector<std::unique_ptr<Robot>> robots;  // likewise
    std::list<Bond> bonds;
    double sleep_distance;  // 0: no plant sleeps [m]
    size_t turn = 0;        // next plant to be checked for a change of air
    uint64_t substep = 0;
    double substep_length = 0;  // length of the last one [s]
    // Where surfaces are shown between the last two substeps [-], or FROND_INTERPOLATION_AS_MOTION_STATES.
    double interpolation = 1;
    std::unique_ptr<Detail> detail;      // null: all plants are simulated in full
    Vec3 gravity_before = Vec3::Zero();  // gravity in the last substep [m/s^2]
    frond_effects effects_before = 0;    // likewise
    bool is_stepping = false;            // in updateAction
    bool is_ending = false;
    bool is_gone = false;  // the Bullet world was deleted
    Release release;
    std::vector<Contact> contacts;                             // contacts of the last substep, with bodies
    std::vector<Loan<LinkLoads, World>> link_loads;            // in Bullet's world, one per multi-body that is pushed
    GravityAhead gravity_ahead;                                // gravity given in advance to the bodies of those
    std::vector<PlantContact> plant_contacts;                  // contacts of plants with each other and themselves
    std::vector<std::unique_ptr<PlantSearch>> plant_searches;  // one per island of plants that may touch
    size_t plant_island_count = 0;                             // in the running substep
    double time = 0;                                           // [s]
    frond_report report = {};                                  // report of the last substep
    frond_profile profile = {};                                // likewise
    Events events;
    std::unique_ptr<Ledger> ledger;  // null: the host has not requested it
    std::vector<SweptBody> swept;    // in the running substep

    World(std::unique_ptr<OwnBullet> own, btDynamicsWorld* bullet, const frond_world_def& def);
    ~World() override;
    // Called by Bullet once a substep, after rigid bodies have moved.
    void updateAction(btCollisionWorld* world, btScalar h) override;
    void debugDraw(btIDebugDraw* drawer) override;
};

// Runs job(i) for all i below count, on as many threads as the host provides.
void run_jobs(const World& world, size_t count, const std::function<void(size_t)>& job);
// Returns a plant's number in the running substep, in which it takes part from now on.
int number_of(World& world, PlantBody& body);
// Brings a plant up to date for reading: decompresses a sleeper, poses a modal plant.
PlantBody& look_at(PlantBody& body);
// Makes a world, with a Bullet world of its own if `bullet` is null. Throws BAD_ARGUMENT if `bullet` has plants
// already.
std::unique_ptr<World> make_world(btDynamicsWorld* bullet, const frond_world_def& def);
// Adds a plant, with a group and a mask of Bullet's collision filter.
PlantBody* add_plant(World& world, std::unique_ptr<Plant> plant, int group, int mask, bool asleep);
void remove_plant(World& world, PlantBody* body);
// Drops contacts, and holds of bonds, of a body that leaves the world.
void forget_body(World& world, const btCollisionObject& body);
// Returns whether a Bullet world still holds something that Frond put there.
bool is_held(const World& world);
// Puts a plant elsewhere, with its shape and its fragments. `rotation` has length one.
void place_plant(PlantBody& body, const Vec3& position, const Quat& rotation);
// Returns the def with which the plant would be made as it is set now.
frond_plant_def def_of(const PlantBody& body);
// Resets a plant to how it was made; grabs and bonds stay.
void reset_plant(PlantBody& body);
// Moves the world's origin to this place of it [m].
void shift_origin(World& world, const Vec3& origin);
// Steps a world of Frond's own by exactly dt.
void advance(World& world, double dt);
Vec3 gravity_of(const World& world);
// Returns how long before the end of the last substep surfaces are shown [s].
double surfaces_back(const World& world);
uint64_t state_hash(World& world);

struct RayHit {
    PlantBody* body = nullptr;
    int capsule = -1;
    Vec3 point = Vec3::Zero();
};
RayHit cast_ray(World& world, const Vec3& from, const Vec3& to);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
