// Operations on bodies and robots.
#include <algorithm>
#include <cmath>

#include "programs/run.hpp"
#include "programs/source.hpp"

namespace frond::programs {

namespace {

frond_vec3 velocity_of(const Operation& o) {
    return {number(o, "vx"), number(o, "vy"), number(o, "vz")};
}
void note_speed(Run& run, const Operation& o) {
    const frond_vec3 v = velocity_of(o);
    run.loads.speed = std::max(run.loads.speed, std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z));
    run.loads.has_bodies = true;
}

frond_rigid_def body_def_of(const Operation& o) {
    frond_rigid_def def = frond_default_rigid_def();
    def.shape = frond_shape(whole(o, "shape"));
    def.size = {number(o, "a"), number(o, "b"), number(o, "c")};
    def.mass = number(o, "mass");
    def.friction = number(o, "friction");
    def.state.position = xyz(o);
    def.state.velocity = velocity_of(o);
    return def;
}
void add_body(Run& run, const Operation& o) {
    const frond_rigid_def def = body_def_of(o);
    frond_rigid made = {};
    if (!run.check(frond_rigid_create(run.world, &def, &made))) return;
    run.bodies[o.id] = made;
    note_speed(run, o);
}
void write_body(Source& s, const Operation& o) {
    const std::string name = "body_def_" + std::to_string(o.id);
    const frond_rigid_def def = body_def_of(o);
    s.line("frond_rigid_def %s = frond_default_rigid_def();", name.c_str());
    s.fields(name, o, {{"shape|frond_shape", "shape"}});
    s.line("%s.mass = %s, %s.friction = %s;", name.c_str(), text_of(def.mass).c_str(), name.c_str(),
           text_of(def.friction).c_str());
    s.line("%s.size = vec(%s);", name.c_str(), vec_text(def.size).c_str());
    s.line("%s.state.position = vec(%s);", name.c_str(), vec_text(def.state.position).c_str());
    s.line("%s.state.velocity = vec(%s);", name.c_str(), vec_text(def.state.velocity).c_str());
    s.line("frond_rigid body_%d = {0};", o.id);
    s.line("frond_rigid_create(world, &%s, &body_%d);", name.c_str(), o.id);
}

void add_ground(Run& run, const Operation& o) {
    frond_rigid_def def = frond_default_rigid_def();
    def.shape = FROND_SHAPE_PLANE;
    def.state.position.y = number(o, "y");
    frond_rigid made = {};
    if (run.check(frond_rigid_create(run.world, &def, &made))) run.bodies[o.id] = made;
}
void write_ground(Source& s, const Operation& o) {
    s.line("frond_rigid_def body_def_%d = frond_default_rigid_def();", o.id);
    s.line("body_def_%d.shape = FROND_SHAPE_PLANE;", o.id);
    s.line("body_def_%d.state.position.y = %s;", o.id, text_of(number(o, "y")).c_str());
    s.line("frond_rigid body_%d = {0};", o.id);
    s.line("frond_rigid_create(world, &body_def_%d, &body_%d);", o.id, o.id);
}

void move_body(Run& run, const Operation& o) {
    const frond_rigid body = run.bodies.at(o.of[0]);
    frond_rigid_state state = {};
    if (frond_rigid_get_state(body, &state) != FROND_OK) return;
    const frond_vec3 by = xyz(o);
    state.position = {state.position.x + by.x, state.position.y + by.y, state.position.z + by.z};
    state.velocity = velocity_of(o);
    run.check(frond_rigid_set_state(body, &state));
    note_speed(run, o);
    run.loads.speed = std::max(run.loads.speed, 30.0);
}
void write_move_body(Source& s, const Operation& o) {
    s.line("{");
    s.line("    frond_rigid_state state;");
    s.line("    if (frond_rigid_get_state(body_%d, &state) == FROND_OK) {", o.of[0]);
    s.line("        state.position = moved(state.position, %s);", vec_text(xyz(o)).c_str());
    s.line("        state.velocity = vec(%s);", vec_text(velocity_of(o)).c_str());
    s.line("        frond_rigid_set_state(body_%d, &state);", o.of[0]);
    s.line("    }");
    s.line("}");
}

void remove_body(Run& run, const Operation& o) {
    frond_rigid_destroy(run.bodies.at(o.of[0]));
    run.bodies.erase(o.of[0]);
}
void write_remove(Source& s, const Operation& o) {
    s.line("frond_rigid_destroy(body_%d);", o.of[0]);
}

constexpr const char* ROBOTS[] = {"arm/arm.urdf", "arm/picker.urdf"};
void add_robot(Run& run, const Operation& o) {
    frond_robot_def def = frond_default_robot_def();
    def.position = xyz(o);
    frond_robot made = {};
    if (!run.check(frond_robot_load(run.world, tools::model_path(ROBOTS[whole(o, "file")]).c_str(), &def, &made)))
        return;
    run.robots[o.id] = made;
    run.loads.has_bodies = true;
    run.loads.speed = std::max(run.loads.speed, 20.0);
}
void write_robot(Source& s, const Operation& o) {
    s.line("frond_robot_def robot_def_%d = frond_default_robot_def();", o.id);
    s.line("robot_def_%d.position = vec(%s);", o.id, vec_text(xyz(o)).c_str());
    s.line("frond_robot robot_%d = {0};", o.id);
    s.line("frond_robot_load(world, MODELS \"/%s\", &robot_def_%d, &robot_%d);", ROBOTS[whole(o, "file")], o.id, o.id);
}

int link_of(frond_robot robot, int number) {
    const int count = frond_robot_get_link_count(robot);
    return count > 1 ? 1 + number % (count - 1) : 0;
}
void drive(Run& run, const Operation& o) {
    const frond_robot robot = run.robots.at(o.of[0]);
    run.check(frond_robot_drive_to(robot, link_of(robot, whole(o, "joint")), number(o, "to"), number(o, "speed"), 0));
}
void write_drive(Source& s, const Operation& o) {
    s.line("frond_robot_drive_to(robot_%d, 1 + %d %% (frond_robot_get_link_count(robot_%d) - 1), %s, %s, 0);", o.of[0],
           whole(o, "joint"), o.of[0], text_of(number(o, "to")).c_str(), text_of(number(o, "speed")).c_str());
}

void bond_to_link(Run& run, const Operation& o) {
    Standing& plant = run.plants.at(o.of[0]);
    const frond_robot robot = run.robots.at(o.of[1]);
    frond_bond made = {};
    if (!run.check(frond_robot_bond(plant.handle, vertex(plant.handle, whole(o, "vertex")), robot,
                                    link_of(robot, whole(o, "joint")), &made)))
        return;
    run.bonds[o.id] = made;
    plant.is_strained = true;
}
void write_bond_to_link(Source& s, const Operation& o) {
    s.line("frond_bond bond_%d = {0};", o.id);
    s.line(
        "frond_robot_bond(plant_%d, vertex(plant_%d, %d), robot_%d, 1 + %d %% (frond_robot_get_link_count(robot_%d) - "
        "1), &bond_%d);",
        o.of[0], o.of[0], whole(o, "vertex"), o.of[1], whole(o, "joint"), o.of[1], o.id);
}

}  // namespace

