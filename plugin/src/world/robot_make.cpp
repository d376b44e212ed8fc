// Makes a robot: a tree of links comes in, a multi-body with motors and limits in the Bullet world goes out. Frames and
// offsets follow btMultiBody.h: links' frames are at their centres of mass, along principal axes.
#include <BulletCollision/CollisionShapes/btEmptyShape.h>

#include <algorithm>

#include "core/convert.hpp"
#include "core/decompose.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "world/convert.hpp"
#include "world/robot.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

UrdfFrame inverse(const UrdfFrame& frame) {
    return {frame.turn.conjugate() * -frame.origin, frame.turn.conjugate()};
}

// Drops the root on which a floating base hangs: it only stands for the world. False if no joint floats.
bool drop_floating_root(UrdfTree& tree) {
    const auto floats = [](const UrdfLink& link) { return link.joint == UrdfJoint::FLOATING; };
    if (std::none_of(tree.links.begin(), tree.links.end(), floats)) return false;
    const UrdfLink& root = tree.links.front();
    const bool is_lone =
        tree.links.size() > 1 && floats(tree.links[1]) && root.collisions.empty() && root.mass == 0 &&
        std::count_if(tree.links.begin(), tree.links.end(), floats) == 1 &&
        std::none_of(tree.links.begin() + 2, tree.links.end(), [](const UrdfLink& link) { return link.parent == 0; });
    if (!is_lone)
        fail(FROND_RESULT_UNSUPPORTED,
             "only the one joint of a root without mass and shapes may float; give each floating part a file of "
             "its own");
    tree.links.erase(tree.links.begin());
    for (UrdfLink& link : tree.links) link.parent--;
    tree.links.front().joint = UrdfJoint::FIXED;
    return true;
}

// Finds a link's mass and principal inertia. A link that moves needs some inertia, or any force would accelerate its
// joint without limit.
RobotLink weigh(const UrdfLink& link, bool needs_mass) {
    constexpr double LIGHT = 0.01, SIZE = 0.02;  // mass of links without any, size for the least inertia [kg], [m]
    RobotLink out;
    out.centre = link.centre;
    out.mass = link.mass;
    const SymmetricParts principal = symmetric_parts(link.inertia);
    Mat3 axes = principal.vectors;
    if (axes.determinant() < 0) axes.col(0) *= -1;
    out.centre.turn = (link.centre.turn * Quat(axes)).normalized();
    out.inertia = principal.values.cwiseMax(0);
    if (!needs_mass) return out;
    if (out.mass < 1e-6) {
        warn("link \"%s\" moves and has no mass; taking %g kg", link.name.c_str(), LIGHT);
        out.mass = LIGHT;
    }
    out.inertia = out.inertia.cwiseMax(0.1 * out.mass * SIZE * SIZE);
    return out;
}

void set_up_joint(Robot& robot, size_t i) {
    const UrdfLink& link = robot.tree.links[i];
    const RobotLink &own = robot.links[i], &parent = robot.links[size_t(link.parent)];
    const UrdfFrame joint = inverse(parent.centre) * link.frame, back = inverse(own.centre);
    const btQuaternion turn = to_bullet(Quat(back.turn * joint.turn.conjugate()));
    const btVector3 to_pivot = to_bullet(joint.origin), to_centre = to_bullet(Vec3(-back.origin));
    const btVector3 axis = to_bullet(Vec3(back.turn * link.axis)), inertia = to_bullet(own.inertia);
    const int number = int(i) - 1, above = link.parent - 1;
    const btScalar mass = btScalar(own.mass);
    if (link.joint == UrdfJoint::FIXED)
        robot.body->setupFixed(number, mass, inertia, above, turn, to_pivot, to_centre);
    else if (link.joint == UrdfJoint::PRISMATIC)
        robot.body->setupPrismatic(number, mass, inertia, above, turn, axis, to_pivot, to_centre, true);
    else
        robot.body->setupRevolute(number, mass, inertia, above, turn, axis, to_pivot, to_centre, true);
}

// Bullet solves the motor of a link only if the link has a collider, which may be empty.
void add_collider(Robot& robot, size_t i, const frond_robot_def& def) {
    RobotLink& link = robot.links[i];
    const UrdfLink& of_file = robot.tree.links[i];
    if (!make_shapes(robot.tree, of_file, link.centre, link)) {
        if (of_file.joint == UrdfJoint::FIXED) return;
        link.shapes.push_back(std::make_unique<btEmptyShape>());
    }
    link.collider = lend<btMultiBodyLinkCollider>(robot, robot.body.get(), int(i) - 1);
    link.collider->setCollisionShape(link.shapes.back().get());
    link.collider->setFriction(btScalar(def.friction));
    if (i == 0)
        robot.body->setBaseCollider(link.collider.get());
    else
        robot.body->getLink(int(i) - 1).m_collider = link.collider.get();
    if (i == 0 && robot.body->hasFixedBase())
        link.collider->setCollisionFlags(link.collider->getCollisionFlags() | btCollisionObject::CF_STATIC_OBJECT);
}

void add_constraints(Robot& robot, size_t i) {
    const UrdfLink& link = robot.tree.links[i];
    RobotLink& own = robot.links[i];
    if (link.joint == UrdfJoint::FIXED) return;
    btMultiBody* body = robot.body.get();
    own.motor = lend<btMultiBodyJointMotor>(robot, body, int(i) - 1, btScalar(0), btScalar(0));
    own.motor->finalizeMultiDof();
    robot.bullet->addMultiBodyConstraint(own.motor.get());
    if (link.joint == UrdfJoint::CONTINUOUS) return;
    own.limit =
        lend<btMultiBodyJointLimitConstraint>(robot, body, int(i) - 1, btScalar(link.lower), btScalar(link.upper));
    own.limit->finalizeMultiDof();
    robot.bullet->addMultiBodyConstraint(own.limit.get());
}

