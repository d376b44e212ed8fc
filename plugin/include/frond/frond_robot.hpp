// frond_robot.hpp - the Bullet side of frond_robot.h, for those who have a btMultiBodyDynamicsWorld of their own:
//
//     frond::attach(my_multi_body_world, nullptr, &plants);
//     frond_robot_load(plants, "arm.urdf", &def, &robot);
//     btMultiBody* arm = frond::multi_body(robot);
#ifndef FROND_ROBOT_HPP
#define FROND_ROBOT_HPP

#include "frond/frond_bullet.hpp"
#include "frond/frond_robot.h"

class btMultiBody;
class btMultiBodyJointMotor;

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Returns the robot's multi-body, whose link n - 1 is the robot's link n, with frames at centres of mass, along
// principal axes; null for an invalid handle. Borrowed.
FROND_API btMultiBody* multi_body(frond_robot robot);
// Returns the motor of a link's joint; null for an invalid handle and for fixed joints. Borrowed.
FROND_API btMultiBodyJointMotor* joint_motor(frond_robot robot, int link);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond

#endif
