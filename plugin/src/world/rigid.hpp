// Rigid: a rigid body that Frond makes for a caller who has no Bullet types at hand.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>

#include "core/types.hpp"
#include "frond/frond_bullet.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct World;

struct Rigid {
    World* world;
    frond_rigid handle = {};
    bool is_plane;
    std::unique_ptr<btCollisionShape> shape;
    std::unique_ptr<btRigidBody> body;
};

// `def` has been checked by the caller.
Rigid* add_rigid(World& world, const frond_rigid_def& def);
void remove_rigid(World& world, Rigid* rigid);
frond_rigid_state state_of(const Rigid& rigid);
void set_state(Rigid& rigid, const frond_rigid_state& state);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
