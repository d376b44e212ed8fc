// Operations that hold plants and pull at them: pins, forces, grabs, bonds.
#include <algorithm>
#include <cmath>

#include "programs/run.hpp"
#include "programs/source.hpp"

namespace frond::programs {

namespace {

frond_vec3 moved(const frond_vec3& p, const frond_vec3& by) {
    return {p.x + by.x, p.y + by.y, p.z + by.z};
}

void pin(Run& run, const Operation& o) {
    Standing& plant = plant_of(run, o);
    run.check(frond_plant_pin(plant.handle, node(plant.handle, whole(o, "node"))));
    plant.is_changed = plant.is_strained = true;
}
void write_pin(Source& s, const Operation& o) {
    s.line("frond_plant_pin(%s, node(%s, %d));", plant_name(o).c_str(), plant_name(o).c_str(), whole(o, "node"));
}

void unpin(Run& run, const Operation& o) {
    Standing& plant = plant_of(run, o);
    run.check(frond_plant_unpin(plant.handle, node(plant.handle, whole(o, "node"))));
    plant.is_changed = true;
}
void write_unpin(Source& s, const Operation& o) {
    s.line("frond_plant_unpin(%s, node(%s, %d));", plant_name(o).c_str(), plant_name(o).c_str(), whole(o, "node"));
}

void move_pin(Run& run, const Operation& o) {
    Standing& plant = plant_of(run, o);
    const int number = node(plant.handle, whole(o, "node"));
    const frond_vec3 to = moved(places_of(plant.handle)[size_t(number)], xyz(o));
    run.check(frond_plant_pin(plant.handle, number));
    run.check(frond_plant_move_pin(plant.handle, number, to));
    plant.is_changed = plant.is_strained = true;
    run.loads.speed = std::max(run.loads.speed, 60.0);
}
void write_move_pin(Source& s, const Operation& o) {
    const std::string plant = plant_name(o);
    s.line("{");
    s.line("    const int pinned = node(%s, %d);", plant.c_str(), whole(o, "node"));
    s.line("    const frond_vec3 to = moved(place(%s, pinned), %s);", plant.c_str(), vec_text(xyz(o)).c_str());
    s.line("    frond_plant_pin(%s, pinned);", plant.c_str());
    s.line("    frond_plant_move_pin(%s, pinned, to);", plant.c_str());
    s.line("}");
}

// Carries the whole plant by its foot: every pinned node goes on evenly for some steps.
void carry(Run& run, const Operation& o) {
    Standing& plant = plant_of(run, o);
    const Places from = places_of(plant.handle);
    const int count = whole(o, "count");
    const frond_vec3 way = xyz(o);
    plant.is_changed = true;
    plant.carried += 1;
    run.loads.speed = std::max(run.loads.speed, number(o, "rate") * 2);
    for (int i = 1; i <= count; i++) {
        for (size_t n = 0; n < from.size(); n++)
            frond_plant_move_pin(plant.handle, int(n),
                                 moved(from[n], {way.x * i / count, way.y * i / count, way.z * i / count}));
        run.step(1 / number(o, "rate"));
    }
}
void write_carry(Source& s, const Operation& o) {
    const std::string plant = plant_name(o);
    const frond_vec3 way = xyz(o);
    const int count = whole(o, "count");
    s.line("{");
    s.line("    const int nodes = frond_plant_get_node_count(%s);", plant.c_str());
    s.line("    frond_vec3* from = state(%s);", plant.c_str());
    s.line("    for (int i = 1; i <= %d; i++) {", count);
    s.line("        for (int n = 0; n < nodes; n++)");
    s.line("            frond_plant_move_pin(%s, n, moved(from[n], %s * i / %d, %s * i / %d, %s * i / %d));",
           plant.c_str(), text_of(way.x).c_str(), count, text_of(way.y).c_str(), count, text_of(way.z).c_str(), count);
    s.line("        %s", s.step_call(number(o, "rate")).c_str());
    s.line("    }");
    s.line("    free(from);");
    s.line("}");
    s.line("tell();");
}

// A force that acts for some steps.
void push(Run& run, const Operation& o) {
    const Standing& plant = plant_of(run, o);
    const frond_vec3 force = xyz(o);
    const double force_size = std::abs(force.x) + std::abs(force.y) + std::abs(force.z);
    run.loads.force += force_size;
    for (int i = 0; i < whole(o, "count"); i++) {
        run.loads.impulse += force_size / number(o, "rate");
        run.check(frond_plant_add_force(plant.handle, node(plant.handle, whole(o, "node")), force));
        run.step(1 / number(o, "rate"));
    }
}
void write_push(Source& s, const Operation& o) {
    const std::string plant = plant_name(o);
    s.line("for (int i = 0; i < %d; i++) {", whole(o, "count"));
    s.line("    frond_plant_add_force(%s, node(%s, %d), vec(%s));", plant.c_str(), plant.c_str(), whole(o, "node"),
           vec_text(xyz(o)).c_str());
    s.line("    %s", s.step_call(number(o, "rate")).c_str());
    s.line("}");
    s.line("tell();");
}

int chain_node(frond_plant plant, int number) {
    return number % std::max(1, frond_plant_get_chain_node_count(plant));
}
void support(Run& run, const Operation& o) {
    Standing& plant = plant_of(run, o);
    const frond_support support = {whole(o, "place") != 0, frond_held_turns(whole(o, "turns")), xyz(o)};
    run.check(frond_plant_set_support(plant.handle, chain_node(plant.handle, whole(o, "node")), &support));
    plant.is_changed = plant.is_strained = true;
}
void write_set_support(Source& s, const Operation& o, const char* support) {
    const std::string plant = plant_name(o);
    s.line("    const int count = frond_plant_get_chain_node_count(%s);", plant.c_str());
    s.line("    frond_plant_set_support(%s, count > 0 ? %d %% count : 0, %s);", plant.c_str(), whole(o, "node"),
           support);
}
void write_support(Source& s, const Operation& o) {
    s.line("{");
    s.line("    frond_support support = {%s, (frond_held_turns)%d, {0, 0, 0}};", whole(o, "place") ? "true" : "false",
           whole(o, "turns"));
    s.line("    support.axis = vec(%s);", vec_text(xyz(o)).c_str());
    write_set_support(s, o, "&support");
    s.line("}");
}

void unsupport(Run& run, const Operation& o) {
    Standing& plant = plant_of(run, o);
    run.check(frond_plant_set_support(plant.handle, chain_node(plant.handle, whole(o, "node")), nullptr));
}
void write_unsupport(Source& s, const Operation& o) {
    s.line("{");
    write_set_support(s, o, "NULL");
    s.line("}");
}

void grab(Run& run, const Operation& o) {
    Standing& plant = plant_of(run, o);
    frond_grab made = {};
    if (!run.check(
            frond_grab_create(plant.handle, vertex(plant.handle, whole(o, "vertex")), number(o, "stiffness"), &made)))
        return;
    run.grabs[o.id] = made;
    plant.is_strained = true;
}
void write_grab(Source& s, const Operation& o) {
    s.line("frond_grab grab_%d = {0};", o.id);
    s.line("frond_grab_create(%s, vertex(%s, %d), %s, &grab_%d);", plant_name(o).c_str(), plant_name(o).c_str(),
           whole(o, "vertex"), text_of(number(o, "stiffness")).c_str(), o.id);
}

void move_grab(Run& run, const Operation& o) {
    const frond_grab held = run.grabs.at(o.of[0]);
    frond_vec3 target = {};
    if (frond_grab_get(held, nullptr, &target, nullptr) != FROND_OK) return;
    run.check(frond_grab_move(held, moved(target, xyz(o))));
    run.loads.speed = std::max(run.loads.speed, 40.0);
}
void write_move_grab(Source& s, const Operation& o) {
    s.line("{");
    s.line("    frond_vec3 target;");
    s.line("    if (frond_grab_get(grab_%d, NULL, &target, NULL) == FROND_OK)", o.of[0]);
    s.line("        frond_grab_move(grab_%d, moved(target, %s));", o.of[0], vec_text(xyz(o)).c_str());
    s.line("}");
}

void let_go(Run& run, const Operation& o) {
    frond_grab_destroy(run.grabs.at(o.of[0]));
    run.grabs.erase(o.of[0]);
}
void write_let_go(Source& s, const Operation& o) {
    s.line("frond_grab_destroy(grab_%d);", o.of[0]);
}

void bond(Run& run, const Operation& o) {
    Standing& plant = plant_of(run, o);
    frond_bond made = {};
    if (!run.check(
            frond_bond_create(plant.handle, vertex(plant.handle, whole(o, "vertex")), run.bodies.at(o.of[1]), &made)))
        return;
    run.bonds[o.id] = made;
    plant.is_strained = true;
}
void write_bond(Source& s, const Operation& o) {
    s.line("frond_bond bond_%d = {0};", o.id);
    s.line("frond_bond_create(%s, vertex(%s, %d), body_%d, &bond_%d);", plant_name(o).c_str(), plant_name(o).c_str(),
           whole(o, "vertex"), o.of[1], o.id);
}

void cut_bond(Run& run, const Operation& o) {
    frond_bond_destroy(run.bonds.at(o.of[0]));
    run.bonds.erase(o.of[0]);
}
void write_cut_bond(Source& s, const Operation& o) {
    s.line("frond_bond_destroy(bond_%d);", o.of[0]);
}

}  // namespace

std::vector<Verb> hold_verbs() {
    constexpr Kind NONE = Kind::NONE, PLANT = Kind::PLANT, GRAB = Kind::GRAB, BOND = Kind::BOND;
    constexpr Scale LINEAR = Scale::LINEAR, LOG = Scale::LOG, WHOLE = Scale::WHOLE;
    const Parameter any_node = {"node", 10, 0, 1000, 0.9, WHOLE}, any_vertex = {"vertex", 10, 0, 5000, 0.9, WHOLE};
    const Parameter rate = {"rate", 60, 30, 240, 0.4, LINEAR}, count = {"count", 10, 1, 40, 0.8, WHOLE};
    const Parameter x = {"x", 0.1, -0.3, 0.3, 0.9}, y = {"y", 0, -0.1, 0.3, 0.5}, z = {"z", 0, -0.3, 0.3, 0.6};
    return {
        {"pin", NONE, {PLANT, NONE}, 1, {any_node}, pin, write_pin},
        {"unpin", NONE, {PLANT, NONE}, 1, {any_node}, unpin, write_unpin},
        {"move_pin", NONE, {PLANT, NONE}, 2, {any_node, x, y, z}, move_pin, write_move_pin},
        {"carry", NONE, {PLANT, NONE}, 2, {x, y, z, count, rate}, carry, write_carry},
        {"push",
         NONE,
         {PLANT, NONE},
         4,
         {any_node, {"x", 1, -10, 10, 0.9}, {"y", 0, -5, 5, 0.4}, {"z", 0, -10, 10, 0.6}, count, rate},
         push,
         write_push},
        {"support",
         NONE,
         {PLANT, NONE},
         2,
         {{"node", 0, 0, 60, 0.5, WHOLE},
          {"place", 1, 0, 1, 0.3, WHOLE},
          {"turns", 0, 0, FROND_HELD_TURNS_COUNT - 1, 0.8, WHOLE},
          {"x", 0, -1, 1, 0.4},
          {"y", 1, -1, 1, 0.4},
          {"z", 0, -1, 1, 0.4}},
         support,
         write_support},
        {"unsupport", NONE, {PLANT, NONE}, 1, {{"node", 0, 0, 60, 0.5, WHOLE}}, unsupport, write_unsupport},
        {"grab", GRAB, {PLANT, NONE}, 3, {any_vertex, {"stiffness", 60, 1, 1e4, 0.8, LOG}}, grab, write_grab},
        {"move_grab", NONE, {GRAB, NONE}, 4, {x, y, z}, move_grab, write_move_grab},
        {"let_go", NONE, {GRAB, NONE}, 1, {}, let_go, write_let_go},
        {"bond", BOND, {PLANT, Kind::BODY}, 3, {any_vertex}, bond, write_bond},
        {"cut_bond", NONE, {BOND, NONE}, 1, {}, cut_bond, write_cut_bond},
    };
}

}  // namespace frond::programs
