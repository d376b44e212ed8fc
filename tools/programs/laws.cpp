#include "programs/laws.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "programs/settle.hpp"
#include "scenes/scene.hpp"
#include "scenes/vector.hpp"

namespace frond::programs {

using tools::length;
using tools::must;
using tools::operator-;
using tools::operator+;

namespace {

constexpr double GRAVITY = 9.81;  // [m/s^2]

[[noreturn]] void breach(Law law, const char* what, double measured, double allowed) {
    char text[200];
    std::snprintf(text, sizeof text, "%s: %.3g, allowed %.3g", what, measured, allowed);
    throw Breach(law, text);
}
void expect(Law law, const char* what, double measured, double allowed) {
    if (!(measured <= allowed)) breach(law, what, measured, allowed);
}

bool is_finite(const Places& places) {
    return std::all_of(places.begin(), places.end(), [](const frond_vec3& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
}

double weight_of(const Standing& plant) {
    return GRAVITY * plant.info.mass;
}

bool moves_chain(const Standing& plant) {
    return plant.def.mechanics == FROND_MECHANICS_ROD || plant.def.mechanics == FROND_MECHANICS_SPRING_CHAIN;
}

// Returns whether anything bounds the lengths of a plant's capsules. The linear law knows no turns, and a cage has a
// blade's stiffness against tension by its fibres only.
bool keeps_lengths(const Standing& plant) {
    return moves_chain(plant) ||
           (plant.def.mechanics != FROND_MECHANICS_TET_LINEAR && plant.def.effects & FROND_EFFECT_FIBRES);
}

}  // namespace

const char* name_of(Law law) {
    static const char* const NAMES[] = {"call", "finite", "far",    "energy", "handover", "stretch",
                                        "work", "bits",   "replay", "home",   "crash"};
    return NAMES[size_t(law)];
}

const char* text_of(Law law) {
    static const char* const TEXTS[] = {
        "no call reports a bug or runs out of memory",
        "all numbers are finite",
        "nothing is farther away than physics allows",
        "the energy ledger never loses: what steps dissipate is never below zero by more than their errors",
        "a change of mechanics adds no energy but what pins force",
        "capsules keep their length, of cages with fibres up to 2.5 times",
        "a step solves no more than a hundred times what the median step does",
        "the same program gives the same bits, with any number of threads",
        "a snapshot goes on to the same bits",
        "a plant whose loads are taken away comes home",
        "no program crashes or hangs"};
    return TEXTS[size_t(law)];
}

Places places_of(frond_plant plant) {
    Places x(size_t(frond_plant_get_node_count(plant)));
    if (!x.empty()) must(frond_plant_get_state(plant, &x[0].x, nullptr, int(x.size())));
    return x;
}

Places velocities_of(frond_plant plant) {
    Places v(size_t(frond_plant_get_node_count(plant)));
    if (!v.empty()) must(frond_plant_get_state(plant, nullptr, &v[0].x, int(v.size())));
    return v;
}

Law law_called(const std::string& name) {
    std::string names;
    for (int i = 0; i < int(Law::COUNT); i++) {
        if (name == name_of(Law(i))) return Law(i);
        names += (i ? ", " : "") + std::string(name_of(Law(i)));
    }
    throw tools::SceneError("there is no law \"" + name + "\"; there are " + names);
}

Laws::Laws(frond_world world, LawSet checked) : world(world), checked(checked) {
    must(frond_world_get_energy_ledger(world, &last));
}

void Laws::after_step(std::map<int, Standing>& plants, const Loads& loads, double dt) {
    time += dt;
    for (auto& [id, plant] : plants) {
        must(frond_plant_get_def(plant.handle, &plant.def));
        if (checks(Law::FINITE)) check_finite(plant);
        if (checks(Law::FAR)) check_places(plant, loads);
        if (checks(Law::STRETCH) && keeps_lengths(plant))
            check_lengths(plant, loads, loads.has_bodies || plants.size() > 1);
    }
    if (checks(Law::ENERGY)) check_energy(plants, dt);
    if (checks(Law::WORK)) check_work(plants);
}

void Laws::check_finite(const Standing& plant) {
    frond_vec3 tip = {};
    must(frond_plant_get_tip(plant.handle, &tip));
    if (!is_finite(places_of(plant.handle)) || !is_finite(velocities_of(plant.handle)) || !is_finite({tip}))
        throw Breach(Law::FINITE, "a plant is not finite");
}

// A rooted plant is where its foot is. Another one may have gone as fast as anything could make it go; so may leaves by
// the linear law, which knows no end of bending: in a wind of 15 m/s one of the wheat goes 2.4 m in a third of a
// second, and 2.7 m by steps of 1/480 s. A force of the host carries them at any speed.
void Laws::check_places(const Standing& plant, const Loads& loads) {
    constexpr double REACH = 2, FAST = 30;  // [sizes], [m/s]
    const bool is_linear = plant.def.mechanics == FROND_MECHANICS_TET_LINEAR;
    if (is_linear && loads.force > 0) return;
    const Places now = places_of(plant.handle);
    const bool is_rooted = !is_linear && plant.def.root_height >= 0 && !plant.is_changed &&
                           frond_plant_get_fragment_count(plant.handle) == 0;
    const double fall = GRAVITY * time * time;
    const double allowed = REACH * plant.size + plant.carried +
                           (is_rooted ? 0 : fall + (FAST + 3 * loads.speed + loads.impulse / plant.info.mass) * time);
    double most = 0;
    for (size_t i = 0; i < now.size(); i++) most = std::max(most, length(now[i] - plant.home[i]));
    expect(Law::FAR, "a node is [m] away", most, allowed);
}

// A chain that nothing but air, weight and light forces act on keeps its lengths; what presses or pulls it may draw it
// out a little, and a cage, whose nodes are free, more; by the linear law whatever turns grows.
void Laws::check_lengths(const Standing& plant, const Loads& loads, bool is_touched) {
    constexpr double FREE = 1.05, LOADED = 1.5, CAGE = 2.5;
    if (plant.is_strained || frond_plant_get_fragment_count(plant.handle) > 0) return;
    std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plant.handle)));
    must(frond_plant_get_capsules(plant.handle, capsules.data(), int(capsules.size())));
    double most = 0;
    for (size_t i = 0; i < capsules.size(); i++)
        most = std::max(most, length(capsules[i].end - capsules[i].begin) / plant.lengths[i]);
    const bool may_give = is_touched || plant.def.mechanics == FROND_MECHANICS_SPRING_CHAIN;
    const double allowed = !moves_chain(plant) ? CAGE : may_give ? LOADED : FREE;
    // A sudden force draws out by twice what it does at rest.
    expect(Law::STRETCH, "a capsule's length over its own", most, allowed + 2 * loads.force / plant.strength);
}

