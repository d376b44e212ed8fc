// frond_robot_*: multi-bodies from URDF files; frond_plant_get_root_force.
#include "frond/frond_robot.hpp"

#include "api/bonds.hpp"
#include "api/call.hpp"
#include "api/robots.hpp"
#include "plant/root_force.hpp"

using namespace frond;

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Never destroyed, so that handles may still be released while the program ends.
RobotSlots& robot_slots() {
    static RobotSlots* slots = new RobotSlots;
    return *slots;
}

Robot& get(frond_robot robot) {
    Robot* found = robot_slots().find(robot.id);
    if (!found)
        fail(FROND_RESULT_BAD_HANDLE,
             "the robot handle is null, stale or of another kind; use the one of frond_robot_load");
    return *found;
}

void forget_robots(const World& world) {
    for (const std::unique_ptr<Robot>& robot : world.robots) robot_slots().erase(robot->handle);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond

namespace {

constexpr double FASTEST = 1e6, STRONGEST = 1e9, FARTHEST = 1e6;

void check_robot_def(const frond_robot_def* def) {
    check_def(def, 'U', "robot");
    check_vec(def->position, "def.position [m]");
    const frond_quat& q = def->rotation;
    const double length = Quat(q.w, q.x, q.y, q.z).norm();
    if (!(length > 1e-9 && length < 1e9))
        fail(FROND_RESULT_BAD_ARGUMENT, "def.rotation has no direction; (0,0,0,1) is none");
    check_range(def->friction, 0, 100, "def.friction");
}

size_t check_link(const Robot& robot, int link) {
    check_range(link, 0, double(robot.links.size()) - 1, "link");
    return size_t(link);
}

// Checks that a link exists and its joint can move.
size_t check_joint(const Robot& robot, int link) {
    const size_t index = check_link(robot, link);
    if (!moves(robot, index))
        fail(FROND_RESULT_BAD_ARGUMENT, "link %d, \"%s\", has no joint that moves", link,
             robot.tree.links[index].name.c_str());
    return index;
}

void check_position(const Robot& robot, size_t link, double position) {
    const UrdfLink& of_file = robot.tree.links[link];
    const bool is_free = of_file.joint == UrdfJoint::CONTINUOUS;
    check_range(position, is_free ? -FARTHEST : of_file.lower, is_free ? FARTHEST : of_file.upper,
                "position, within the joint's limits [rad], [m],");
}

frond_joint kind_of(UrdfJoint joint) {
    switch (joint) {
        case UrdfJoint::REVOLUTE:
            return FROND_JOINT_REVOLUTE;
        case UrdfJoint::CONTINUOUS:
            return FROND_JOINT_CONTINUOUS;
        case UrdfJoint::PRISMATIC:
            return FROND_JOINT_PRISMATIC;
        default:
            return FROND_JOINT_FIXED;
    }
}

// Sums the forces of plants on a link; plants that sleep count with the forces with which they fell asleep.
void add_contacts(const Robot& robot, size_t link, frond_link_state& state) {
    const World& world = *robot.world;
    const btCollisionObject* collider = robot.links[link].collider.get();
    if (!collider || !(world.substep_length > 0)) return;
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    const Vec3 centre = centre_of(robot, link);
    const auto add = [&](const Contact& contact) {
        if (contact.other != collider) return;
        const Vec3 push = -contact.impulse / world.substep_length;
        force += push;
        torque += (contact.on_plant - centre).cross(push);
        state.contact_count++;
    };
    for (const Contact& contact : world.contacts) add(contact);
    for (const std::unique_ptr<PlantBody>& body : world.bodies)
        if (body->rest.contacts)
            for (const Contact& contact : body->rest.contacts->with_bodies) add(contact);
    state.force = from_vec(force);
    state.torque = from_vec(torque);
}

}  // namespace

extern "C" {

const char* frond_joint_name(frond_joint joint) {
#define FROND_JOINT_TEXT(code, text) text,
    static const char* const NAMES[] = {FROND_JOINTS(FROND_JOINT_TEXT)};
#undef FROND_JOINT_TEXT
    const int row = number_of(joint);
    return row >= 0 && row < FROND_JOINT_COUNT ? NAMES[row] : "?";
}

frond_result frond_robot_load(frond_world world, const char* path, const frond_robot_def* def, frond_robot* out) {
    return call([&] {
        check_pointer(out, "out");
        *out = {};
        World& w = get(world);
        check_text(path, "path");
        check_robot_def(def);
        Robot* robot = add_robot(w, import_urdf(path, UrdfUse::COLLIDES), *def);
        robot->handle = robot_slots().insert(robot);
        if (!robot->handle) {
            remove_robot(w, robot);
            fail(FROND_RESULT_OUT_OF_MEMORY, "too many robots; destroy some");
        }
        out->id = robot->handle;
    });
}

void frond_robot_destroy(frond_robot robot) {
    call([&] {
        Robot* found = robot_slots().erase(robot.id);
        if (found) remove_robot(*found->world, found);
    });
}

bool frond_robot_is_valid(frond_robot robot) {
    return robot_slots().find(robot.id) != nullptr;
}

int frond_robot_get_link_count(frond_robot robot) {
    const Robot* found = robot_slots().find(robot.id);
    return found ? int(found->links.size()) : 0;
}

int frond_robot_find_link(frond_robot robot, const char* name) {
    const Robot* found = robot_slots().find(robot.id);
    for (size_t i = 0; found && name && i < found->links.size(); i++)
        if (found->tree.links[i].name == name || (i > 0 && found->tree.links[i].joint_name == name)) return int(i);
    return -1;
}

frond_result frond_robot_get_link(frond_robot robot, int link, frond_robot_link* out) {
    return call([&] {
        check_pointer(out, "out");
        *out = {};
        const Robot& found = get(robot);
        const size_t i = check_link(found, link);
        const UrdfLink& of_file = found.tree.links[i];
        const bool is_limited = of_file.joint == UrdfJoint::REVOLUTE || of_file.joint == UrdfJoint::PRISMATIC;
        out->name = of_file.name.c_str();
        out->joint_name = i == 0 ? "" : of_file.joint_name.c_str();
        out->parent = of_file.parent;
        out->joint = kind_of(of_file.joint);
        out->lower = is_limited ? of_file.lower : 0;
        out->upper = is_limited ? of_file.upper : 0;
        out->max_force = of_file.effort;
        out->mass = found.links[i].mass;
        if (!of_file.collisions.empty())
            out->body = static_cast<const btCollisionObject*>(found.links[i].collider.get());
    });
}

frond_result frond_robot_get_link_state(frond_robot robot, int link, frond_link_state* out) {
    return call([&] {
        check_pointer(out, "out");
        *out = {};
        const Robot& found = get(robot);
        const size_t i = check_link(found, link);
        const UrdfFrame frame = frame_of(found, i);
        out->position = from_vec(frame.origin);
        out->rotation = {frame.turn.x(), frame.turn.y(), frame.turn.z(), frame.turn.w()};
        out->joint_position = joint_position(found, i);
        out->joint_velocity = joint_velocity(found, i);
        const double h = found.world->substep_length;
        if (moves(found, i) && h > 0) out->motor_force = double(found.links[i].motor->getAppliedImpulse(0)) / h;
        add_contacts(found, i, *out);
    });
}

frond_result frond_robot_get_surface(frond_robot robot, frond_surface_view* out) {
    return call([&] {
        check_pointer(out, "out");
        *out = {};
        Robot& found = get(robot);
        update_surface(found);
        const RobotSurface& surface = found.surface;
        out->vertex_count = int(surface.places.size());
        out->triangle_count = int(surface.triangles.size());
        out->positions = surface.positions.data();
        out->indices = surface.triangles.empty() ? nullptr : surface.triangles.front().data();
    });
}

frond_result frond_robot_set_joint(frond_robot robot, int link, double position) {
    return call([&] {
        Robot& found = get(robot);
        const size_t i = check_joint(found, link);
        check_position(found, i, position);
        put_joint(found, i, position);
    });
}

frond_result frond_robot_drive_to(frond_robot robot, int link, double position, double max_velocity, double max_force) {
    return call([&] {
        Robot& found = get(robot);
        const size_t i = check_joint(found, link);
        check_position(found, i, position);
        check_range(max_velocity, 0, FASTEST, "max_velocity [rad/s], [m/s]");
        check_range(max_force, 0, STRONGEST, "max_force [N m], [N]");
        drive_to(found, i, position, max_velocity, max_force);
    });
}

frond_result frond_robot_drive_at(frond_robot robot, int link, double velocity, double max_force) {
    return call([&] {
        Robot& found = get(robot);
        const size_t i = check_joint(found, link);
        check_range(velocity, -FASTEST, FASTEST, "velocity [rad/s], [m/s]");
        check_range(max_force, 0, STRONGEST, "max_force [N m], [N]");
        drive_at(found, i, velocity, max_force);
    });
}

frond_result frond_robot_release(frond_robot robot, int link) {
    return call([&] {
        Robot& found = get(robot);
        found.links[check_joint(found, link)].motor_force = 0;
    });
}

frond_result frond_robot_bond(frond_plant plant, frond_vec3 point, frond_robot robot, int link, frond_bond* out) {
    return call([&] {
        check_pointer(out, "out");
        *out = {};
        PlantBody& body = look_at(get(plant));
        Robot& found = get(robot);
        const size_t i = check_link(found, link);
        if (found.world != body.world) fail(FROND_RESULT_BAD_ARGUMENT, "the robot is of another world than the plant");
        if (found.tree.links[i].collisions.empty())
            fail(FROND_RESULT_BAD_ARGUMENT, "link %d, \"%s\", has no <collision> to hold something with", link,
                 found.tree.links[i].name.c_str());
        make_bond(body, point, *found.links[i].collider, out);
    });
}

frond_result frond_plant_get_root_force(frond_plant plant, frond_vec3 about, frond_vec3* force, frond_vec3* moment) {
    return call([&] {
        for (frond_vec3* out : {force, moment})
            if (out) *out = {};
        PlantBody& body = look_at(get(plant));
        check_vec(about, "about [m]");
        const Plant& p = *body.plant;
        const bool has_weight = p.input.effects & body.world->effects & FROND_EFFECT_GRAVITY;
        const Vec3 gravity = has_weight ? gravity_of(*body.world) : Vec3(Vec3::Zero());
        const Wrench held = root_force(p, gravity, body.world->effects, to_vec(about));
        if (force) *force = from_vec(held.force);
        if (moment) *moment = from_vec(held.moment);
    });
}

}  // extern "C"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

btMultiBody* multi_body(frond_robot robot) {
    const Robot* found = robot_slots().find(robot.id);
    return found ? found->body.get() : nullptr;
}

btMultiBodyJointMotor* joint_motor(frond_robot robot, int link) {
    const Robot* found = robot_slots().find(robot.id);
    const bool exists = found && link >= 0 && size_t(link) < found->links.size();
    return exists ? found->links[size_t(link)].motor.get() : nullptr;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
