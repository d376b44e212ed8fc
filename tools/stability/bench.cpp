// The world of a cell: made when first requested, checked after each step.
#include "stability/bench.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace frond::stability {

static bool is_finite(const frond_vec3& a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

Bench::Bench(const Cell& cell)
    : cell(cell), world_def(frond_default_world_def()), plant_def(frond_default_plant_def()) {
    world_def.max_substep = cell.dt;
    plant_def.mechanics = cell.mechanics;
    plant_def.integrator = cell.integrator;
    // Plants that are bent far must return, so nothing yields.
    plant_def.effects &= ~uint32_t(FROND_EFFECT_PLASTICITY);
}

Bench::~Bench() {
    frond_world_destroy(handle);
    for (frond_model model : models) frond_model_destroy(model);
}

double Bench::between(double low, double high) {
    return low + (high - low) * double(random()) / double(std::mt19937::max());
}

frond_world Bench::world() {
    if (!handle.id) must(frond_world_create(&world_def, &handle));
    return handle;
}

frond_model Bench::keep(frond_model model) {
    models.push_back(model);
    return model;
}

frond_plant Bench::add(frond_model model, const frond_vec3& position) {
    plant_def.position = position;
    frond_plant plant = {};
    must(frond_plant_create(world(), model, &plant_def, &plant));
    entries.push_back({plant, model, {}});
    entries.back().start = places(plant);
    return plant;
}

frond_rigid Bench::add(const frond_rigid_def& def) {
    frond_rigid rigid = {};
    must(frond_rigid_create(world(), &def, &rigid));
    return rigid;
}

void Bench::remove(frond_plant plant) {
    frond_plant_destroy(plant);
    entries.erase(entries.begin() + (&entry_of(plant) - entries.data()));
}

void Bench::run(double seconds) {
    run(seconds, [](double) {});
}

void Bench::run(double seconds, const std::function<void(double)>& before_each) {
    const int steps = std::max(1, int(std::lround(seconds / cell.dt)));
    for (int i = 0; i < steps; i++) {
        before_each(i * cell.dt);
        step(cell.dt);
    }
}

void Bench::step(double dt) {
    must(frond_world_step(world(), dt));
    frond_report report = {};
    must(frond_world_get_report(world(), &report));
    trouble |= report.trouble;
    check();
}

void Bench::check() {
    for (const Entry& entry : entries) {
        const Places x = places(entry.plant), v = velocities(entry.plant);
        for (size_t i = 0; i < x.size(); i++) {
            if (!is_finite(x[i]) || !is_finite(v[i])) throw Broken("not finite after " + std::to_string(time()) + " s");
            expect(length(x[i] - entry.start[i]) <= box, "a node is [m] away", length(x[i] - entry.start[i]), box);
        }
        frond_vec3 tip = {};
        frond_energy energy = {};
        must(frond_plant_get_tip(entry.plant, &tip));
        must(frond_plant_get_energy(entry.plant, &energy));
        if (!is_finite(tip) || !std::isfinite(energy.kinetic + energy.elastic + energy.gravity))
            throw Broken("surface or energy not finite after " + std::to_string(time()) + " s");
    }
}

const Bench::Entry& Bench::entry_of(frond_plant plant) const {
    return *std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.plant.id == plant.id; });
}

Places Bench::places(frond_plant plant) const {
    Places x(size_t(frond_plant_get_node_count(plant)));
    must(frond_plant_get_state(plant, &x[0].x, nullptr, int(x.size())));
    return x;
}

Places Bench::velocities(frond_plant plant) const {
    Places v(size_t(frond_plant_get_node_count(plant)));
    must(frond_plant_get_state(plant, nullptr, &v[0].x, int(v.size())));
    return v;
}

void Bench::put(frond_plant plant, const Places& places) {
    const Places still(places.size());
    must(frond_plant_set_state(plant, &places[0].x, &still[0].x, int(places.size())));
}

void Bench::push(frond_plant plant, const Places& velocities) {
    must(frond_plant_set_state(plant, nullptr, &velocities[0].x, int(velocities.size())));
}