// What was dissipated may fall by the ledger's error, by a twentieth of what went through the plants, and by what lifts
// them by a fiftieth of their size. Plants that were made in one another or in bodies come apart slowly, as if they
// were lifted.
void Laws::check_energy(const std::map<int, Standing>& plants, double dt) {
    constexpr double SHARE = 0.05, LIFT = 0.02, LEAST = 1e-9;  // [-], [-], [J]
    constexpr double PARTING = 0.1;                            // [m/s]
    frond_energy_ledger now = {};
    must(frond_world_get_energy_ledger(world, &now));
    if (!std::isfinite(now.dissipated)) throw Breach(Law::FINITE, "the energy is not finite");
    double frond_energy_ledger::*const terms[] = {&frond_energy_ledger::forces,    &frond_energy_ledger::grabs,
                                                  &frond_energy_ledger::air,       &frond_energy_ledger::pins,
                                                  &frond_energy_ledger::bodies,    &frond_energy_ledger::bonds,
                                                  &frond_energy_ledger::fragments, &frond_energy_ledger::calls};
    for (const auto term : terms) turnover += std::abs(now.*term - last.*term);
    kinetic = std::max(kinetic, now.now.kinetic);
    last = now;
    if (now.dissipated > most) {
        most = now.dissipated;
        error_at_most = now.error;
    }
    frond_report report = {};
    must(frond_world_get_report(world, &report));
    double lift = LEAST, weight = 0;
    for (const auto& [id, plant] : plants) {
        lift += LIFT * plant.size * weight_of(plant);
        weight += weight_of(plant);
    }
    if (report.plant_contact_count + report.contact_count > 0) parted += PARTING * weight * dt;
    expect(Law::ENERGY, "energy out of nothing [J]", most - now.dissipated,
           now.error - error_at_most + SHARE * (turnover + kinetic) + lift + parted);
}

void Laws::check_work(const std::map<int, Standing>& plants) {
    constexpr int MANY = 100;
    constexpr size_t KNOWN = 20;  // steps
    for (const auto& [id, plant] : plants) {
        const frond_linear_solver solver = plant.def.tuning.linear_solver;
        if (solver != FROND_LINEAR_SOLVER_BLOCK && solver != FROND_LINEAR_SOLVER_DIRECT) return;  // iterations vary
    }
    frond_report report = {};
    must(frond_world_get_report(world, &report));
    if (report.awake_count == 0) return;
    work.push_back(report.solver_iterations / report.awake_count);
    if (work.size() < KNOWN) return;
    std::vector<int> sorted = work;
    std::nth_element(sorted.begin(), sorted.begin() + long(sorted.size() / 2), sorted.end());
    expect(Law::WORK, "solves of a plant in a step", work.back(), MANY * std::max(1, sorted[sorted.size() / 2]));
}

