// In: plants that may share a batch and a time h. Out: what solve_plant() finds for each. They are gathered into lanes,
// solved, checked, and handed out again. A plant whose step is not acceptable is put back to its start and stepped
// alone.
#include "batch/plants.hpp"

#include <algorithm>

#include "batch/air.hpp"
#include "core/assert.hpp"
#include "core/elementary.hpp"
#include "core/lane_vectors.hpp"
#include "core/lanes_of_plants.hpp"
#include "core/timer.hpp"
#include "mechanics/attachment_lanes.hpp"
#include "mechanics/batch.hpp"
#include "plant/fibres.hpp"
#include "plant/guard.hpp"
#include "plant/plant_step.hpp"
#include "solve/system.hpp"

namespace frond {

struct PlantBatch {
    Batch step;
    AirBatch air;
    NumbersInLines forces;
    std::array<VecX, MOST_LANES> x, v;  // plants' states at the end of the step
};

namespace {

// Gathers the vectors that `of` returns for the lanes' plants.
template <class Of>
struct Gather {
    const Of& of;
    NumbersInLines& to;
    template <class S>
    FROND_INLINE void run() const {
        const double* from[LANES<S>];
        for (int lane = 0; lane < LANES<S>; lane++) from[lane] = of(lane).data();
        put_side_by_side<S>(from, size_t(of(0).size()), to.data());
    }
};

// Copies lanes back to one vector per plant.
struct HandOut {
    const NumbersInLines& from;
    std::array<VecX, MOST_LANES>& plants;
    template <class S>
    FROND_INLINE void run() const {
        double* to[LANES<S>];
        for (int lane = 0; lane < LANES<S>; lane++) {
            plants[size_t(lane)].resize(Eigen::Index(from.size()) / LANES<S>);
            to[lane] = plants[size_t(lane)].data();
        }
        put_apart<S>(from.data(), from.size() / LANES<S>, to);
    }
};

// Finds lanes whose nodes moved farther than in any healthy step, and lanes that ended off course, or nearly so.
struct LookAtWays {
    const Batch& step;
    double size, h;  // size of the plants [m], length of the step [s]
    bool turns;      // every other node is a rotation vector
    unsigned &far_away, &off_course, &whips;
    template <class S>
    FROND_INLINE void run() const {
        const double far = squared(OFF_COURSE * size) * NEARLY;
        const double turned = TURNED_OFF_COURSE * TURNED_OFF_COURSE * NEARLY;
        S near = constant<S>(1), on_course = near, calm = near;
        for (int i = 0; i < step.system->elements->node_count; i++) {
            const Lanes3<S> way = load3<S>(step.x_end.data(), 3 * i) - load3<S>(step.x.data(), 3 * i);
            const Lanes3<S> off = way - constant<S>(h) * load3<S>(step.v.data(), 3 * i);
            const bool is_turn = turns && i % 2;
            on_course = select(dot(off, off) < (is_turn ? turned : far), on_course, S{});
            if (is_turn) continue;
            near = select(dot(way, way) < squared(FARTHEST_WAY * size) * NEARLY, near, S{});
            calm = select(dot(way, way) < squared(WHIPS) * NEARLY, calm, S{});
        }
        far_away = bits_of(near == 0.0);
        off_course = bits_of(on_course == 0.0);
        whips = bits_of(calm == 0.0);
    }
};

// Finds lanes in which a fibre is taut, or nearly so.
struct LookForTaut {
    const Batch& step;
    const Fibres& fibres;
    unsigned& taut;
    template <class S>
    FROND_INLINE void run() const {
        S slack = constant<S>(1);
        for (const Fibre& fibre : fibres.list) {
            const Lanes3<S> way =
                attachment_sum<S>(fibre.end, step.x_end.data()) - attachment_sum<S>(fibre.begin, step.x_end.data());
            slack = select(dot(way, way) < squared(fibre.length) * NEARLY, slack, S{});
        }
        taut = bits_of(slack == 0.0);
    }
};

unsigned find_taut(const Batch& step, const Plant& plant, frond_effects effects) {
    unsigned taut = 0;
    if (plant.fibres && (effects & FROND_EFFECT_FIBRES))
        run_in_lanes(step.lanes, LookForTaut{step, *plant.fibres, taut});
    return taut;
}

// Finds lanes in which an element may be strained beyond its yield strain. Rods' retraction has measured that already.
unsigned find_yielding(const Batch& step, frond_effects effects) {
    const System& system = *step.system;
    if (!(effects & FROND_EFFECT_PLASTICITY) || system.elements->yields.empty()) return 0;
    const auto look = system.row->batch->may_yield;
    return look ? look(*system.elements, step.x_end) : step.may_yield;
}

// Reports a plant's share of the step: one solve, and its part of the times [ms].
void report_step(Plant& plant, const Batch& step, int lane, double ms_air, double ms_solve) {
    plant.report = {};
    plant.report.ok = true;
    plant.report.iterations = 1;
    plant.report.inverted = step.inverted[size_t(lane)];
    plant.report.residual = step.residual[size_t(lane)];
    plant.report.ms_solve = float(ms_solve);
    plant.ms_air = plant.ms_effects = float(ms_air);
    plant.ms_user_force = plant.ms_fibres = plant.ms_plasticity = 0;
}

std::shared_ptr<PlantBatch> take_batch(WorkspacePool& pool) {
    std::lock_guard<std::mutex> lock(pool.mutex);
    if (pool.batch.empty()) return std::make_shared<PlantBatch>();
    std::shared_ptr<PlantBatch> space = std::move(pool.batch.back());
    pool.batch.pop_back();
    return space;
}

void return_batch(WorkspacePool& pool, std::shared_ptr<PlantBatch> space) {
    std::lock_guard<std::mutex> lock(pool.mutex);
    pool.batch.push_back(std::move(space));
}

void gather_motions(Batch& step, Plant* const* plants, int count, const Surroundings& surroundings,
                    frond_effects effects) {
    const bool looks_back = plants[0]->step.looks_back;
    const auto at = [&](int lane) -> Plant& { return *plants[std::min(lane, count - 1)]; };
    const auto gather_from = [&](const auto& of, NumbersInLines& to) {
        run_in_lanes(step.lanes, Gather<decltype(of)>{of, to});
    };
    gather_from([&](int lane) -> const VecX& { return at(lane).state.motion.x; }, step.x);
    gather_from([&](int lane) -> const VecX& { return at(lane).state.motion.v; }, step.v);
    if (looks_back) {
        gather_from([&](int lane) -> const VecX& { return at(lane).state.motion.history.x_prev; }, step.x_prev);
        gather_from([&](int lane) -> const VecX& { return at(lane).state.motion.history.v_prev; }, step.v_prev);
    }
    for (int lane = 0; lane < step.lanes; lane++) {
        const Vec3 gravity = gravity_in(at(lane), surroundings, effects);
        for (int c = 0; c < 3; c++) step.gravity[size_t(c * step.lanes + lane)] = gravity[c];
    }
}

void take_loads(Plant& plant, const Batch& step, int lane, frond_effects effects) {
    plant.step.loads->drags.clear();
    plant.step.loads->springs.clear();
    plant.step.loads->fibres = nullptr;
    plant.step.has_fibres = effects & FROND_EFFECT_FIBRES;
    plant.step.loads->force.resize(0);
    for (int c = 0; c < 3; c++) plant.step.loads->gravity[c] = step.gravity[size_t(c * step.lanes + lane)];
}

bool is_plausible(Plant& plant, const Batch& step, int lane, double h) {
    take_drags(step, lane, plant.step.loads->drags);
    const bool plausible = is_plausible(plant, h);
    plant.step.loads->drags.clear();
    return plausible && !is_far_out(plant);
}

// Lanes whose plants need a look, a bit each.
struct Looks {
    unsigned off_course;  // they may have ended there
    unsigned taut;        // a fibre is taut at the end, or nearly so
    unsigned going_on;    // contacts move them from there
};

bool fibres_hold(Plant& plant, const Batch& step, int lane) {
    if (!(step.with_fibres >> lane & 1)) return holds_for_fibres(plant, nullptr);
    const VecX from = linearized_end(step, lane);
    return holds_for_fibres(plant, &from);
}

// Leaves in the plant all that solve_plant() leaves of a healthy step. False, with the motion unchanged: the plant has
// to be stepped alone.
bool take_step(Plant& plant, PlantBatch& space, int lane, const SolveSettings& settings, const Looks& looks,
               frond_effects effects, double h) {
    const Batch& step = space.step;
    const auto is_in = [&](unsigned bits) { return (bits >> lane & 1) != 0; };
    Motion& motion = plant.state.motion;
    History& history = motion.history;
    VecX &x = space.x[size_t(lane)], &v = space.v[size_t(lane)];
    const bool has_fibres = is_in(step.with_fibres | looks.taut), goes_on = is_in(looks.going_on);
    plant.step.starts_anew = !plant.step.looks_back && !plant.state.is_touched;
    const bool is_asked = is_in(looks.off_course | looks.going_on | step.wound) || has_fibres || may_inflate(plant) ||
                          plant.step.starts_anew || step.inverted[size_t(lane)] > 0;
    if (is_asked) {
        plant.step.x_good = motion.x;
        plant.step.v_good = motion.v;
    }
    motion.x.swap(x);
    motion.v.swap(v);
    take_loads(plant, step, lane, effects);
    plant.step.is_off_course = false;
    plant.step.push = nullptr;
    plant.step.takes = 1;
    const float stretched = plant.state.stretched;
    if ((has_fibres && !fibres_hold(plant, step, lane)) || (is_asked && !is_plausible(plant, step, lane, h))) {
        motion.x.swap(x);
        motion.v.swap(v);
        plant.state.stretched = stretched;
        return false;
    }
    if (!is_asked) {
        // The start of the step is kept once, in the history.
        plant.step.x_good.resize(0);
        plant.step.v_good.resize(0);
    }
    history.x_prev.swap(x);
    history.v_prev.swap(v);
    // Until the next step only its contacts can move the plant without dropping its history.
    history.x_end.resize(0);
    history.v_end.resize(0);
    if (goes_on) {
        history.x_end = motion.x;
        history.v_end = motion.v;
    }
    history.shaken = !plant.step.looks_back;
    if (!plant.step.looks_back) {
        history.valid = true;
        history.integrator = settings.integrator;
        history.pinned = motion.pinned;
    }
    history.h = h;
    plant.view.lead = 0;
    plant.step.is_sound = true;
    // Of what settings_for() gives, this alone may differ within a batch.
    plant.step.settings = settings;
    plant.step.settings.is_touched = plant.state.is_touched;
    for (int c = 0; c < 3; c++) plant.state.blown[c] = space.forces[size_t(c * step.lanes + lane)];
    return true;
}

// Gives plants whose steps go on by themselves their own factors.
void take_factors(const Batch& step, Plant* const* plants, unsigned which) {
    if (which == 0) return;
    std::array<Workspace*, MOST_LANES> workspaces = {};
    for (size_t lane = 0; lane < size_t(step.lanes); lane++) {
        if (!(which >> lane & 1)) continue;
        take_workspace(*plants[lane]);
        workspaces[lane] = plants[lane]->step.workspace.get();
    }
    take_apart(step, workspaces.data());
}

// Leaves a plant ready for contacts, with its own drags.
void go_on_alone(Plant& plant, const Batch& step, int lane) {
    plant.state.blown.setZero();
    take_drags(step, lane, plant.step.loads->drags);
    finish_solving(plant);
}

// Returns the lanes whose plants are such, a bit each.
unsigned find_lanes(Plant* const* plants, int count, bool (*is_such)(const Plant&)) {
    unsigned lanes = 0;
    for (int lane = 0; lane < count; lane++) lanes |= unsigned(is_such(*plants[lane])) << lane;
    return lanes;
}

// Does solve_batch() for plants whose prediction holds, in that many lanes.
void solve_in_lanes(Plant* const* plants, int count, int lanes, const Surroundings& surroundings, double h) {
    const std::shared_ptr<WorkspacePool> pool = plants[0]->seat.pool;
    const std::shared_ptr<PlantBatch> space = take_batch(*pool);
    Batch& step = space->step;
    const frond_effects effects = plants[0]->input.effects & surroundings.effects;
    const SolveSettings settings = settings_for(*plants[0], effects);
    make_room(step, plants[0]->system, lanes);
    Timer timer;
    gather_motions(step, plants, count, surroundings, effects);
    const unsigned bad_wind = gather_air(space->air, step, plants, count, surroundings, effects, h);
    const double ms_air = timer.lap();

    step.with_fibres = effects & FROND_EFFECT_FIBRES
                           ? find_lanes(plants, count, [](const Plant& plant) { return plant.state.stretched > 0; })
                           : 0;
    step.fibres = plants[0]->fibres ? &plants[0]->fibres->list : nullptr;
    const double h_before = plants[0]->step.looks_back ? plants[0]->state.motion.history.h : 0;
    unsigned alone = step_batch(step, settings, plants[0]->state.motion.pinned, h, h_before), far_away, off_course,
             whips;
    run_in_lanes(step.lanes,
                 LookAtWays{step, double(plants[0]->size), h, bool(plants[0]->follow), far_away, off_course, whips});
    const double asked_from = step.system->row->asked_from;
    if (asked_from > 0)
        off_course |= step.system->row->batch->not_calm(*step.system->elements, step.x, step.x_end, 1 / asked_from);
    whips &= find_lanes(plants, count, [](const Plant& plant) { return plant.step.is_among_bodies && !waits(plant); });
    alone |= far_away | whips;
    air_forces(step, space->forces);
    const unsigned may_yield = find_yielding(step, effects);
    const Looks looks = {off_course, find_taut(step, *plants[0], effects), find_lanes(plants, count, waits)};
    run_in_lanes(step.lanes, HandOut{step.x_end, space->x});
    run_in_lanes(step.lanes, HandOut{step.v_end, space->v});
    take_factors(step, plants, looks.going_on & ~alone & ((1u << count) - 1));
    const double ms_solve = timer.lap();

    for (int lane = 0; lane < count; lane++) {
        Plant& plant = *plants[lane];
        const auto is_in = [&](unsigned bits) { return (bits >> lane & 1) != 0; };
        if (is_in(alone) || !take_step(plant, *space, lane, settings, looks, effects, h)) {
            solve_plant(plant, surroundings, h);
            continue;
        }
        plant.trouble = is_in(bad_wind) ? FROND_TROUBLE_BAD_WIND : 0;
        plant.step.may_yield = is_in(may_yield | looks.going_on);
        report_step(plant, step, lane, ms_air / count, ms_solve / count);
        if (is_in(looks.going_on)) go_on_alone(plant, step, lane);
    }
    return_batch(*pool, space);
}

}  // namespace

void solve_batch(Plant* const* given, int given_count, const Surroundings& surroundings, double h) {
    FROND_ASSERT(given_count <= MOST_LANES);
    std::array<Plant*, MOST_LANES> plants;
    int count = 0;
    for (int i = 0; i < given_count; i++) {
        Plant& plant = *given[i];
        if (goes_on(plant, h))
            plants[size_t(count++)] = &plant;
        else
            solve_plant(plant, surroundings, h);
    }
    FROND_ASSERT(std::all_of(plants.begin(), plants.begin() + count,
                             [&](const Plant* plant) { return go_alike(*plants[0], *plant); }));
    // A batch with half of its lanes empty is no faster than its plants one by one.
    const int lanes = lanes_for(count);
    if (count >= lanes / 2 + 1) return solve_in_lanes(plants.data(), count, lanes, surroundings, h);
    for (int i = 0; i < count; i++) solve_plant(*plants[size_t(i)], surroundings, h);
}

}  // namespace frond
