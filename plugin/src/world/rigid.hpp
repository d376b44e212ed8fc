// Rigid: a rigid body that Frond makes for a caller who has no Bullet types at hand.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "core/types.hpp"
#include "frond/frond_bullet.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct World;
struct PlantBody;

struct Rigid {
    World* world;
    frond_rigid handle = {};
    bool is_plane;
    std::vector<std::unique_ptr<btCollisionShape>> children;  // of a compound
    std::unique_ptr<btCollisionShape> shape;
    std::unique_ptr<btRigidBody> body;
    // A fragment that came off a plant: where the body's frame was in the model's one then.
    PlantBody* grown_on = nullptr;
    Mat3 grown_turn = Mat3::Identity();
    Vec3 grown_shift = Vec3::Zero();
};

// `def` has been checked by the caller.
Rigid* add_rigid(World& world, const frond_rigid_def& def);
void remove_rigid(World& world, Rigid* rigid);
frond_rigid_state state_of(const Rigid& rigid);
void set_state(Rigid& rigid, const frond_rigid_state& state);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
