#include "programs/run.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/vector.hpp"

namespace frond::programs {

using tools::length;
using tools::must;
using tools::operator+;
using tools::operator-;
using tools::operator*;

Run::Run(const Program& program, const Conditions& conditions) : program(program), conditions(conditions) {
    if (conditions.threads > 1) team = std::make_unique<tools::Team>(conditions.threads);
}

Run::~Run() {
    end();
}

void Run::end() {
    frond_world_destroy(world);
    for (frond_model model : own_models) frond_model_destroy(model);
}

void Run::make_world(const Operation& operation) {
    frond_world_def def = frond_default_world_def();
    def.gravity = {number(operation, "gx"), number(operation, "gy"), number(operation, "gz")};
    def.max_substep = number(operation, "max_substep");
    def.response = frond_response(whole(operation, "response"));
    def.sleep_distance = number(operation, "sleep_distance");
    def.tuning.hash_layout = frond_hash_layout(whole(operation, "hash_layout"));
    if (team) {
        def.parallel_for = tools::Team::parallel_for;
        def.parallel_user = team.get();
    }
    const int kind = whole(operation, "host");
    if (kind < 0)
        must(frond_world_create(&def, &world));
    else
        host = std::make_unique<Host>(kind, def, &world);
    if (conditions.laws) laws = std::make_unique<Laws>(world, conditions.laws);
}

bool Run::has_all(const Operation& operation) const {
    const auto has = [&](Kind kind, int id) {
        switch (kind) {
            case Kind::MODEL:
                return models.count(id) > 0;
            case Kind::PLANT:
                return plants.count(id) > 0;
            case Kind::BODY:
                return bodies.count(id) > 0;
            case Kind::GRAB:
                return grabs.count(id) > 0;
            case Kind::BOND:
                return bonds.count(id) > 0;
            case Kind::ROBOT:
                return robots.count(id) > 0;
            case Kind::SNAPSHOT:
                return snapshots.count(id) > 0;
            default:
                return true;
        }
    };
    const Verb& verb = verb_of(operation);
    return has(verb.of[0], operation.of[0]) && has(verb.of[1], operation.of[1]);
}

void Run::go() {
    for (at = 0; at < program.operations.size(); at++) {
        steps = 0;
        const Operation& operation = program.operations[at];
        if (has_all(operation)) verb_of(operation).run(*this, operation);
    }
}

bool Run::check(frond_result result) {
    if (result == FROND_RESULT_INTERNAL || result == FROND_RESULT_OUT_OF_MEMORY)
        throw Breach(Law::CALL, frond_last_error());
    return result == FROND_OK;
}

void Run::step(double dt) {
    steps++;
    if (host)
        host->step(dt);
    else if (!check(frond_world_step(world, dt)))
        throw Breach(Law::CALL, frond_last_error());
    hashes.push_back(hash());
    if (laws) laws->after_step(plants, loads, dt);
}

uint64_t Run::hash() const {
    uint64_t value = 0;
    must(frond_world_get_state_hash(world, &value));
    return value;
}

void Run::add_model(int id, frond_model model, bool stands) {
    if (!stands) drooping.insert(id);
    models[id] = model;
    own_models.push_back(model);
}

void Run::add_shared_model(int id, frond_model model) {
    models[id] = model;
}

// Organs that lie within others' capsules have no sections.
static double strength_of(frond_model model, const frond_model_info& info) {
    double least = 1e300;
    for (int i = 0; i < info.organ_count; i++) {
        frond_organ organ = {};
        must(frond_model_get_organ(model, i, &organ));
        if (organ.capsule_count > 0) least = std::min(least, organ.material.young * organ.area.lower);
    }
    return least;
}

void Run::add_plant(int id, int model, const frond_plant_def& def) {
    Standing plant;
    plant.model = models.at(model);
    if (!check(frond_plant_create(world, plant.model, &def, &plant.handle))) return;
    must(frond_plant_get_def(plant.handle, &plant.def));
    must(frond_model_get_info(plant.model, &plant.info));
    plant.size = length(plant.info.upper - plant.info.lower);
    plant.home = places_of(plant.handle);
    std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plant.handle)));
    must(frond_plant_get_capsules(plant.handle, capsules.data(), int(capsules.size())));
    for (const frond_capsule& capsule : capsules) plant.lengths.push_back(length(capsule.end - capsule.begin));
    plant.stands = drooping.count(model) == 0;
    plant.strength = strength_of(plant.model, plant.info);
    plants[id] = plant;
}

