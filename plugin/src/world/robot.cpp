// Joints and motors of a robot, and the places of its links.
#include "world/robot.hpp"

#include <algorithm>

#include "world/convert.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

bool moves(const Robot& robot, size_t link) {
    return robot.links[link].motor != nullptr;
}

double joint_position(const Robot& robot, size_t link) {
    return moves(robot, link) ? double(robot.body->getJointPos(int(link) - 1)) : 0;
}

double joint_velocity(const Robot& robot, size_t link) {
    return moves(robot, link) ? double(robot.body->getJointVel(int(link) - 1)) : 0;
}

// Moves the colliders to where the joints put them.
static void move_colliders(Robot& robot) {
    btAlignedObjectArray<btQuaternion> turns;
    btAlignedObjectArray<btVector3> places;
    robot.body->forwardKinematics(turns, places);
    robot.body->updateCollisionObjectWorldTransforms(turns, places);
    for (const RobotLink& link : robot.links)
        if (link.collider && link.collider->getBroadphaseHandle()) robot.bullet->updateSingleAabb(link.collider.get());
}

static const UrdfLink& file_link(const Robot& robot, size_t link) {
    return robot.tree.links[link];
}

static double force_or_file(const Robot& robot, size_t link, double force) {
    constexpr double STRONG = 1000;  // [N m], [N]
    if (force > 0) return force;
    const double effort = file_link(robot, link).effort;
    return effort > 0 ? effort : STRONG;
}

void put_joint(Robot& robot, size_t link, double position) {
    robot.body->setJointPos(int(link) - 1, btScalar(position));
    robot.body->setJointVel(int(link) - 1, 0);
    move_colliders(robot);
    drive_to(robot, link, position, 0, 0);
}

void shift_base(Robot& robot, const Vec3& origin) {
    btTransform frame = robot.body->getBaseWorldTransform();
    frame.setOrigin(to_bullet(from_bullet(frame.getOrigin()) - origin));
    robot.body->setBaseWorldTransform(frame);
    move_colliders(robot);
}

// Closes an eighth of the remaining distance per substep, which neither overshoots nor lags much.
void drive_to(Robot& robot, size_t link, double position, double speed, double force) {
    const double of_file = file_link(robot, link).speed;
    btMultiBodyJointMotor& motor = *robot.links[link].motor;
    motor.setPositionTarget(btScalar(position), btScalar(0.125));
    motor.setVelocityTarget(0, 1);
    motor.setRhsClamp(btScalar(speed > 0 ? speed : of_file > 0 ? of_file : 1));
    robot.links[link].motor_force = force_or_file(robot, link, force);
    robot.links[link].speed = 0;
}

void drive_at(Robot& robot, size_t link, double velocity, double force) {
    btMultiBodyJointMotor& motor = *robot.links[link].motor;
    motor.setPositionTarget(0, 0);
    motor.setVelocityTarget(btScalar(velocity), 1);
    motor.setRhsClamp(SIMD_INFINITY);
    robot.links[link].speed = velocity;
    robot.links[link].motor_force = force_or_file(robot, link, force);
}

void limit_motors(World& world, double h) {
    for (const std::unique_ptr<Robot>& robot : world.robots)
        for (size_t i = 1; !robot->is_gone && i < robot->links.size(); i++) {
            RobotLink& link = robot->links[i];
            if (!link.motor) continue;
            link.motor->setMaxAppliedImpulse(btScalar(link.motor_force * h));
            if (link.speed == 0 || !link.limit) continue;
            const UrdfLink& of_file = file_link(*robot, i);
            const double at = joint_position(*robot, i), low = (of_file.lower - at) / h,
                         high = (of_file.upper - at) / h;
            link.motor->setVelocityTarget(btScalar(std::clamp(link.speed, std::min(low, 0.0), std::max(high, 0.0))), 1);
        }
}

// Returns a link's frame at its centre of mass by the present joints; Bullet's cached transforms may be a substep old.
static UrdfFrame centre_frame(const Robot& robot, size_t link) {
    const int number = int(link) - 1;
    btQuaternion q;
    robot.body->localFrameToWorld(number, btMatrix3x3::getIdentity()).getRotation(q);
    return {from_bullet(robot.body->localPosToWorld(number, btVector3(0, 0, 0))),
            Quat(double(q.w()), double(q.x()), double(q.y()), double(q.z()))};
}

UrdfFrame frame_of(const Robot& robot, size_t link) {
    const UrdfFrame& centre = robot.links[link].centre;
    const Quat back = centre.turn.conjugate();
    return centre_frame(robot, link) * UrdfFrame{back * -centre.origin, back};
}

Vec3 centre_of(const Robot& robot, size_t link) {
    return centre_frame(robot, link).origin;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
