// Handles of robots.
#pragma once

#include "api/handles.hpp"
#include "world/robot.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

using RobotSlots = Slots<Robot*, 7>;
RobotSlots& robot_slots();
Robot& get(frond_robot robot);
// Releases the handles of a world's robots.
void forget_robots(const World& world);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
