// What a plant gives to a body counts for the body's next motion, with the gravity of that step in it: see pusher.hpp.
// For the host to see a body at rest at rest, that gravity comes with the impulse, and is held off when the step comes.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <vector>

#include "frond/frond_bullet.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct GravityAhead {
    struct Held {
        btRigidBody* body;  // may be gone by the time of the next step
        btVector3 force;    // against its gravity [N]
    };
    std::vector<Held> bodies;
    bool is_held = false;  // the forces are among the bodies' own
};

// In an action, once a body: its velocity becomes that at the end of its next step, h [s] long.
void give_gravity(GravityAhead& ahead, btRigidBody& body, double h);
// Before Bullet's solver, as often as one likes.
void hold_gravity(GravityAhead& ahead, const btCollisionWorld& world);
// After it, before anything else is given.
void end_hold(GravityAhead& ahead, const btCollisionWorld& world);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