double Bench::energy() const {
    double sum = 0;
    for (const Entry& entry : entries) {
        frond_energy energy = {};
        must(frond_plant_get_energy(entry.plant, &energy));
        sum += energy.kinetic + energy.elastic + energy.gravity;
    }
    return sum;
}

double Bench::kinetic_energy() const {
    double sum = 0;
    for (const Entry& entry : entries) {
        frond_energy energy = {};
        must(frond_plant_get_energy(entry.plant, &energy));
        sum += energy.kinetic;
    }
    return sum;
}

double Bench::fastest() const {
    double most = 0;
    for (const Entry& entry : entries)
        for (const frond_vec3& v : velocities(entry.plant)) most = std::max(most, length(v));
    return most;
}

double Bench::time() const {
    frond_report report = {};
    must(frond_world_get_report(handle, &report));
    return report.time;
}

std::vector<int> Bench::hold(frond_plant plant, double height) {
    const Entry& entry = entry_of(plant);
    frond_cage_view cage;
    must(frond_model_get_cage(entry.model, &cage));
    std::vector<int> nodes;
    for (int i = 0; i < cage.node_count; i++) {
        if (cage.nodes[3 * i + 1] > height) continue;
        nodes.push_back(i);
        must(frond_plant_pin(plant, i));
    }
    return nodes;
}

void Bench::move(frond_plant plant, const std::vector<int>& nodes,
                 const std::function<frond_vec3(const frond_vec3&)>& to) {
    for (int node : nodes) must(frond_plant_move_pin(plant, node, to(entry_of(plant).start[size_t(node)])));
}

void Bench::expect(bool holds, const char* what, double measured, double bound) const {
    if (holds) return;
    char text[200];
    std::snprintf(text, sizeof text, "%s: %.3g, allowed %.3g, after %.3g s", what, measured, bound, time());
    throw Broken(text);
}

void Bench::expect_no_energy_from_nothing(double seconds, double rest) {
    constexpr double GROWTH = 1.05, LIFT = 0.01;
    double weight = 0, size = 0;
    for (const Entry& entry : entries) {
        frond_model_info info;
        must(frond_model_get_info(entry.model, &info));
        weight += 9.81 * info.mass;
        size = std::max(size, length(info.upper - info.lower));
    }
    const double bound = rest + GROWTH * std::max(0.0, energy() - rest) + LIFT * weight * size;
    const int steps = std::max(1, int(std::lround(seconds / cell.dt)));
    for (int i = 0; i < steps; i++) {
        step(cell.dt);
        expect(energy() <= bound, "energy out of nothing [J]", energy(), bound);
    }
}

void Bench::expect_shape(frond_plant plant, const Places& rest, double share) const {
    const Entry& entry = entry_of(plant);
    frond_cage_view cage;
    frond_model_info info;
    must(frond_model_get_cage(entry.model, &cage));
    must(frond_model_get_info(entry.model, &info));
    const Places now = places(plant);
    int inside_out = 0;
    for (int t = 0; t < cage.tet_count; t++) {
        const auto at = [&](int c) { return now[size_t(cage.tets[4 * t + c])] - now[size_t(cage.tets[4 * t])]; };
        const frond_vec3 a = at(1), b = at(2), c = at(3);
        const double volume =
            a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
        inside_out += !(volume > 0);
    }
    // If the chain moves, tets are only drawn.
    const bool moves_cage = cell.mechanics != FROND_MECHANICS_ROD && cell.mechanics != FROND_MECHANICS_SPRING_CHAIN;
    expect(inside_out == 0 || !moves_cage, "tets inside out", inside_out, 0);
    double sum = 0;
    for (size_t i = 0; i < rest.size(); i++) sum += length(now[i] - rest[i]);
    const double mean = sum / double(rest.size()) / length(info.upper - info.lower);
    expect(mean <= share, "mean distance from the shape at rest over the size", mean, share);
}

}  // namespace frond::stability
