// A substep of all plants of a world, inside Bullet's own. Its parts have zones in Bullet's profiler.
#include <LinearMath/btQuickprof.h>

#include <algorithm>
#include <cmath>

#include "batch/plants.hpp"
#include "core/assert.hpp"
#include "core/timer.hpp"
#include "world/convert.hpp"
#include "world/detection.hpp"
#include "world/fragments.hpp"
#include "world/robot.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

constexpr double ENTANGLED = 0.0007;  // overlap of plants beyond that of mere touch [m]

Vec3 gravity_of(const World& world) {
    return from_bullet(world.bullet->getGravity());
}

// Records that an effect ran, and its time [ms].
static void add_effect(World& world, frond_effects effect, double ms) {
    world.report.effects_run |= effect;
    size_t bit = 0;
    while (effect >> bit != 1) bit++;
    world.profile.ms_of_effect[bit] += ms;
}

// Adds a plant's counts and times in this substep to the world's report and profile.
static void add_to_report(World& world, const Plant& plant) {
    frond_report& report = world.report;
    report.trouble |= plant.trouble;
    if (plant.state.modal) return;
    report.solver_iterations += plant.report.iterations;
    report.residual = std::max(report.residual, plant.report.residual);
    world.profile.ms_effects += plant.ms_effects;
    world.profile.ms_assembly += plant.report.ms_assembly;
    world.profile.ms_solve += plant.report.ms_solve;
    const frond_effects effects = plant.input.effects & world.effects;
    report.effects_run |= effects & (FROND_EFFECT_GRAVITY | FROND_EFFECT_DAMPING);
    if (effects & FROND_EFFECT_USER_FORCE && (plant.input.has_user_force || !plant.input.grabs.empty()))
        add_effect(world, FROND_EFFECT_USER_FORCE, plant.ms_user_force);
    const frond_effects air = effects & (FROND_EFFECT_WIND | FROND_EFFECT_AIR_DRAG);
    if (world.wind && air) {
        add_effect(world, air & FROND_EFFECT_WIND ? FROND_EFFECT_WIND : FROND_EFFECT_AIR_DRAG, plant.ms_air);
        report.effects_run |= air;
    }
    if (effects & FROND_EFFECT_FIBRES && plant.fibres) add_effect(world, FROND_EFFECT_FIBRES, plant.ms_fibres);
    if (effects & FROND_EFFECT_PLASTICITY) add_effect(world, FROND_EFFECT_PLASTICITY, plant.ms_plasticity);
}

int number_of(World& world, PlantBody& body) {
    if (body.number >= 0) return body.number;
    body.number = int(world.taking_part.size());
    world.taking_part.push_back(&body);
    return body.number;
}

