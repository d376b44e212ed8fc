// Detection: whether Bullet detects collisions for a step, or for a query between two steps. Bullet sets m_stepCount to
// 0 before it does so in a step, and never reads it; Frond sets it to another value afterwards.
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
