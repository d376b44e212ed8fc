// A plant's impulse on a body acts in the body's next step and balances the gravity of that step (contact_body.hpp). So
// that the host sees a resting body at rest, that gravity is added with the impulse, and cancelled in the step.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <vector>

#include "frond/frond_bullet.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct GravityAhead {
    struct Held {
        btRigidBody* body;  // may be gone by the time of the next step
        btVector3 force;    // force that cancels its gravity [N]
    };
    std::vector<Held> bodies;
    bool is_held = false;  // the forces have been applied to the bodies
};

// Adds the gravity of the next step of h [s] to a body's velocity, once per body. Call it in an action.
void give_gravity(GravityAhead& ahead, btRigidBody& body, double h);
// Applies the cancelling forces. Call it before Bullet's solver, once or several times.
void hold_gravity(GravityAhead& ahead, const btCollisionWorld& world);
// Takes the forces back. Call it after Bullet's solver, before the next give_gravity.
void end_hold(GravityAhead& ahead, const btCollisionWorld& world);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