namespace {

bool any_wants(const World& world, frond_effects effect) {
    return std::any_of(world.awake.begin(), world.awake.end(),
                       [&](const PlantBody* body) { return body->plant->input.effects & world.effects & effect; });
}

// Numbers the plants that are awake, in the order in which they came into the world.
void call_roll(World& world) {
    for (PlantBody* body : world.taking_part) body->number = -1;
    world.taking_part.clear();
    std::sort(world.awake.begin(), world.awake.end(),
              [](const PlantBody* a, const PlantBody* b) { return a->index < b->index; });
    for (PlantBody* body : world.awake) number_of(world, *body);
}

void find_touches(World& world, double h) {
    BT_PROFILE("frond collide");
    const Timer find_timer;
    wake_by_world(world);
    const std::vector<Contact> last = std::move(world.contacts);
    world.contacts.clear();
    if (world.effects & FROND_EFFECT_RIGID_CONTACT &&
        (world.awake.size() < world.bodies.size() || any_wants(world, FROND_EFFECT_RIGID_CONTACT))) {
        const Timer timer;
        world.contacts = find_contacts(world, last, h);
        add_effect(world, FROND_EFFECT_RIGID_CONTACT, timer.ms());
    }
    const frond_effects among = FROND_EFFECT_PLANT_CONTACT | FROND_EFFECT_SELF_CONTACT;
    // Also where no plant wants any: what is known of the last substep's ends.
    const Timer timer;
    world.plant_contacts = find_plant_contacts(world, h);
    if (any_wants(world, among))
        add_effect(
            world,
            any_wants(world, FROND_EFFECT_PLANT_CONTACT) ? FROND_EFFECT_PLANT_CONTACT : FROND_EFFECT_SELF_CONTACT,
            timer.ms());
    wake_touched(world, h);
    world.profile.ms_collide = find_timer.ms();
}

// Notes plants that moving bodies touch: they are simulated for a while at any distance.
void note_touches(World& world) {
    constexpr double NEAR = 0.02;  // [m]
    if (!world.detail) return;
    for (const Contact& contact : world.contacts)
        if (contact.gap < NEAR && is_moving(*contact.other)) disturb(*contact.plant);
}

// Marks the plants that contacts and bonds push.
void mark_pushed(World& world) {
    for (const Contact& contact : world.contacts) {
        contact.plant->plant->state.is_touched = true;
        contact.plant->plant->step.is_pressed |= !contact.other->isStaticObject();
    }
    for (const PlantContact& contact : world.plant_contacts)
        for (PlantBody* body : contact.plants) {
            body->plant->state.is_touched = true;
            body->plant->step.is_pressed |= contact.plants[0] != contact.plants[1];
            body->plant->state.is_entangled |= contact.depth > ENTANGLED;
        }
    for (const Bond& bond : world.bonds)
        bond.plant->plant->state.is_touched = bond.plant->plant->step.is_pressed = true;
}

// Drops contacts of modal plants, and of plants whose detail changed after their contacts were found; marks plants that
// others push, which are stepped now.
void mark_touched(World& world) {
    const auto sways = [](const PlantBody* body) { return body->plant->state.modal != nullptr; };
    world.contacts.erase(std::remove_if(world.contacts.begin(), world.contacts.end(),
                                        [&](const Contact& contact) { return sways(contact.plant); }),
                         world.contacts.end());
    world.plant_contacts.erase(std::remove_if(world.plant_contacts.begin(), world.plant_contacts.end(),
                                              [&](const PlantContact& c) {
                                                  return sways(c.plants[0]) || sways(c.plants[1]) || !is_by_the_same(c);
                                              }),
                               world.plant_contacts.end());
    for (PlantBody* body : world.awake) {
        body->plant->state.is_touched = body->plant->step.is_pressed = body->plant->state.is_entangled = false;
        body->level.is_due = (world.substep + uint64_t(body->index)) % uint64_t(body->level.every) == 0;
    }
    if (response_row(world.response).find) mark_pushed(world);
    for (const SweptBody& swept : world.swept)
        for (PlantBody* body : swept.plants) body->plant->step.is_watched |= !body->rest.asleep;
    for (PlantBody* body : world.awake)
        if (waits(*body->plant) || body->plant->input.has_user_force) body->level.is_due = true;
}

// Takes the rest of a step, of one plant or of a batch, when no contact is left to push them; plants that may break
// move their capsules later.
void finish(const World& world, PlantBody* const* bodies, int count, const Surroundings& surroundings) {
    constexpr double LATELY = 0.3;
    for (int i = 0; i < count; i++) {
        PlantBody& body = *bodies[i];
        Plant& plant = *body.plant;
        accept_step(plant, surroundings, body.level.pending);
        const double ms = plant.ms_effects + plant.report.ms_assembly + plant.report.ms_solve;
        body.level.ms += float((body.level.ms > 0 ? LATELY : 1) * (ms - double(body.level.ms)));
    }
    const Timer timer;
    if (!(bodies[0]->plant->input.effects & world.effects & FROND_EFFECT_BREAKING)) move_capsules(bodies, count);
    const float ms_capsules = float(timer.ms() / count);
    for (int i = 0; i < count; i++) {
        bodies[i]->level.ms_capsules = ms_capsules;
        if (world.sleep_distance > 0) watch(world, *bodies[i], bodies[i]->level.pending);
    }
}
void finish(const World& world, PlantBody& body, const Surroundings& surroundings) {
    PlantBody* const bodies[] = {&body};
    finish(world, bodies, 1, surroundings);
}

// Steps a modal plant: queries the air once in TURNS substeps, and moves the capsules once in SEEN.
void sway(const World& world, PlantBody& body, const Surroundings& surroundings, double h) {
    constexpr uint64_t TURNS = 4, SEEN = 8;
    const uint64_t turn = world.substep + uint64_t(body.index);
    step_modal(*body.plant, surroundings, h, turn % TURNS == 0);
    body.level.is_due = turn % SEEN == 0;
    if (world.sleep_distance > 0) watch(world, body, h);
    if (!body.level.is_due) return;
    const Timer timer;
    pose(*body.plant);
    move_capsules(body);
    body.level.ms_capsules = float(timer.ms());
}

// Takes a plant's own part of the substep, which is independent of all others.
void step_alone(const World& world, PlantBody& body, const Surroundings& surroundings, double h) {
    if (body.plant->state.modal) return sway(world, body, surroundings, h);
    if (!body.level.is_due) {
        body.plant->view.lead = body.level.pending;
        body.plant->view.cage_stale = body.plant->view.surface_stale = true;
        return;
    }
    solve_plant(*body.plant, surroundings, body.level.pending);
    if (!waits(*body.plant)) finish(world, body, surroundings);
}

// Plants that are stepped by one job: a single one, or a batch.
struct StepJob {
    std::array<PlantBody*, MOST_LANES> bodies;
    int count = 0;
};

void run_job(const World& world, const StepJob& job, const Surroundings& surroundings, double h) {
    FROND_ASSERT(job.count >= 1 && job.count <= MOST_LANES);
    if (job.count == 1) return step_alone(world, *job.bodies[0], surroundings, h);
    std::array<Plant*, MOST_LANES> plants;
    for (int i = 0; i < job.count; i++) plants[size_t(i)] = job.bodies[size_t(i)]->plant.get();
    solve_batch(plants.data(), job.count, surroundings, job.bodies[0]->level.pending);
    std::array<PlantBody*, MOST_LANES> done;
    const auto end = std::copy_if(job.bodies.begin(), job.bodies.begin() + job.count, done.begin(),
                                  [](const PlantBody* body) { return !waits(*body->plant); });
    if (end != done.begin()) finish(world, done.data(), int(end - done.begin()), surroundings);
}

// Returns whether a plant can be batched with those of a job.
bool goes_with(const StepJob& job, const PlantBody& body) {
    return job.bodies[0]->level.pending == body.level.pending && go_alike(*job.bodies[0]->plant, *body.plant);
}

// Shares all awake plants out into jobs; those that may be batched go with the next ones of their kind.
std::vector<StepJob> share_out(const World& world, const Surroundings& surroundings, double h) {
    constexpr size_t MOST_OPEN = 8;  // most jobs that a plant is compared with, where all plants differ
    const int most = most_in_batch();
    std::vector<StepJob> jobs;
    std::vector<size_t> open;  // jobs whose batch is not full
    for (PlantBody* body : world.awake) {
        if (!body->plant->state.modal) body->level.pending += h;
        const bool is_due = !body->plant->state.modal && body->level.is_due;
        auto found = open.end();
        if (is_due && !world.ledger && may_be_batched(*body->plant, surroundings, body->level.pending)) {
            found = std::find_if(open.begin(), open.end(), [&](size_t i) { return goes_with(jobs[i], *body); });
            if (found == open.end()) {
                if (open.size() == MOST_OPEN) open.erase(open.begin());
                open.push_back(jobs.size());
                found = open.end() - 1;
                jobs.emplace_back();
            }
        } else {
            jobs.emplace_back();
        }
        StepJob& job = found == open.end() ? jobs.back() : jobs[*found];
        job.bodies[size_t(job.count++)] = body;
        if (found != open.end() && job.count == most) open.erase(found);
    }
    return jobs;
}

// Does the part of a plant's step that has to be done by one thread.
void settle(World& world, PlantBody& body, btCollisionWorld& collision_world) {
    frond_report& report = world.report;
    report.detail_count[body.level.now]++;
    if (!body.level.is_due) return;
    add_to_report(world, *body.plant);
    if (!body.plant->state.modal && body.plant->input.effects & world.effects & FROND_EFFECT_BREAKING) {
        const Timer timer;
        report.broken_count += break_overloaded(world, body);
        move_capsules(body);
        add_effect(world, FROND_EFFECT_BREAKING, timer.ms());
    }
    collision_world.updateSingleAabb(&body);
    world.profile.ms_capsules += double(body.level.ms_capsules);
    body.level.pending = 0;
    if (!world.own) clear_user_force(*body.plant);
}

Surroundings begin_step(World& world, btCollisionWorld& collision_world, double h) {
    world.substep++;
    world.substep_length = h;
    end_hold(world.gravity_ahead, collision_world);
    world.report = {};
    world.profile = {};
    Surroundings surroundings;
    surroundings.gravity = gravity_of(world);
    surroundings.effects = world.effects;
    if (world.wind) pass_time(*world.wind, h);
    surroundings.wind = world.wind.get();
    surroundings.time = world.time + h;
    return surroundings;
}

void carry_what_came_off(World& world, double h) {
    for (PlantBody* body : world.awake) {
        if (body->fragment_bodies.empty()) continue;
        carry_fragments(*body);
        if (body->plant->input.effects & world.effects & FROND_EFFECT_USER_FORCE) pull_fragments(*body, h);
    }
}

void handle_contacts(World& world, double h) {
    const Timer timer;
    let_go_of_gone(world);
    frond_report& report = world.report;
    const bool any_watched = std::any_of(world.awake.begin(), world.awake.end(),
                                         [](const PlantBody* body) { return body->plant->step.is_watched; });
    if (!world.contacts.empty() || !world.plant_contacts.empty() || !world.bonds.empty() || any_watched) {
        BT_PROFILE("frond respond");
        respond_to_contacts(world, h);
        report.effects_run |=
            world.effects & (FROND_EFFECT_FRICTION | (world.contacts.empty() ? 0 : FROND_EFFECT_TWO_WAY));
    }
    world.profile.ms_response = timer.ms();
    report.contact_count = int(world.contacts.size());
    report.plant_contact_count = int(world.plant_contacts.size());
    report.awake_count = int(world.awake.size());
}

void finish_touched(World& world, const Surroundings& surroundings) {
    std::vector<PlantBody*> touched;
    for (PlantBody* body : world.awake)
        if (waits(*body->plant) && body->level.is_due && !body->plant->state.modal) touched.push_back(body);
    run_jobs(world, touched.size(), [&](size_t i) { finish(world, *touched[i], surroundings); });
}

void take_step(World& world, btCollisionWorld& collision_world, double h) {
    FROND_ASSERT(h > 0);
    const Timer step_timer;
    const Surroundings surroundings = begin_step(world, collision_world, h);
    if (world.ledger) count_calls(world);
    call_roll(world);
    carry_what_came_off(world, h);
    find_touches(world, h);
    call_roll(world);
    note_touches(world);
    choose_details(world);
    mark_touched(world);
    if (world.ledger) begin_work(world);
    {
        BT_PROFILE("frond solve");
        const std::vector<StepJob> jobs = share_out(world, surroundings, h);
        run_jobs(world, jobs.size(), [&](size_t i) { run_job(world, jobs[i], surroundings, h); });
    }
    handle_contacts(world, h);
    finish_touched(world, surroundings);
    if (world.ledger) count_work(world);
    {
        BT_PROFILE("frond settle");
        const Timer timer;
        for (PlantBody* body : world.awake) settle(world, *body, collision_world);
        world.profile.ms_capsules += timer.ms();
    }
    if (world.ledger) count_what_came_off(world);
    note_touching(world);
    if (world.sleep_distance > 0) put_to_sleep(world);
    compress_looked_at(world);
    limit_motors(world, h);
    world.time += h;
    world.profile.ms_step = step_timer.ms();
    learn_times(world);
}

// Aborts a step that cannot be completed: plants that have not completed it are put back to its start. Bullet has moved
// its bodies and will not reach the end of stepSimulation, so the forces on them are cleared here.
void break_off_step(World& world) {
    world.bullet->clearForces();
    for (PlantBody* body : world.awake) {
        drop_step(*body->plant);
        body->level.pending = 0;
    }
}

}  // namespace

