// Operations on a world: making it, steps, wind, gravity, detail, snapshots.
#include <algorithm>
#include <cmath>

#include "frond/frond_snapshot.h"
#include "programs/run.hpp"
#include "programs/source.hpp"

namespace frond::programs {

namespace {

void make_world(Run& run, const Operation& o) {
    run.make_world(o);
}
void write_world(Source& s, const Operation& o) {
    s.host = whole(o, "host");
    s.line("frond_world_def world_def = frond_default_world_def();");
    s.fields("world_def", o,
             {{"gravity.x", "gx"},
              {"gravity.y", "gy"},
              {"gravity.z", "gz"},
              {"max_substep", "max_substep"},
              {"response|frond_response", "response"},
              {"sleep_distance", "sleep_distance"},
              {"tuning.hash_layout|frond_hash_layout", "hash_layout"}});
    if (s.host < 0) {
        s.line("frond_world_create(&world_def, &world);");
    } else {
        s.text(host_lines(s.host));
        s.line(
            "host.setGravity(btVector3(btScalar(world_def.gravity.x), btScalar(world_def.gravity.y), "
            "btScalar(world_def.gravity.z)));");
        s.line("frond::attach(&host, &world_def, &world);");
    }
    s.line("tell();");
}

void step(Run& run, const Operation& o) {
    const int count = whole(o, "count");
    for (int i = 0; i < count; i++) run.step(1 / number(o, "rate"));
}
void write_step(Source& s, const Operation& o) {
    s.line("for (int i = 0; i < %d; i++) %s", whole(o, "count"), s.step_call(number(o, "rate")).c_str());
    s.line("tell();");
}

frond_wind_def wind_of(const Operation& o) {
    frond_wind_def def = frond_default_wind_def();
    const double speed = number(o, "speed"), turn = number(o, "direction");
    def.velocity = {speed * std::cos(turn), 0, speed * std::sin(turn)};
    def.turbulence = number(o, "turbulence");
    def.profile = frond_wind_profile(whole(o, "profile"));
    def.length_scale = number(o, "length_scale");
    def.reference_height = number(o, "reference_height");
    def.seed = uint64_t(number(o, "seed"));
    return def;
}
void set_wind(Run& run, const Operation& o) {
    const frond_wind_def def = wind_of(o);
    run.check(frond_world_set_wind(run.world, &def));
    // Low profiles blow faster near the ground, gusts faster than the mean.
    run.loads.speed = std::max(run.loads.speed, 4 * number(o, "speed"));
}
void write_wind(Source& s, const Operation& o) {
    const frond_wind_def def = wind_of(o);
    s.line("frond_wind_def wind = frond_default_wind_def();");
    s.line("wind.velocity.x = %s, wind.velocity.z = %s;", text_of(def.velocity.x).c_str(),
           text_of(def.velocity.z).c_str());
    s.fields("wind", o,
             {{"turbulence", "turbulence"},
              {"profile|frond_wind_profile", "profile"},
              {"length_scale", "length_scale"},
              {"reference_height", "reference_height"},
              {"seed", "seed"}});
    s.line("frond_world_set_wind(world, &wind);");
}

void end_wind(Run& run, const Operation&) {
    run.check(frond_world_set_wind(run.world, nullptr));
}
void write_end_wind(Source& s, const Operation&) {
    s.line("frond_world_set_wind(world, NULL);");
}

// Grows no farther than 5 m from the origin: worlds may be shifted by a hundred metres.
void blow(const frond_vec3* points, int count, double, frond_vec3* velocities, void* user) {
    const double strength = *static_cast<const double*>(user);
    for (int i = 0; i < count; i++) {
        velocities[i].x += strength * std::clamp(double(points[i].y), -5.0, 5.0);
        velocities[i].z -= strength * std::clamp(double(points[i].x), -5.0, 5.0);
    }
}
void set_field(Run& run, const Operation& o) {
    run.air_field = number(o, "strength");
    run.loads.speed = std::max(run.loads.speed, 5 * std::abs(run.air_field));
    run.check(frond_world_set_wind_field(run.world, blow, &run.air_field));
}
void write_field(Source& s, const Operation& o) {
    s.line("static double strength;");
    s.line("strength = %s;", text_of(number(o, "strength")).c_str());
    s.line("frond_world_set_wind_field(world, blow, &strength);");
}

void set_gravity(Run& run, const Operation& o) {
    run.check(frond_world_set_gravity(run.world, {number(o, "x"), number(o, "y"), number(o, "z")}));
}
void write_gravity(Source& s, const Operation& o) {
    s.line("frond_world_set_gravity(world, vec(%s));",
           vec_text({number(o, "x"), number(o, "y"), number(o, "z")}).c_str());
}

void mask_effects(Run& run, const Operation& o) {
    run.check(frond_world_set_effects(run.world, frond_effects(whole(o, "effects"))));
}
void write_mask(Source& s, const Operation& o) {
    s.line("frond_world_set_effects(world, %d);", whole(o, "effects"));
}

frond_detail_def detail_of(const Operation& o) {
    frond_detail_def def = frond_default_detail_def();
    def.by_size = whole(o, "by_size") != 0;
    def.hysteresis = number(o, "hysteresis");
    return def;
}
void set_detail(Run& run, const Operation& o) {
    const frond_detail_def def = detail_of(o);
    run.check(frond_world_set_detail(run.world, &def));
    run.check(frond_world_set_viewer(run.world, {number(o, "x"), number(o, "y"), 0}));
}
void write_detail(Source& s, const Operation& o) {
    s.line("frond_detail_def detail = frond_default_detail_def();");
    s.fields("detail", o, {{"by_size", "by_size"}, {"hysteresis", "hysteresis"}});
    s.line("frond_world_set_detail(world, &detail);");
    s.line("frond_world_set_viewer(world, vec(%s));", vec_text({number(o, "x"), number(o, "y"), 0}).c_str());
}

void move_viewer(Run& run, const Operation& o) {
    run.check(frond_world_set_viewer(run.world, {number(o, "x"), number(o, "y"), 0}));
}
void write_viewer(Source& s, const Operation& o) {
    s.line("frond_world_set_viewer(world, vec(%s));", vec_text({number(o, "x"), number(o, "y"), 0}).c_str());
}

void end_detail(Run& run, const Operation&) {
    run.check(frond_world_set_detail(run.world, nullptr));
}
void write_end_detail(Source& s, const Operation&) {
    s.line("frond_world_set_detail(world, NULL);");
}

void shift(Run& run, const Operation& o) {
    const frond_vec3 by = {number(o, "x"), number(o, "y"), number(o, "z")};
    if (!run.check(frond_world_shift_origin(run.world, by))) return;
    for (auto& [id, plant] : run.plants)
        for (frond_vec3& p : plant.home) p = {p.x - by.x, p.y - by.y, p.z - by.z};
}
void write_shift(Source& s, const Operation& o) {
    s.line("frond_world_shift_origin(world, vec(%s));",
           vec_text({number(o, "x"), number(o, "y"), number(o, "z")}).c_str());
}

void save(Run& run, const Operation& o) {
    std::vector<uint8_t> bytes(frond_world_get_snapshot_size(run.world));
    if (run.check(frond_world_save(run.world, bytes.data(), bytes.size()))) run.snapshots[o.id] = std::move(bytes);
}
void write_save(Source& s, const Operation& o) {
    s.line("const size_t size_%d = frond_world_get_snapshot_size(world);", o.id);
    s.line("void* snapshot_%d = malloc(size_%d + 1);", o.id, o.id);
    s.line("frond_world_save(world, snapshot_%d, size_%d);", o.id, o.id);
}

void restore(Run& run, const Operation& o) {
    const std::vector<uint8_t>& bytes = run.snapshots.at(o.of[0]);
    run.check(frond_world_restore(run.world, bytes.data(), bytes.size()));
    for (auto& [id, plant] : run.plants) plant.is_changed = true;
}
void write_restore(Source& s, const Operation& o) {
    s.line("frond_world_restore(world, snapshot_%d, size_%d);", o.of[0], o.of[0]);
}

// Only worlds of Frond's own step on to the same bits.
void replay(Run& run, const Operation& o) {
    std::vector<uint8_t> bytes(frond_world_get_snapshot_size(run.world));
    if (!run.check(frond_world_save(run.world, bytes.data(), bytes.size()))) return;
    const int count = whole(o, "count");
    const size_t first = run.hashes.size();
    for (int round = 0; round < 2; round++) {
        for (int i = 0; i < count; i++) run.step(1 / number(o, "rate"));
        if (round == 0 && !run.check(frond_world_restore(run.world, bytes.data(), bytes.size())) &&
            run.checks(Law::REPLAY))
            throw Breach(Law::REPLAY, std::string("a snapshot is refused: ") + frond_last_error());
    }
    for (size_t i = first; i < first + size_t(count) && run.is_own() && run.checks(Law::REPLAY); i++)
        if (run.hashes[i] != run.hashes[i + size_t(count)])
            throw Breach(Law::REPLAY, "another state after " + std::to_string(i - first + 1) + " steps");
}
void write_replay(Source& s, const Operation& o) {
    const std::string step = s.step_call(number(o, "rate"));
    s.line("{");
    s.line("    const size_t size = frond_world_get_snapshot_size(world);");
    s.line("    void* snapshot = malloc(size + 1);");
    s.line("    if (frond_world_save(world, snapshot, size) == FROND_OK) {");
    s.line("        for (int i = 0; i < %d; i++) %s", whole(o, "count"), step.c_str());
    s.line("        tell();");
    s.line("        frond_world_restore(world, snapshot, size);");
    s.line("        for (int i = 0; i < %d; i++) %s", whole(o, "count"), step.c_str());
    s.line("        tell();");
    s.line("    }");
    s.line("    free(snapshot);");
    s.line("}");
}

// What only looks has to change nothing.
void look(Run& run, const Operation& o) {
    const uint64_t before = run.hash();
    frond_ray_hit hit;
    run.check(frond_world_cast_ray(run.world, {number(o, "x"), 1, -5}, {0, 0, 1}, 10, &hit));
    for (const auto& [id, plant] : run.plants) {
        frond_energy energy;
        frond_vec3 force;
        frond_surface_view view;
        std::vector<double> strains(size_t(frond_plant_get_capsule_count(plant.handle)));
        run.check(frond_plant_get_energy(plant.handle, &energy));
        run.check(frond_plant_get_air_force(plant.handle, &force));
        run.check(frond_plant_get_surface(plant.handle, &view));
        run.check(frond_plant_get_strains(plant.handle, strains.data(), int(strains.size())));
    }
    if (run.checks(Law::BITS) && run.hash() != before) throw Breach(Law::BITS, "looking changes the state");
}
void write_look(Source& s, const Operation& o) {
    s.line("frond_ray_hit hit;");
    s.line("frond_world_cast_ray(world, vec(%s), vec(0, 0, 1), 10, &hit);", vec_text({number(o, "x"), 1, -5}).c_str());
}

}  // namespace

std::vector<Verb> world_verbs() {
    constexpr Kind NONE = Kind::NONE;
    constexpr Scale LINEAR = Scale::LINEAR, LOG = Scale::LOG, WHOLE = Scale::WHOLE;
    const Parameter rate = {"rate", 60, 30, 240, 0.4, LINEAR};
    const Parameter x = {"x", 3, 0, 60, 0.8, LINEAR}, y = {"y", 1, 0, 5, 0.3, LINEAR};
    return {
        {"world",
         NONE,
         {NONE, NONE},
         0,
         {{"host", -1, 0, HOST_KINDS - 1, 0.35, WHOLE},
          {"gx", 0, -3, 3, 0.05},
          {"gy", -9.81, -15, 2, 0.1},
          {"gz", 0, -3, 3, 0.05},
          {"max_substep", 1.0 / 60, 1.0 / 240, 1.0 / 30, 0.4},
          {"response", 0, 0, FROND_RESPONSE_COUNT - 1, 0.3, WHOLE},
          {"sleep_distance", 5e-5, 1e-6, 0.01, 0.2, LOG},
          {"hash_layout", 0, 0, FROND_HASH_LAYOUT_COUNT - 1, 0.2, WHOLE}},
         make_world,
         write_world},
        {"step", NONE, {NONE, NONE}, 10, {{"count", 10, 1, 60, 0.8, WHOLE}, rate}, step, write_step},
        {"wind",
         NONE,
         {NONE, NONE},
         6,
         {{"speed", 5, 0.5, 25, 0.9, LOG},
          {"direction", 0, 0, 6.283, 0.5},
          {"turbulence", 0.2, 0, 1, 0.4},
          {"profile", FROND_WIND_PROFILE_LOG, 0, FROND_WIND_PROFILE_COUNT - 1, 0.5, WHOLE},
          {"length_scale", 20, 0.1, 100, 0.2, LOG},
          {"reference_height", 10, 0.5, 20, 0.2, LOG},
          {"seed", 1, 1, 1000, 0.5, WHOLE}},
         set_wind,
         write_wind},
        {"end_wind", NONE, {NONE, NONE}, 1, {}, end_wind, write_end_wind},
        {"field", NONE, {NONE, NONE}, 1, {{"strength", 1, -6, 6, 0.9}}, set_field, write_field},
        {"gravity",
         NONE,
         {NONE, NONE},
         1,
         {{"x", 0, -5, 5, 0.3}, {"y", -9.81, -20, 5, 0.5}, {"z", 0, -5, 5, 0.3}},
         set_gravity,
         write_gravity},
        {"effects",
         NONE,
         {NONE, NONE},
         1,
         {{"effects", FROND_EFFECT_ALL, 0, FROND_EFFECT_ALL, 0.7, WHOLE}},
         mask_effects,
         write_mask},
        {"detail",
         NONE,
         {NONE, NONE},
         2,
         {x, y, {"by_size", 0, 0, 1, 0.2, WHOLE}, {"hysteresis", 0.15, 0, 0.9, 0.2}},
         set_detail,
         write_detail},
        {"viewer", NONE, {NONE, NONE}, 2, {x, y}, move_viewer, write_viewer},
        {"end_detail", NONE, {NONE, NONE}, 1, {}, end_detail, write_end_detail},
    };
}

std::vector<Verb> snapshot_verbs() {
    constexpr Kind NONE = Kind::NONE, SNAPSHOT = Kind::SNAPSHOT;
    constexpr Scale LINEAR = Scale::LINEAR, WHOLE = Scale::WHOLE;
    const Parameter rate = {"rate", 60, 30, 240, 0.4, LINEAR};
    return {
        {"shift",
         NONE,
         {NONE, NONE},
         1,
         {{"x", 1, -100, 100, 0.8}, {"y", 0, -10, 10, 0.2}, {"z", 0, -100, 100, 0.5}},
         shift,
         write_shift},
        {"save", SNAPSHOT, {NONE, NONE}, 2, {}, save, write_save},
        {"restore", NONE, {SNAPSHOT, NONE}, 2, {}, restore, write_restore},
        {"replay", NONE, {NONE, NONE}, 3, {{"count", 5, 1, 30, 0.8, WHOLE}, rate}, replay, write_replay},
        {"look", NONE, {NONE, NONE}, 1, {{"x", 0, -1, 1, 0.8}}, look, write_look},
    };
}

}  // namespace frond::programs
