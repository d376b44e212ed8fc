#include "world/gravity_ahead.hpp"

#include <algorithm>

#include "core/lists.hpp"
#include "world/is_in.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

void give_gravity(GravityAhead& ahead, btRigidBody& body, double h) {
    const auto is_it = [&](const GravityAhead::Held& held) { return held.body == &body; };
    if (!(body.getInvMass() > 0) || std::any_of(ahead.bodies.begin(), ahead.bodies.end(), is_it)) return;
    body.setLinearVelocity(body.getLinearVelocity() + btScalar(h) * body.getGravity());
    ahead.bodies.push_back({&body, -body.getGravity() / body.getInvMass()});
}

// Forgets bodies that the host has taken out of its world, without dereferencing them.
static void forget_gone(GravityAhead& ahead, const btCollisionWorld& world) {
    const auto is_gone = [&](const GravityAhead::Held& held) { return !is_in(world, held.body); };
    remove_where(ahead.bodies, is_gone);
}

void hold_gravity(GravityAhead& ahead, const btCollisionWorld& world) {
    if (ahead.is_held || ahead.bodies.empty()) return;
    forget_gone(ahead, world);
    for (const GravityAhead::Held& held : ahead.bodies) held.body->applyCentralForce(held.force);
    ahead.is_held = true;
}

void end_hold(GravityAhead& ahead, const btCollisionWorld& world) {
    if (ahead.is_held) {
        forget_gone(ahead, world);
        for (const GravityAhead::Held& held : ahead.bodies) held.body->applyCentralForce(-held.force);
    }
    ahead.bodies.clear();
    ahead.is_held = false;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
