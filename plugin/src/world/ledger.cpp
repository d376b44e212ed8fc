#include "world/ledger.hpp"

#include "plant/load_work.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

double sum_of(const frond_energy& energy) {
    return energy.kinetic + energy.elastic + energy.gravity;
}

// Returns the energy of a plant over that of its modelled shape, so that all its mechanics count from one zero. Modal
// plants have none.
frond_energy energy_in(const World& world, const Plant& plant, Ledger::Entry& entry) {
    if (plant.state.modal) return {};
    const bool has_weight = plant.input.effects & world.effects & FROND_EFFECT_GRAVITY;
    const Vec3 gravity = has_weight ? gravity_of(world) : Vec3(Vec3::Zero());
    const Elements& whole = elements_of(*plant.system);
    const VecX& mass = node_mass_of(*plant.system);
    frond_energy energy = energy_of(plant, gravity);
    if (entry.system != plant.system) {
        entry.system = plant.system;
        entry.modelled = mechanics(plant.which, plant.nodes->order).energy(whole, whole.modelled);
    }
    energy.elastic -= entry.modelled;
    for (int i = 0; i < mass.size(); i++)
        energy.gravity += mass[i] * gravity.dot(plant.to_world(point(whole.modelled, i)));
    return energy;
}

// Counts the energy of a plant anew; returns by how much it changed.
double recount(const World& world, const PlantBody& body, Ledger::Entry& entry) {
    const double before = sum_of(entry.energy);
    entry.energy = energy_in(world, *body.plant, entry);
    entry.is_modal = body.plant->state.modal != nullptr;
    return sum_of(entry.energy) - before;
}

// Returns whether the plant takes a step in the running substep.
bool is_stepped(const PlantBody& body) {
    return body.level.is_due && !body.plant->state.modal;
}

// Adds the work of plants that were put elsewhere with their pins before they were solved: nothing but their height
// changed.
void add_jump(const Plant& plant, const VecX& before, double& work) {
    if (before.size() != plant.step.x_good.size() || are_same(before, plant.step.x_good)) return;
    const VecX& mass = node_mass_of(*plant.system);
    for (int i = 0; i < mass.size(); i++)
        work -= mass[i] * plant.step.loads->gravity.dot(point(plant.step.x_good, i) - point(before, i));
}

}  // namespace

void count_calls(World& world) {
    Ledger& ledger = *world.ledger;
    for (auto& [handle, entry] : ledger.plants) entry.is_there = false;
    for (const std::unique_ptr<PlantBody>& body : world.bodies) {
        const bool is_new = ledger.plants.count(body->handle.id) == 0;
        Ledger::Entry& entry = ledger.plants[body->handle.id];
        entry.is_there = true;
        if (is_new || !body->rest.asleep || body->is_looked_at)
            ledger.sums.calls += recount(world, look_at(*body), entry);
        entry.is_asleep = body->rest.asleep;
        entry.fragments = body->plant->state.fragments.size();
    }
    for (auto it = ledger.plants.begin(); it != ledger.plants.end();) {
        if (!it->second.is_there) ledger.sums.calls -= sum_of(it->second.energy);
        it = it->second.is_there ? std::next(it) : ledger.plants.erase(it);
    }
}

void begin_work(World& world) {
    for (PlantBody* body : world.awake) {
        Ledger::Entry& entry = world.ledger->plants[body->handle.id];
        const bool is_the_callers = entry.is_modal || entry.is_asleep || body->plant->state.modal;
        if (is_the_callers || entry.system != body->plant->system) {
            const double change = recount(world, *body, entry);
            if (is_the_callers) world.ledger->sums.calls += change;
        }
        entry.is_asleep = false;
        entry.x = body->plant->state.motion.x;
        body->plant->step.work = std::make_unique<LoadWork>();
    }
}

// Adds what bodies did on plants by contacts and bonds.
static void count_bodies(World& world) {
    frond_energy_ledger& sums = world.ledger->sums;
    for (const Contact& contact : world.contacts)
        if (is_stepped(*contact.plant)) sums.bodies += contact.work;
    for (const Bond& bond : world.bonds)
        if (bond.body && !bond.plant->rest.asleep && is_stepped(*bond.plant)) sums.bonds += bond.work;
}

void count_work(World& world) {
    count_bodies(world);
    frond_energy_ledger& sums = world.ledger->sums;
    for (PlantBody* body : world.awake) {
        if (!is_stepped(*body)) continue;
        const Plant& plant = *body->plant;
        Ledger::Entry& entry = world.ledger->plants[body->handle.id];
        const LoadWork& work = *plant.step.work;
        sums.forces += work.forces;
        sums.grabs += work.grabs;
        sums.air += work.air;
        sums.pins += work.pins;
        sums.error += work.error + work.air_error;
        add_jump(plant, entry.x, sums.pins);
        recount(world, *body, entry);
    }
}

void count_what_came_off(World& world) {
    for (PlantBody* body : world.awake) {
        Ledger::Entry& entry = world.ledger->plants[body->handle.id];
        if (entry.fragments == body->plant->state.fragments.size()) continue;
        world.ledger->sums.fragments += recount(world, *body, entry);
        entry.fragments = body->plant->state.fragments.size();
    }
}

frond_energy_ledger ledger_now(World& world) {
    const bool begins = !world.ledger;
    if (begins) world.ledger = std::make_unique<Ledger>();
    count_calls(world);
    frond_energy_ledger& sums = world.ledger->sums;
    frond_energy_ledger out = sums;
    for (const auto& [handle, entry] : world.ledger->plants) {
        out.now.kinetic += entry.energy.kinetic;
        out.now.elastic += entry.energy.elastic;
        out.now.gravity += entry.energy.gravity;
    }
    if (begins) {
        sums.begin = out.begin = sum_of(out.now);
        sums.calls = out.calls = 0;
    }
    const double given =
        out.forces + out.grabs + out.air + out.pins + out.bodies + out.bonds + out.fragments + out.calls;
    out.dissipated = out.begin + given - sum_of(out.now);
    return out;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
