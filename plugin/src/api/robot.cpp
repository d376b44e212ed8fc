// frond_robot_*: multi-bodies from URDF files.
#include "frond/frond_robot.hpp"

#include "api/call.hpp"
#include "api/handles.hpp"
#include "world/robot.hpp"

using namespace frond;

namespace {

constexpr double FASTEST = 1e6, STRONGEST = 1e9, FARTHEST = 1e6;  // [rad/s], [m/s]; [N m], [N]; [rad], [m]

void check_robot_def(const frond_robot_def* def) {
    check_def(def, 'U', "robot");
    check_vec(def->position, "def.position [m]");
    checked_rotation(def->rotation, "def.rotation");
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

frond_result frond_robot_load(frond_world world, const char* path, const frond_robot_def* def, frond_robot* out) {
    return give(out, [&] {
        World& w = get(world);
        check_text(path, "path");
        check_robot_def(def);
        Robot* robot = add_robot(w, import_urdf(path, UrdfUse::COLLIDES), *def);
        const auto handle = handle_for<frond_robot>(robot, [&] { remove_robot(w, robot); });
        robot->handle = handle.id;
        return handle;
    });
}

void frond_robot_destroy(frond_robot robot) {
    call([&] {
        Robot* found = slots<frond_robot>().erase(robot.id);
        if (found) remove_robot(*found->world, found);
    });
}

bool frond_robot_is_valid(frond_robot robot) {
    return find(robot) != nullptr;
}

int frond_robot_get_link_count(frond_robot robot) {
    const Robot* found = find(robot);
    return found ? int(found->links.size()) : 0;
}

int frond_robot_find_link(frond_robot robot, const char* name) {
    const Robot* found = find(robot);
    for (size_t i = 0; found && name && i < found->links.size(); i++)
        if (found->tree.links[i].name == name || (i > 0 && found->tree.links[i].joint_name == name)) return int(i);
    return -1;
}

frond_result frond_robot_get_link(frond_robot robot, int link, frond_robot_link* out) {
    return give(out, [&] {
        const Robot& found = get(robot);
        const size_t i = check_link(found, link);
        const UrdfLink& of_file = found.tree.links[i];
        frond_robot_link view = {};
        const bool is_limited = of_file.joint == UrdfJoint::REVOLUTE || of_file.joint == UrdfJoint::PRISMATIC;
        view.name = of_file.name.c_str();
        view.joint_name = i == 0 ? "" : of_file.joint_name.c_str();
        view.parent = of_file.parent;
        view.joint = kind_of(of_file.joint);
        view.lower = is_limited ? of_file.lower : 0;
        view.upper = is_limited ? of_file.upper : 0;
        view.max_force = of_file.effort;
        view.mass = found.links[i].mass;
        if (!of_file.collisions.empty())
            view.body = static_cast<const btCollisionObject*>(found.links[i].collider.get());
        return view;
    });
}

frond_result frond_robot_get_link_state(frond_robot robot, int link, frond_link_state* out) {
    return give(out, [&] {
        const Robot& found = get(robot);
        const size_t i = check_link(found, link);
        frond_link_state state = {};
        const UrdfFrame frame = frame_of(found, i);
        state.position = from_vec(frame.origin);
        state.rotation = from_quat(frame.turn);
        state.joint_position = joint_position(found, i);
        state.joint_velocity = joint_velocity(found, i);
        const double h = found.world->substep_length;
        if (moves(found, i) && h > 0) state.motor_force = double(found.links[i].motor->getAppliedImpulse(0)) / h;
        add_contacts(found, i, state);
        return state;
    });
}

frond_result frond_robot_get_surface(frond_robot robot, frond_surface_view* out) {
    return give(out, [&] {
        Robot& found = get(robot);
        update_surface(found);
        const RobotSurface& surface = found.surface;
        frond_surface_view view = {};
        view.vertex_count = int(surface.places.size());
        view.triangle_count = int(surface.triangles.size());
        view.positions = surface.positions.data();
        view.indices = surface.triangles.empty() ? nullptr : surface.triangles.front().data();
        return view;
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
    return give(out, [&] {
        PlantBody& body = look_at(get(plant));
        Robot& found = get(robot);
        const size_t i = check_link(found, link);
        if (found.world != body.world) fail(FROND_RESULT_BAD_ARGUMENT, "the robot is of another world than the plant");
        if (found.tree.links[i].collisions.empty())
            fail(FROND_RESULT_BAD_ARGUMENT, "link %d, \"%s\", has no <collision> to hold something with", link,
                 found.tree.links[i].name.c_str());
        return make_bond(body, point, *found.links[i].collider);
    });
}

}  // extern "C"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

btMultiBody* multi_body(frond_robot robot) {
    const Robot* found = find(robot);
    return found ? found->body.get() : nullptr;
}

btMultiBodyJointMotor* joint_motor(frond_robot robot, int link) {
    const Robot* found = find(robot);
    const bool exists = found && link >= 0 && size_t(link) < found->links.size();
    return exists ? found->links[size_t(link)].motor.get() : nullptr;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
