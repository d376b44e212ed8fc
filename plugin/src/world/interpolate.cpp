// In: a Bullet world between two of its fixed steps. Out: how long before the end of the last one its motion states
// show bodies, as btDiscreteDynamicsWorld::synchronizeSingleMotionState computes it, so that surfaces agree with them.
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// Gives access to Bullet's protected rest of a host's frame.
struct LeftOver : btDiscreteDynamicsWorld {
    static double back(const btDiscreteDynamicsWorld& world) {
        const double left = double(world.*(&LeftOver::m_localTime)), step = double(world.*(&LeftOver::m_fixedTimeStep));
        return world.getLatencyMotionStateInterpolation() && step > 0 ? step - left : -left;
    }
};

}  // namespace

double surfaces_back(const World& world) {
    if (world.interpolation != FROND_INTERPOLATION_AS_MOTION_STATES)
        return (1 - world.interpolation) * world.substep_length;
    const auto* discrete = dynamic_cast<const btDiscreteDynamicsWorld*>(world.bullet);
    return discrete ? LeftOver::back(*discrete) : 0;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
