// Detection: whether Bullet looks for contacts for a step, or for somebody who asks it between two. It sets its own
// count of steps to 0 before it does in a step, and never reads it; Frond sets it to something else afterwards.
#pragma once

#include <btBulletDynamicsCommon.h>

namespace frond {
inline namespace FROND_BULLET_PRECISION {

constexpr int BETWEEN_STEPS = -1;

inline void end_detection(btDynamicsWorld& world) {
    world.getDispatchInfo().m_stepCount = BETWEEN_STEPS;
}
inline bool is_for_step(const btDynamicsWorld& world) {
    return world.getDispatchInfo().m_stepCount != BETWEEN_STEPS;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
