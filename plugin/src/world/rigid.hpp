// Rigid: a rigid body that Frond makes, for callers without Bullet types or as a plant's fragment.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "core/types.hpp"
#include "frond/frond_bullet.hpp"
#include "world/lent.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct World;
struct PlantBody;

struct Rigid {
    World* world;
    frond_rigid handle = {};
    bool is_plane;
    std::vector<std::unique_ptr<btCollisionShape>> children;  // shapes of a compound
    std::unique_ptr<btCollisionShape> shape;
    Loan<btRigidBody, Rigid> body;
    // For a fragment: its plant, and the model's frame in the body's frame when it came off.
    PlantBody* grown_on = nullptr;
    Mat3 grown_turn = Mat3::Identity();
    Vec3 grown_shift = Vec3::Zero();
    bool has_left = false;  // the plant: since then the two touch
};

// Returns how many of frond_rigid_def's three sizes a shape has.
int size_count(frond_shape shape);
// Makes a rigid body in a world. The caller has checked `def`.
Rigid* add_rigid(World& world, const frond_rigid_def& def);
void remove_rigid(World& world, Rigid* rigid);
// Forgets a rigid body that the host deletes. A fragment of a plant stays where it was, out of the Bullet world.
void host_deleted(Rigid& rigid, btRigidBody& body);
frond_rigid_state state_of(const Rigid& rigid);
void set_state(Rigid& rigid, const frond_rigid_state& state);

// Leads the kinematic bodies that were put elsewhere there, in even parts over the substeps of a step: Bullet would
// have them go all the way in the first one and stand still in the others. What a step broken off has left is gone at
// the end.
class Leader {
public:
    explicit Leader(const World& world);
    ~Leader() { lead(1); }
    Leader(const Leader&) = delete;
    Leader& operator=(const Leader&) = delete;
    // Puts each body at a share of its way.
    void lead(double share) const;
    // Returns the farthest way of a body that may come past a plant [m].
    double way_past_plants(World& world) const;

private:
    struct Led {
        btRigidBody* body;
        btTransform from, to;
    };
    std::vector<Led> bodies;
};

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
