#include "step/step_plants.hpp"

#include <algorithm>

#include "batch/plants.hpp"
#include "core/assert.hpp"
#include "core/timer.hpp"
#include "plant/plant_step.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// Takes the rest of a step, of one plant or of a batch, when no contact is left to push them; plants that may break
// move their capsules later.
void finish(const World& world, PlantBody* const* bodies, int count, const Surroundings& surroundings) {
    constexpr double LATELY = 0.3;  // share of the last step in the mean of a plant's times [-]
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
    constexpr uint64_t TURNS = 4, SEEN = 8;  // substeps, between which its motion is exact
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
    body.plant->step.is_watched |= whips_among_bodies(*body.plant);
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
    for (int i = 0; i < job.count; i++) plants[size_t(i)]->step.is_watched |= whips_among_bodies(*plants[size_t(i)]);
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

}  // namespace

void step_plants(World& world, const Surroundings& surroundings, double h) {
    const std::vector<StepJob> jobs = share_out(world, surroundings, h);
    run_jobs(world, jobs.size(), [&](size_t i) { run_job(world, jobs[i], surroundings, h); });
}

void finish_touched(World& world, const Surroundings& surroundings) {
    std::vector<PlantBody*> touched;
    for (PlantBody* body : world.awake)
        if (waits(*body->plant) && body->level.is_due && !body->plant->state.modal) touched.push_back(body);
    run_jobs(world, touched.size(), [&](size_t i) { finish(world, *touched[i], surroundings); });
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
