// Robot: a multi-body of the Bullet world made from a URDF file, with a motor at every joint that moves.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointLimitConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointMotor.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <memory>

#include "frond/frond_robot.h"
#include "io/urdf.hpp"
#include "world/lent.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct Robot;

// A link of the file. `centre` is the frame of Bullet's link in the file's: at the centre of mass, along principal
// axes.
struct RobotLink {
    UrdfFrame centre;
    double mass = 0;                                        // [kg]
    Vec3 inertia = Vec3::Zero();                            // about the principal axes [kg m^2]
    std::vector<std::unique_ptr<btCollisionShape>> shapes;  // parts of the collider's shape, which comes last
    Loan<btMultiBodyLinkCollider, Robot> collider;          // null: it touches nothing and its joint is fixed
    Loan<btMultiBodyJointMotor, Robot> motor;               // null: the joint is fixed
    Loan<btMultiBodyJointLimitConstraint, Robot> limit;     // null: it has none
    double motor_force = 0;                                 // largest force; 0: the joint is free [N], [N m]
    double speed = 0;                                       // velocity that the motor keeps; 0: none [rad/s], [m/s]
};

// The surface of a robot, each vertex in its link's frame.
struct RobotSurface {
    std::vector<Vec3> places;  // [m]
    std::vector<int> link;     // link of each vertex
    std::vector<Triangle> triangles;
    std::vector<float> positions;  // positions at the last update, world frame [m]
};

struct Robot {
    World* world;
    btMultiBodyDynamicsWorld* bullet;
    uint64_t handle = 0;  // handle in the C API
    UrdfTree tree;        // links[i] is link i - 1 of Bullet's, 0 its base
    std::vector<RobotLink> links;
    Loan<btMultiBody, Robot> body;
    bool is_gone = false;  // the host has deleted a part of it
    RobotSurface surface;
};

// Makes a robot. Throws UNSUPPORTED with the remedy. The caller has checked `def`.
Robot* add_robot(World& world, UrdfTree tree, const frond_robot_def& def);
void remove_robot(World& world, Robot* robot);
// Forget a part of a robot that the host deletes. The robot is gone with its first part; the world takes back the rest.
void host_deleted(Robot& robot, btMultiBody& body);
void host_deleted(Robot& robot, btMultiBodyLinkCollider& collider);
void host_deleted(Robot& robot, btMultiBodyConstraint& constraint);
// Makes a collision shape for the link, in Bullet's frame; false if it has none.
bool make_shapes(const UrdfTree& tree, const UrdfLink& link, const UrdfFrame& centre, RobotLink& out);

RobotSurface make_surface(const UrdfTree& tree);
// Writes RobotSurface::positions.
void update_surface(Robot& robot);

bool moves(const Robot& robot, size_t link);             // whether its joint is movable
double joint_position(const Robot& robot, size_t link);  // [rad], [m]
double joint_velocity(const Robot& robot, size_t link);
void put_joint(Robot& robot, size_t link, double position);
void shift_base(Robot& robot, const Vec3& origin);  // for a world whose origin moves there [m]
// Set the target of a motor and its largest force.
void drive_to(Robot& robot, size_t link, double position, double speed, double force);
void drive_at(Robot& robot, size_t link, double velocity, double force);
// Sets motors' largest impulses for a substep of h [s], and stops them where their joints end. Call it before the
// substep.
void limit_motors(World& world, double h);
UrdfFrame frame_of(const Robot& robot, size_t link);  // frame of the file's link, in the world
Vec3 centre_of(const Robot& robot, size_t link);      // centre of its mass, in the world [m]

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
