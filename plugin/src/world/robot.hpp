// Robot: a multi-body of the Bullet world made from a URDF file, with a motor at every joint that moves.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointLimitConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointMotor.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <memory>

#include "frond/frond_robot.h"
#include "model/urdf.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// A link of the file. Its frame in that of Bullet's link, which is at the centre of mass along principal axes, is the
// inverse of `centre`.
struct RobotLink {
    UrdfFrame centre;
    double mass = 0;                                         // [kg]
    Vec3 inertia = Vec3::Zero();                             // about the principal axes [kg m^2]
    std::vector<std::unique_ptr<btCollisionShape>> shapes;   // of the collider's, which comes last
    std::unique_ptr<btMultiBodyLinkCollider> collider;       // null: it touches nothing and its joint is fixed
    std::unique_ptr<btMultiBodyJointMotor> motor;            // null: the joint is fixed
    std::unique_ptr<btMultiBodyJointLimitConstraint> limit;  // null: it has none
    double motor_force = 0;                                  // at most; 0: it lets go [N], [N m]
    double speed = 0;                                        // that the motor keeps; 0: none [rad/s], [m/s]
};

// The surface of a robot, each vertex in its link's frame.
struct RobotSurface {
    std::vector<Vec3> places;  // [m]
    std::vector<int> link;     // of each place
    std::vector<Triangle> triangles;
    std::vector<float> positions;  // of the last look, world frame
};

struct Robot {
    World* world;
    btMultiBodyDynamicsWorld* bullet;
    uint64_t handle = 0;  // of the C API
    UrdfTree tree;        // links[i] is link i - 1 of Bullet's, 0 its base
    std::vector<RobotLink> links;
    std::unique_ptr<btMultiBody> body;
    RobotSurface surface;
};

// Throws UNSUPPORTED with the remedy; `def` has been checked by the caller.
Robot* add_robot(World& world, UrdfTree tree, const frond_robot_def& def);
void remove_robot(World& world, Robot* robot);
// A collision shape for the link, in Bullet's frame; false if it has none.
bool make_shapes(const UrdfTree& tree, const UrdfLink& link, const UrdfFrame& centre, RobotLink& out);

RobotSurface make_surface(const UrdfTree& tree);
// Writes RobotSurface::positions.
void update_surface(Robot& robot);

bool moves(const Robot& robot, size_t link);             // its joint does
double joint_position(const Robot& robot, size_t link);  // [rad], [m]
double joint_velocity(const Robot& robot, size_t link);
void put_joint(Robot& robot, size_t link, double position);
void shift_base(Robot& robot, const Vec3& origin);  // the world's origin moves there
// Targets of a motor; what force it has at most.
void drive_to(Robot& robot, size_t link, double position, double speed, double force);
void drive_at(Robot& robot, size_t link, double velocity, double force);
// Before a substep of h [s]: a motor's limit is an impulse, and none goes on where its joint ends.
void limit_motors(World& world, double h);
UrdfFrame frame_of(const Robot& robot, size_t link);  // of the file's link, in the world
Vec3 centre_of(const Robot& robot, size_t link);      // of its mass, in the world [m]

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