void World::updateAction(btCollisionWorld* collision_world, btScalar step) {
    const double h = double(step);
    put_back_children(lacking);
    if (!(h > 0) || !std::isfinite(h)) return;
    BT_PROFILE("frond");
    is_stepping = true;
    const auto end = [&] {
        end_detection(*bullet);
        is_stepping = false;
    };
    try {
        take_step(*this, *collision_world, h);
    } catch (...) {
        break_off_step(*this);
        end();
        throw;
    }
    end();
}

void advance(World& world, double dt) {
    const int substeps = int(std::ceil(dt / world.max_substep - 1e-9));
    if (substeps > 0) limit_motors(world, dt / substeps);
    for (int i = 0; i < substeps; i++) world.bullet->stepSimulation(btScalar(dt / substeps), 0);
    for (PlantBody* body : world.awake) clear_user_force(*body->plant);
}

// Computes FNV-1a over the bits of all nodes, plastic states and fragments.
uint64_t state_hash(World& world) {
    uint64_t hash = 0xcbf29ce484222325u;
    const auto add = [&](const auto& values) {
        const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
        for (size_t i = 0; i < size_t(values.size()) * sizeof(double); i++) hash = (hash ^ bytes[i]) * 0x100000001b3u;
    };
    for (const std::unique_ptr<PlantBody>& body : world.bodies) {
        look_at(*body);
        add(body->plant->state.motion.x);
        add(body->plant->state.motion.v);
        add(plastic_of(*body->plant));
        for (size_t k = 0; k < body->fragment_bodies.size(); k++) {
            const Fragment& fragment = body->plant->state.fragments[k];
            const btRigidBody& rigid = *body->fragment_bodies[k]->body;
            add(fragment.turn);
            add(fragment.shift);
            add(from_bullet(rigid.getLinearVelocity()));
            add(from_bullet(rigid.getAngularVelocity()));
        }
    }
    compress_looked_at(world);
    return hash;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