std::vector<Verb> body_verbs() {
    constexpr Kind NONE = Kind::NONE, BODY = Kind::BODY, ROBOT = Kind::ROBOT;
    constexpr Scale LOG = Scale::LOG, WHOLE = Scale::WHOLE;
    const Parameter vx = {"vx", 0, -10, 10, 0.5}, vy = {"vy", 0, -5, 5, 0.2}, vz = {"vz", 0, -10, 10, 0.3};
    const Parameter joint = {"joint", 0, 0, 100, 0.9, WHOLE};
    return {
        {"body",
         BODY,
         {NONE, NONE},
         5,
         {{"shape", FROND_SHAPE_SPHERE, 0, FROND_SHAPE_COUNT - 2, 0.8, WHOLE},
          {"a", 0.1, 0.01, 0.5, 0.8, LOG},
          {"b", 0.1, 0.01, 0.5, 0.8, LOG},
          {"c", 0.1, 0.01, 0.5, 0.8, LOG},
          {"mass", 0, 0.005, 100, 0.7, LOG},
          {"friction", 0.5, 0, 2, 0.3},
          {"x", 0.5, -1, 1, 0.9},
          {"y", 0.5, 0, 2, 0.9},
          {"z", 0, -1, 1, 0.7},
          vx,
          vy,
          vz},
         add_body,
         write_body},
        {"ground", BODY, {NONE, NONE}, 1, {{"y", 0, -0.2, 0.1, 0.2}}, add_ground, write_ground},
        {"move_body",
         NONE,
         {BODY, NONE},
         4,
         {{"x", 0, -0.3, 0.3, 0.8}, {"y", 0, -0.3, 0.3, 0.4}, {"z", 0, -0.3, 0.3, 0.6}, vx, vy, vz},
         move_body,
         write_move_body},
        {"remove_body", NONE, {BODY, NONE}, 1, {}, remove_body, write_remove},
        {"robot",
         ROBOT,
         {NONE, NONE},
         1,
         {{"file", 0, 0, 1, 0.5, WHOLE}, {"x", 0.7, -1.5, 1.5, 0.8}, {"y", 0, 0, 0.3, 0.2}, {"z", 0, -1, 1, 0.6}},
         add_robot,
         write_robot},
        {"drive",
         NONE,
         {ROBOT, NONE},
         5,
         {joint, {"to", 0, -1.5, 1.5, 0.9}, {"speed", 1, 0.1, 3, 0.5}},
         drive,
         write_drive},
        {"bond_to_link",
         Kind::BOND,
         {Kind::PLANT, ROBOT},
         2,
         {{"vertex", 10, 0, 5000, 0.9, WHOLE}, joint},
         bond_to_link,
         write_bond_to_link},
    };
}

}  // namespace frond::programs
