// frond_bullet.hpp - plants in a Bullet world that you own.
//
//     #include <frond/frond_bullet.hpp>
//     frond_world plants;
//     frond::attach(my_bullet_world, nullptr, &plants);      // once
//     ... frond_model_load, frond_plant_create(plants, ...)   // frond.h does the rest
//     my_bullet_world->stepSimulation(dt);                   // as before: plants step inside each substep
//     frond_world_destroy(plants);                           // before you delete the world
//
// Works with every btDynamicsWorld. Link libfrond with Bullet in single precision, libfrond-float64 with
// BT_USE_DOUBLE_PRECISION: a mix of the two does not link.
#ifndef FROND_BULLET_HPP
#define FROND_BULLET_HPP

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletDynamics/Dynamics/btDynamicsWorld.h>

#include "frond/frond.h"

#ifdef BT_USE_DOUBLE_PRECISION
#define FROND_BULLET_PRECISION bullet_float64
#else
#define FROND_BULLET_PRECISION bullet_float32
#endif

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Puts plants into `world`, which must outlive the frond_world. Gravity is the Bullet world's own, always; the def's
// gravity and max_substep are not used; null takes the defaults. Nothing of the host's is replaced: no tick callback,
// no user pointer, no filter. A world can be attached once at a time (BAD_ARGUMENT). Forces of frond_plant_add_force
// act for one substep. Call frond_world_destroy before the world is deleted and never while it steps; see
// forget() for a world that is gone already.
FROND_API frond_result attach(btDynamicsWorld* world, const frond_world_def* def, frond_world* out);

// Frees a frond_world whose Bullet world was deleted, and touches nothing of that; all its handles become stale.
// BAD_ARGUMENT as long as the Bullet world has objects of it.
//
// A host that clears its world may delete Frond's objects with all others, once it has removed them from the world as
// Bullet asks for: what they stood for is gone, and its handles are stale. The frond_world stays, until one of
//     frond_world_destroy(plants);   // the Bullet world goes on: new plants may be made in it before that
//     frond::forget(plants);         // the Bullet world was deleted too
// A robot is gone with its first part. A fragment of a plant stays where it was.
FROND_API frond_result forget(frond_world world);

// Returns the Bullet world behind a handle, Frond's own or yours; null for an invalid handle. Borrowed.
FROND_API btDynamicsWorld* bullet_world(frond_world world);

// Returns the collision object of a plant: a btCompoundShape of btCapsuleShapes, one a capsule in their order, which
// Bullet's ray tests, sweeps and contact tests see. Its user pointer and indices are yours. Null for an invalid handle.
// Borrowed.
FROND_API btCollisionObject* bullet_object(frond_plant plant);

// Makes a bond as frond_bond_create does, to a body of yours in the plant's world: rigid, a link, kinematic or static.
FROND_API frond_result bond(frond_plant plant, const btVector3& point, btCollisionObject* body, frond_bond* out);

// Returns the plant behind a collision object of Bullet's, e.g. from a ray test; null if it is not a plant's.
FROND_API frond_plant plant_of(const btCollisionObject* object);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond

#endif