void Run::remove_plant(int id) {
    frond_plant_destroy(plants.at(id).handle);
    plants.erase(id);
}

void Run::change_mechanics(int id, frond_mechanics to) {
    Standing& plant = plants.at(id);
    const auto step = [this](double dt) { host ? host->step(dt) : must(frond_world_step(world, dt)); };
    if (laws)
        laws->change_mechanics(plant, to, step);
    else
        check(frond_plant_set_mechanics(plant.handle, to));
}

void Run::come_home() {
    constexpr double CALM = 12, DT = 1.0 / 30, SHORT = 0.01;                         // [s]
    if (!host && number(program.operations.front(), "max_substep") < SHORT) return;  // it would take too long
    if (std::none_of(plants.begin(), plants.end(), [](const auto& p) { return Laws::may_come_home(p.second); })) return;
    for (const auto& [id, robot] : robots) frond_robot_destroy(robot);
    for (const auto& [id, body] : bodies) frond_rigid_destroy(body);
    for (const auto& [id, grab] : grabs) frond_grab_destroy(grab);
    for (const auto& [id, bond] : bonds) frond_bond_destroy(bond);
    must(frond_world_set_wind(world, nullptr));
    must(frond_world_set_detail(world, nullptr));
    must(frond_world_set_gravity(world, {0, -9.81, 0}));
    must(frond_world_set_effects(world, FROND_EFFECT_ALL & ~(FROND_EFFECT_PLANT_CONTACT | FROND_EFFECT_SELF_CONTACT)));
    at = program.operations.size();
    for (steps = 0; steps < int(CALM / DT);) step(DT);
    for (const auto& [id, plant] : plants)
        if (Laws::may_come_home(plant)) Laws::expect_home(plant, steps, DT);
}

Standing& plant_of(Run& run, const Operation& operation) {
    return run.plants.at(operation.of[0]);
}

frond_vec3 xyz(const Operation& operation) {
    return {number(operation, "x"), number(operation, "y"), number(operation, "z")};
}

frond_vec3 vertex(frond_plant plant, int number) {
    frond_surface_view view = {};
    if (frond_plant_get_surface(plant, &view) != FROND_OK) return {};
    const float* p = view.positions + 3 * (number % view.vertex_count);
    return {double(p[0]), double(p[1]), double(p[2])};
}

int node(frond_plant plant, int number) {
    const int count = frond_plant_get_node_count(plant);
    return count > 0 ? number % count : 0;
}

// Returns the height of each node as a share of the plant's.
static std::vector<double> heights(const Places& x) {
    double low = 1e9, high = -1e9;
    for (const frond_vec3& p : x) {
        low = std::min(low, p.y);
        high = std::max(high, p.y);
    }
    std::vector<double> shares;
    for (const frond_vec3& p : x) shares.push_back((p.y - low) / (high - low + 1e-9));
    return shares;
}

void kick(frond_plant plant, const frond_vec3& speed) {
    const std::vector<double> share = heights(places_of(plant));
    Places v = velocities_of(plant);
    for (size_t i = 0; i < v.size(); i++) v[i] = v[i] + share[i] * speed;
    frond_plant_set_state(plant, nullptr, &v[0].x, int(v.size()));
}

void bend(frond_plant plant, const frond_vec3& way) {
    Places x = places_of(plant);
    const std::vector<double> share = heights(x);
    for (size_t i = 0; i < x.size(); i++) x[i] = x[i] + share[i] * share[i] * way;
    frond_plant_set_state(plant, &x[0].x, nullptr, int(x.size()));
}

}  // namespace frond::programs
