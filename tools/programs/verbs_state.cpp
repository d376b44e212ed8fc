// Operations that set a plant's state, or break it.
#include <algorithm>
#include <cmath>

#include "programs/run.hpp"
#include "programs/source.hpp"

namespace frond::programs {

namespace {

double size_of(const frond_vec3& v) {
    return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

void run_kick(Run& run, const Operation& o) {
    kick(plant_of(run, o).handle, xyz(o));
    run.loads.speed = std::max(run.loads.speed, size_of(xyz(o)));
}
void write_kick(Source& s, const Operation& o) {
    s.line("kick(%s, %s);", plant_name(o).c_str(), vec_text(xyz(o)).c_str());
}

void run_bend(Run& run, const Operation& o) {
    Standing& plant = plant_of(run, o);
    bend(plant.handle, xyz(o));
    plant.is_strained = true;
    // What is put far away may have any energy.
    run.loads.speed = std::max(run.loads.speed, 50.0);
}
void write_bend(Source& s, const Operation& o) {
    s.line("bend(%s, %s);", plant_name(o).c_str(), vec_text(xyz(o)).c_str());
}

void put(Run& run, const Operation& o) {
    Standing& plant = plant_of(run, o);
    const double turn = 0.5 * number(o, "turn");
    frond_plant_def def = {};
    if (frond_plant_get_def(plant.handle, &def) != FROND_OK) return;
    const frond_vec3 by = xyz(o);
    const frond_vec3 to = {def.position.x + by.x, def.position.y + by.y, def.position.z + by.z};
    run.check(frond_plant_set_transform(plant.handle, to, {0, std::sin(turn), 0, std::cos(turn)}));
    plant.is_changed = true;
    plant.carried += size_of(by) + 2 * plant.size;
}
void write_put(Source& s, const Operation& o) {
    const double turn = 0.5 * number(o, "turn");
    const std::string plant = plant_name(o);
    s.line("{");
    s.line("    frond_plant_def def;");
    s.line("    const frond_quat turn = {0, %s, 0, %s};", text_of(std::sin(turn)).c_str(),
           text_of(std::cos(turn)).c_str());
    s.line("    if (frond_plant_get_def(%s, &def) == FROND_OK)", plant.c_str());
    s.line("        frond_plant_set_transform(%s, moved(def.position, %s), turn);", plant.c_str(),
           vec_text(xyz(o)).c_str());
    s.line("}");
}

void reset(Run& run, const Operation& o) {
    Standing& plant = plant_of(run, o);
    run.check(frond_plant_reset(plant.handle));
}
void write_reset(Source& s, const Operation& o) {
    s.line("frond_plant_reset(%s);", plant_name(o).c_str());
}

void wake(Run& run, const Operation& o) {
    run.check(frond_plant_wake(plant_of(run, o).handle));
}
void write_wake(Source& s, const Operation& o) {
    s.line("frond_plant_wake(%s);", plant_name(o).c_str());
}

void break_off(Run& run, const Operation& o) {
    Standing& plant = plant_of(run, o);
    const int count = frond_plant_get_capsule_count(plant.handle);
    if (count > 0) run.check(frond_plant_break(plant.handle, whole(o, "capsule") % count));
}
void write_break(Source& s, const Operation& o) {
    const std::string plant = plant_name(o);
    s.line("frond_plant_break(%s, %d %% frond_plant_get_capsule_count(%s));", plant.c_str(), whole(o, "capsule"),
           plant.c_str());
}

// Gives a plant another one's state.
void copy_state(Run& run, const Operation& o) {
    const Standing& from = plant_of(run, o);
    Standing& to = run.plants.at(o.of[1]);
    if (from.model.id != to.model.id) return;
    const Places x = places_of(from.handle), v = velocities_of(from.handle);
    run.check(frond_plant_set_state(to.handle, &x[0].x, &v[0].x, int(x.size())));
    to.is_changed = to.is_strained = true;
    to.carried += size_of(x[0]) + size_of(to.home[0]) + from.carried;
}
void write_copy(Source& s, const Operation& o) {
    s.line("copy_state(plant_%d, plant_%d);", o.of[0], o.of[1]);
}

}  // namespace

std::vector<Verb> state_verbs() {
    constexpr Kind NONE = Kind::NONE, PLANT = Kind::PLANT;
    constexpr Scale WHOLE = Scale::WHOLE;
    return {
        {"kick",
         NONE,
         {PLANT, NONE},
         2,
         {{"x", 2, -5, 5, 0.9}, {"y", 0, -2, 2, 0.2}, {"z", 0, -5, 5, 0.6}},
         run_kick,
         write_kick},
        {"bend",
         NONE,
         {PLANT, NONE},
         1,
         {{"x", 0.2, -0.6, 0.6, 0.9}, {"y", 0, -0.2, 0.1, 0.3}, {"z", 0, -0.6, 0.6, 0.6}},
         run_bend,
         write_bend},
        {"put",
         NONE,
         {PLANT, NONE},
         1,
         {{"x", 0.5, -2, 2, 0.8}, {"y", 0, 0, 0.5, 0.2}, {"z", 0, -2, 2, 0.5}, {"turn", 0, -3.14, 3.14, 0.5}},
         put,
         write_put},
        {"reset", NONE, {PLANT, NONE}, 1, {}, reset, write_reset},
        {"wake", NONE, {PLANT, NONE}, 1, {}, wake, write_wake},
        {"break", NONE, {PLANT, NONE}, 1, {{"capsule", 3, 1, 1000, 0.9, WHOLE}}, break_off, write_break},
        {"copy_state", NONE, {PLANT, PLANT}, 1, {}, copy_state, write_copy},
    };
}

}  // namespace frond::programs
