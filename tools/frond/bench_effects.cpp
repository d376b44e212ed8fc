// frond bench effects: counts instructions of a step without each effect, with the effect idle, and with it at work.
//
// Valgrind's callgrind counts them, so they are exact: the command runs itself in it, steps each case there, and reads
// the count of that one step.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>

#include "bench.hpp"
#include "callgrind/count_self.hpp"
#include "callgrind/requests.hpp"
#include "study/report.hpp"

namespace frond::tools {

namespace {

// Two corn plants, a ball and the wind of one case.
struct Case {
    frond_world_def world = frond_default_world_def();
    frond_plant_def plant = frond_default_plant_def();
    double apart = 5;         // distance between the plants [m]
    double ball = 5;          // distance of the ball from the stalk [m]
    double wind = 0;          // [m/s]
    double force = 0;         // force on a leaf [N]
    bool look = false;        // the surface is requested after each step
    frond_effects never = 0;  // effects switched off because they would respond to the measured one
};

struct EffectRow {
    frond_effects effect;
    std::function<void(Case&)> idle, work;  // changes that leave the effect idle, and that put it to work
};

void nothing(Case&) {}

const std::vector<EffectRow>& rows() {
    const auto touched = [](Case& c) { c.ball = 0.1; };
    const auto blown = [](Case& c) { c.wind = 8; };
    const auto pulled = [](Case& c) { c.force = 40; };
    static const std::vector<EffectRow> table = {
        {FROND_EFFECT_GRAVITY,
         [](Case& c) {
             c.world.gravity = {0, 0, 0};
             c.never = FROND_EFFECT_FIBRES;
         },
         [](Case& c) { c.never = FROND_EFFECT_FIBRES; }},
        {FROND_EFFECT_DAMPING,
         [](Case& c) { c.plant.mass_damping = c.plant.stiffness_damping = c.plant.material_damping = 0; }, nothing},
        {FROND_EFFECT_USER_FORCE, nothing, [](Case& c) { c.force = 1; }},
        {FROND_EFFECT_SURFACE, nothing, [](Case& c) { c.look = true; }},
        {FROND_EFFECT_NORMALS, nothing, [](Case& c) { c.look = true; }},
        {FROND_EFFECT_RIGID_CONTACT, nothing, touched},
        {FROND_EFFECT_FRICTION, nothing, touched},
        {FROND_EFFECT_TWO_WAY, nothing, touched},
        {FROND_EFFECT_PLASTICITY, nothing, pulled},
        {FROND_EFFECT_PLANT_CONTACT, nothing, [](Case& c) { c.apart = 0.4; }},
        {FROND_EFFECT_SELF_CONTACT, nothing, pulled},
        {FROND_EFFECT_BREAKING, nothing, pulled},
        {FROND_EFFECT_WIND, nothing, blown},
        {FROND_EFFECT_AIR_DRAG, nothing, blown},
        {FROND_EFFECT_FIBRES, nothing, pulled},
    };
    return table;
}

// Takes some steps, of which callgrind counts the last.
void step_in_callgrind(const Case& c, frond_model model, const std::string& name) {
    constexpr int WARM_UP = 3;
    frond_world world = {};
    must(frond_world_create(&c.world, &world));
    frond_plant plants[2] = {};
    for (int i = 0; i < 2; i++) {
        frond_plant_def def = c.plant;
        def.position = {i * c.apart, 0, 0};
        must(frond_plant_create(world, model, &def, &plants[i]));
    }
    frond_rigid_def ball = frond_default_rigid_def();
    ball.mass = 0;
    ball.state.position = {0, 1, c.ball};
    frond_rigid rigid = {};
    must(frond_rigid_create(world, &ball, &rigid));
    frond_wind_def wind = frond_default_wind_def();
    wind.velocity = {c.wind, 0, 0};
    if (c.wind > 0) must(frond_world_set_wind(world, &wind));
    const int node = frond_plant_get_node_count(plants[0]) - 1;
    for (int i = 0; i <= WARM_UP; i++) {
        if (c.force > 0) must(frond_plant_add_force(plants[0], node, {c.force, 0, 0}));
        if (i == WARM_UP) CALLGRIND_TOGGLE_COLLECT;
        const frond_result stepped = frond_world_step(world, 1.0 / 60);
        frond_surface_view view;
        const frond_result looked = c.look ? frond_plant_get_surface(plants[0], &view) : FROND_OK;
        if (i == WARM_UP) CALLGRIND_TOGGLE_COLLECT;
        must(stepped);
        must(looked);
    }
    CALLGRIND_DUMP_STATS_AT(name.c_str());
    frond_world_destroy(world);
}

// Figures of one part of callgrind's output.
struct EffectCount {
    double instructions = 0;
    bool collides = false;  // code that detects contacts of plants ran
};

EffectCount read_effect_part(const std::vector<std::string>& lines) {
    static const char* const COLLISION[] = {"find_cage_contacts", "gap_between",        "find_meeting_pieces",
                                            "cover_pieces",       "place_shape",        "add_capsule_contacts",
                                            "contact_at",         "respond_to_contacts"};
    EffectCount counted;
    for (const std::string& line : lines) {
        if (begins_with(line, "totals: ")) counted.instructions = std::strtod(line.c_str() + 8, nullptr);
        if (begins_with(line, "summary: ") && counted.instructions == 0)
            counted.instructions = std::strtod(line.c_str() + 9, nullptr);
        if (!begins_with(line, "fn=") && !begins_with(line, "cfn=")) continue;
        for (const char* word : COLLISION) counted.collides |= line.find(word) != std::string::npos;
    }
    return counted;
}

std::map<std::string, EffectCount> count_in_valgrind() {
    std::map<std::string, EffectCount> all;
    for (const auto& [name, lines] : count_self("bench effects --inside", "--collect-atstart=no"))
        all[name] = read_effect_part(lines);
    if (all.empty()) throw SceneError("valgrind did not count; install it with tools/install-packages and build again");
    return all;
}

}  // namespace

void step_all_effects() {
    frond_model model = {};
    const frond_model_def def = frond_default_model_def();
    must(frond_model_load(model_path("corn/corn.obj").c_str(), &def, &model));
    for (const EffectRow& row : rows()) {
        const std::string name = frond_effect_name(row.effect);
        const auto play = [&](const char* what, frond_effects world, frond_effects plant, const auto& scene) {
            Case c;
            scene(c);
            c.world.effects = world;
            c.plant.effects = plant & ~c.never;
            step_in_callgrind(c, model, name + " " + what);
        };
        const frond_effects on = FROND_EFFECT_DEFAULT | row.effect, off = on & ~row.effect;
        play("without", FROND_EFFECT_ALL & ~row.effect, off, row.idle);
        play("off", FROND_EFFECT_ALL, off, row.idle);
        play("masked", FROND_EFFECT_ALL & ~row.effect, on, row.idle);
        play("idle", FROND_EFFECT_ALL, on, row.idle);
        play("unserved", FROND_EFFECT_ALL, off, row.work);
        play("work", FROND_EFFECT_ALL, on, row.work);
    }
    frond_model_destroy(model);
}

void bench_effects(const BenchOptions& options) {
    const std::map<std::string, EffectCount> all = count_in_valgrind();
    const char* const columns[] = {"without", "off", "masked", "idle", "unserved", "work"};
    if (options.csv)
        std::printf("effect,without,off,masked,idle,unserved,work,idle_collides,processor,compiler,version,commit\n");
    else
        std::printf(
            "instructions of a step of two corn plants of tets, by callgrind\n%s, frond %s %s\n"
            "without: of neither plant nor world; off: of the plant; masked: of the world; idle: on with nothing "
            "to do;\nunserved: off where there is something to do; work: on there\n%-14s %11s %9s %9s %9s %11s %11s\n",
            FROND_COMPILER, frond_version_string(), FROND_COMMIT, "effect", "without", "off +", "masked +", "idle +",
            "unserved", "work +");
    for (const EffectRow& row : rows()) {
        const std::string name = frond_effect_name(row.effect);
        std::map<std::string, double> n;
        for (const char* column : columns) n[column] = all.at(name + " " + column).instructions;
        if (options.csv) {
            std::printf("%s,%.0f,%.0f,%.0f,%.0f,%.0f,%.0f,%d,\"%s\",\"%s\",%s,%s\n", name.c_str(), n["without"],
                        n["off"], n["masked"], n["idle"], n["unserved"], n["work"],
                        int(all.at(name + " idle").collides), study::processor_name().c_str(), FROND_COMPILER,
                        frond_version_string(), FROND_COMMIT);
            continue;
        }
        std::printf("%-14s %11.0f %9.0f %9.0f %9.0f %11.0f %11.0f\n", name.c_str(), n["without"],
                    n["off"] - n["without"], n["masked"] - n["without"], n["idle"] - n["without"], n["unserved"],
                    n["work"] - n["unserved"]);
    }
}

}  // namespace frond::tools
