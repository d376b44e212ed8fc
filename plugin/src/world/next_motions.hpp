// What Frond changes of bodies' next motions, which Bullet makes in its next step.
//
// A plant's impulse on a body acts in the body's next motion and balances the gravity of that (contact_body.hpp). So
// that the host sees a resting body at rest, that gravity is added with the impulse, and cancelled in the step. A body
// that would go through a plant goes a share of its next motion, as if its time went on by that share: a force takes
// the rest of its velocity from it in the step, and the velocity is given back after that. Moved back instead, it was
// found to touch a stem that it had pushed with its other side, and let it through.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <vector>

#include "frond/frond_bullet.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct NextMotions {
    struct Held {
        btRigidBody* body;           // may be gone by the time of the next step
        btVector3 force;             // that acts in the step [N]
        btVector3 torque;            // [N m]
        btVector3 velocity;          // that is given back after the step [m/s]
        btVector3 angular_velocity;  // [rad/s]
    };
    std::vector<Held> bodies;
    bool is_held = false;  // the forces have been applied to the bodies
};

// Adds the gravity of the next step of h [s] to a body's velocity, once per body, for the step to cancel it. Call it in
// an action.
void give_gravity(NextMotions& next, btRigidBody& body, double h);
// Has a body go a share of its next motion. Call it in an action, once a body, after all impulses on it.
void go_share_of_motion(NextMotions& next, btRigidBody& body, double share, double h);
// Applies the forces. Call it before Bullet's solver, once or several times.
void hold_motions(NextMotions& next, const btCollisionWorld& world);
// Takes the forces back and gives velocities back. Call it after Bullet's solver, before the next of the above.
void end_hold(NextMotions& next, const btCollisionWorld& world);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