std::unique_ptr<Robot> make_robot(World& world, UrdfTree tree, const frond_robot_def& def) {
    auto robot = std::make_unique<Robot>();
    robot->world = &world;
    robot->bullet = dynamic_cast<btMultiBodyDynamicsWorld*>(world.bullet);
    if (!robot->bullet)
        fail(FROND_RESULT_UNSUPPORTED, "this Bullet world takes no multi-bodies; make it a btMultiBodyDynamicsWorld");
    const bool floats = drop_floating_root(tree);
    const bool is_fixed = def.is_fixed && !floats;
    robot->surface = make_surface(tree);
    robot->tree = std::move(tree);
    for (size_t i = 0; i < robot->tree.links.size(); i++) {
        const UrdfLink& link = robot->tree.links[i];
        robot->links.push_back(weigh(link, i == 0 ? !is_fixed : link.joint != UrdfJoint::FIXED));
    }
    const RobotLink& base = robot->links.front();
    robot->body = lend<btMultiBody>(*robot, int(robot->links.size()) - 1, btScalar(is_fixed ? 0 : base.mass),
                                    to_bullet(base.inertia), is_fixed, false);
    btMultiBody& body = *robot->body;
    UrdfFrame placed = {to_vec(def.position), to_quat(def.rotation).normalized()};
    if (floats) placed = placed * robot->tree.links.front().frame;
    const UrdfFrame frame = placed * base.centre;
    body.setBaseWorldTransform(btTransform(to_bullet(frame.turn), to_bullet(frame.origin)));
    for (size_t i = 1; i < robot->links.size(); i++) set_up_joint(*robot, i);
    body.finalizeMultiDof();
    body.setHasSelfCollision(false);
    body.setCanSleep(false);
    body.setLinearDamping(0);
    body.setAngularDamping(0);
    return robot;
}

}  // namespace

Robot* add_robot(World& world, UrdfTree tree, const frond_robot_def& def) {
    // With Bullet's ten iterations motors sag and yield to each other and to limits. A host's own world is left alone.
    constexpr int ROUNDS = 100;
    std::unique_ptr<Robot> robot = make_robot(world, std::move(tree), def);
    if (world.own) robot->bullet->getSolverInfo().m_numIterations = ROUNDS;
    for (size_t i = 0; i < robot->links.size(); i++) add_collider(*robot, i, def);
    robot->bullet->addMultiBody(robot->body.get());
    for (size_t i = 1; i < robot->links.size(); i++) {
        add_constraints(*robot, i);
        const UrdfLink& link = robot->tree.links[i];
        if (!moves(*robot, i)) continue;
        const double start = link.joint == UrdfJoint::CONTINUOUS ? 0 : std::clamp(0.0, link.lower, link.upper);
        put_joint(*robot, i, start);
    }
    for (size_t i = 0; i < robot->links.size(); i++) {
        btCollisionObject* collider = robot->links[i].collider.get();
        const bool touches = !robot->tree.links[i].collisions.empty();
        if (collider) robot->bullet->addCollisionObject(collider, touches ? def.group : 0, touches ? def.mask : 0);
    }
    world.robots.push_back(std::move(robot));
    return world.robots.back().get();
}

void remove_robot(World& world, Robot* robot) {
    for (const RobotLink& link : robot->links) {
        for (btMultiBodyConstraint* constraint : {static_cast<btMultiBodyConstraint*>(link.motor.get()),
                                                  static_cast<btMultiBodyConstraint*>(link.limit.get())})
            if (constraint) robot->bullet->removeMultiBodyConstraint(constraint);
        if (!link.collider) continue;
        wake_neighbours(world, *link.collider);
        robot->bullet->removeCollisionObject(link.collider.get());
        forget_body(world, *link.collider);
    }
    if (robot->body) robot->bullet->removeMultiBody(robot->body.get());
    const auto is_it = [&](const std::unique_ptr<Robot>& other) { return other.get() == robot; };
    world.robots.erase(std::find_if(world.robots.begin(), world.robots.end(), is_it));
}

// Releases the robot's handle with the first part, and the robot with the last one.
static void lose_part(Robot& robot) {
    World& world = *robot.world;
    if (!robot.is_gone && world.release.robot) world.release.robot(robot);
    robot.is_gone = true;
    const bool has_parts = std::any_of(robot.links.begin(), robot.links.end(),
                                       [](const RobotLink& link) { return link.collider || link.motor || link.limit; });
    if (has_parts || robot.body) return;
    const auto is_it = [&](const std::unique_ptr<Robot>& other) { return other.get() == &robot; };
    world.robots.erase(std::find_if(world.robots.begin(), world.robots.end(), is_it));
}

void host_deleted(Robot& robot, btMultiBody&) {
    leave_to_host(robot.body);
    lose_part(robot);
}

void host_deleted(Robot& robot, btMultiBodyLinkCollider& collider) {
    for (size_t i = 0; i < robot.links.size(); i++) {
        if (robot.links[i].collider.get() != &collider) continue;
        leave_to_host(robot.links[i].collider);
        if (robot.body && i == 0) robot.body->setBaseCollider(nullptr);
        if (robot.body && i > 0) robot.body->getLink(int(i) - 1).m_collider = nullptr;
    }
    forget_body(*robot.world, collider);
    lose_part(robot);
}

void host_deleted(Robot& robot, btMultiBodyConstraint& constraint) {
    for (RobotLink& link : robot.links) {
        if (link.motor.get() == &constraint) leave_to_host(link.motor);
        if (link.limit.get() == &constraint) leave_to_host(link.limit);
    }
    lose_part(robot);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
