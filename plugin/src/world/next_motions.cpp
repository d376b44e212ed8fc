#include "world/next_motions.hpp"

#include <algorithm>

#include "core/lists.hpp"
#include "world/is_in.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

using Held = NextMotions::Held;

static Held* find(NextMotions& next, const btRigidBody& body) {
    const auto is_it = [&](const Held& held) { return held.body == &body; };
    const auto found = std::find_if(next.bodies.begin(), next.bodies.end(), is_it);
    return found == next.bodies.end() ? nullptr : &*found;
}

void give_gravity(NextMotions& next, btRigidBody& body, double h) {
    if (!(body.getInvMass() > 0) || find(next, body)) return;
    const btVector3 none(0, 0, 0);
    body.setLinearVelocity(body.getLinearVelocity() + btScalar(h) * body.getGravity());
    next.bodies.push_back({&body, -body.getGravity() / body.getInvMass(), none, none, none});
}

void go_share_of_motion(NextMotions& next, btRigidBody& body, double share, double h) {
    give_gravity(next, body, h);
    Held* held = find(next, body);
    if (!held) return;
    const btScalar rest = btScalar(1 - share), step = btScalar(h);
    const btVector3 &velocity = body.getLinearVelocity(), &spin = body.getAngularVelocity();
    held->force -= rest / (step * body.getInvMass()) * velocity;
    held->torque = -rest / step * (body.getInvInertiaTensorWorld().inverse() * spin);
    // Gravity acts for that share of the step too.
    held->velocity = rest * (velocity - step * body.getGravity());
    held->angular_velocity = rest * spin;
}

// Forgets bodies that the host has taken out of its world, without dereferencing them.
static void forget_gone(NextMotions& next, const btCollisionWorld& world) {
    const auto is_gone = [&](const Held& held) { return !is_in(world, held.body); };
    remove_where(next.bodies, is_gone);
}

void hold_motions(NextMotions& next, const btCollisionWorld& world) {
    if (next.is_held || next.bodies.empty()) return;
    forget_gone(next, world);
    for (const Held& held : next.bodies) {
        held.body->applyCentralForce(held.force);
        held.body->applyTorque(held.torque);
    }
    next.is_held = true;
}

void end_hold(NextMotions& next, const btCollisionWorld& world) {
    if (next.is_held) {
        forget_gone(next, world);
        for (const Held& held : next.bodies) {
            held.body->applyCentralForce(-held.force);
            held.body->applyTorque(-held.torque);
            held.body->setLinearVelocity(held.body->getLinearVelocity() + held.velocity);
            held.body->setAngularVelocity(held.body->getAngularVelocity() + held.angular_velocity);
        }
    }
    next.bodies.clear();
    next.is_held = false;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
