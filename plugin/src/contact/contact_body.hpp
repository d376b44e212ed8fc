// ContactBody: the body on the other side of a plant's contact: a rigid body, a link of a multi-body, or an immovable
// object.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <btBulletDynamicsCommon.h>

#include <array>
#include <vector>

#include "core/types.hpp"
#include "frond/frond_bullet.hpp"
#include "plant/plant.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct ContactBody {
    btCollisionObject* object;
    btRigidBody* rigid = nullptr;  // the body, if impulses move it
    btMultiBodyLinkCollider* link = nullptr;
    Vec3 point, velocity;                                           // contact point and its velocity [m], [m/s]
    std::array<std::vector<btScalar>, 3> jacobian, unit_responses;  // a multi-body's, for each axis of the world
};

// Returns whether an object is a rigid body that contacts push: neither static nor kinematic, and no link.
bool is_free(const btCollisionObject& object);
// Wakes a sleeping body if the plant moves towards it; `normal` points to the plant.
void wake(btCollisionObject& object, const Vec3& normal, const Vec3& plant_velocity);
// Returns the velocity of a rigid body at a point; zero for other objects [m/s].
Vec3 velocity_at(const btCollisionObject& object, const Vec3& p);
// Has a multi-body compute its inertia where it is now: Bullet's is of before the step in which it
// went there, by which impulses would give it energy. Call it before contact bodies of it are made.
void take_present_inertia(btMultiBody& body);
// Makes a contact body at a point. A free body's velocity includes what gravity adds in its next step of h [s].
ContactBody make_contact_body(btCollisionObject& object, const Vec3& point, double h);
// Returns the velocity at `at` by a unit impulse at `by` [1/kg]; zero unless both are on the same movable body.
Mat3 compliance_between(const ContactBody& at, const ContactBody& by);
// An impulse on a movable body [N s].
struct BodyPush {
    const ContactBody* body;
    Vec3 impulse;
};
// Applies all impulses of an island's bodies.
void take_impulses(const std::vector<BodyPush>& pushes);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
