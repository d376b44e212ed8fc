// ContactBody: the other side of a contact, a body of the host's: rigid, a link of a multi-body, or one that nothing
// moves.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <btBulletDynamicsCommon.h>

#include <array>
#include <vector>

#include "core/types.hpp"
#include "frond/frond_bullet.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct ContactBody {
    btCollisionObject* object;
    btRigidBody* rigid = nullptr;  // that impulses move
    btMultiBodyLinkCollider* link = nullptr;
    Vec3 point, velocity;  // where it is touched, and how fast that moves [m], [m/s]
    std::array<std::vector<btScalar>, 3> jacobian, unit_responses;  // of a multi-body, along the world's axes
};

// Wakes a body that sleeps in the way of a plant that moves there; `normal` points to the plant.
void wake(btCollisionObject& object, const Vec3& normal, const Vec3& plant_velocity);
// With what gravity adds to a free body's velocity before it next moves, in h [s].
ContactBody make_contact_body(btCollisionObject& object, const Vec3& point, double h);
// Velocity at one by an impulse at the other [1/kg]; zero unless they are of one body that moves.
Mat3 compliance_between(const ContactBody& at, const ContactBody& by);
void take_impulse(ContactBody& contact_body, const Vec3& impulse);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