// Between pins that do not fit one another other mechanics may store more than the ones before, but not more than at
// rest.
void Laws::check_handover(const Standing& plant, double gained, double allowed,
                          const std::function<void(double)>& step) {
    constexpr double SHARE = 0.05;
    if (gained <= allowed) return;
    frond_energy now = {};
    must(frond_plant_get_energy(plant.handle, &now));
    const double settled = settled_energy(world, plant.handle, step),
                 forced = settled - (now.elastic + now.gravity - gained);
    expect(Law::HANDOVER, "a change of mechanics added energy [J]", gained,
           std::max(allowed, forced + SHARE * std::abs(forced)));
}

void Laws::change_mechanics(Standing& plant, frond_mechanics to, const std::function<void(double)>& step) {
    constexpr double SHARE = 0.05, LIFT = 0.02;
    // The ledger's energies are over those as modelled: cage and chain have their centres of mass a little apart.
    frond_energy_ledger before = {}, after = {};
    must(frond_world_get_energy_ledger(world, &before));
    frond_detail detail = {};
    must(frond_plant_get_detail(plant.handle, &detail));
    const frond_result result = frond_plant_set_mechanics(plant.handle, to);
    if (result == FROND_RESULT_UNSUPPORTED) return;  // tets on supports
    must(result);
    must(frond_world_get_energy_ledger(world, &after));
    if (checks(Law::HANDOVER) && detail != FROND_DETAIL_MODAL)  // in which plants have no energy
        check_handover(
            plant, after.calls - before.calls,
            SHARE * (std::abs(before.now.elastic) + before.now.kinetic) + LIFT * plant.size * weight_of(plant), step);
    must(frond_plant_get_def(plant.handle, &plant.def));
}

bool Laws::may_come_home(const Standing& plant) {
    const frond_linear_solver solver = plant.def.tuning.linear_solver;
    return (solver == FROND_LINEAR_SOLVER_BLOCK || solver == FROND_LINEAR_SOLVER_DIRECT) && plant.stands &&
           !plant.is_changed && plant.def.root_height >= 0 && plant.def.mechanics != FROND_MECHANICS_TET_LINEAR &&
           !(plant.def.effects & (FROND_EFFECT_PLASTICITY | FROND_EFFECT_BREAKING)) && plant.def.mass_damping >= 0.1 &&
           plant.def.material_damping >= 1 && plant.def.stiffness_damping >= 0.001 &&
           frond_plant_get_fragment_count(plant.handle) == 0;
}

namespace {

// Returns whether a plant was made leaning, so that its weight bends it otherwise than as it was modelled.
bool leans(const Standing& plant) {
    constexpr double UPRIGHT = 0.999;  // cosine
    const frond_quat& q = plant.def.rotation;
    return 1 - 2 * (q.x * q.x + q.z * q.z) < UPRIGHT;
}

// Returns where the nodes of such a plant come to rest that is awake and that nothing ever touched.
Places rest_of_untouched(const Standing& plant, int steps, double dt) {
    frond_world_def world_def = frond_default_world_def();
    frond_plant_def def = plant.def;
    def.starts_asleep = false;
    frond_world world = {};
    must(frond_world_create(&world_def, &world));
    frond_plant twin = {};
    must(frond_plant_create(world, plant.model, &def, &twin));
    const Places made = places_of(twin);
    for (int i = 0; i < steps; i++) must(frond_world_step(world, dt));
    Places rest = places_of(twin);
    frond_world_destroy(world);
    for (size_t i = 0; i < rest.size(); i++) rest[i] = plant.home[i] + (rest[i] - made[i]);
    return rest;
}

}  // namespace

void Laws::expect_home(const Standing& plant, int steps, double dt) {
    constexpr double NEAR = 0.15;  // mean distance [sizes]
    const Places now = places_of(plant.handle), home = leans(plant) ? rest_of_untouched(plant, steps, dt) : plant.home;
    double sum = 0;
    for (size_t i = 0; i < now.size(); i++) sum += length(now[i] - home[i]);
    expect(Law::HOME, "mean distance from home over its size", sum / double(now.size()) / plant.size, NEAR);
}

}  // namespace frond::programs
