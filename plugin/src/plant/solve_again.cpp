// In: a solved step that cannot be right. Out: one that can: by descent of its potential, of which any iterate will do.
#include <algorithm>

#include "core/timer.hpp"
#include "plant/guard.hpp"
#include "plant/plant_step.hpp"
#include "solve/integrator.hpp"

namespace frond {

// Solves the step again from its start, with fibres.
static void solve_from_start(Plant& plant, const SolveSettings& settings, double h) {
    plant.state.motion.x = plant.step.x_good;
    plant.state.motion.v = plant.step.v_good;
    plant.step.loads->fibres = fibres_of(plant);
    const SolveReport before = plant.report;
    plant.report = solve_step(*plant.step.workspace, settings, *plant.step.loads, h, plant.state.motion);
    plant.report.add_cost(before);
}

// Solves again from the start of the step by minimising its potential, in which contacts push by forces: no iterate has
// more than the start, so the first and any later one is a step that can be taken.
static void minimise(Plant& plant, frond_integrator method, double h, bool from_rest) {
    constexpr int ITERATIONS = 30;
    constexpr double ROUGHLY = 0.001;  // residual over the first that is small in steps of one solve [-]
    // Evaluations of all forces: about the most that a search needs, of all searches of a step with contacts together,
    // and what each of those is granted in any case.
    constexpr int MOST_WORK = 400, LEAST_WORK = 100;
    SolveSettings settings = plant.step.settings;
    settings.most_work = is_pushed(plant) ? std::max(LEAST_WORK, MOST_WORK - plant.report.work) : MOST_WORK;
    settings.integrator = method;
    settings.from_rest = from_rest;
    if (settings.newton_iterations == 1) settings.newton_tolerance = std::max(settings.newton_tolerance, ROUGHLY);
    settings.newton_iterations = std::max(settings.newton_iterations, ITERATIONS);
    settings.careful = true;
    plant.trouble |= FROND_TROUBLE_RETRIED;
    const VecX force = plant.step.loads->force;
    if (is_pushed(plant)) {
        plant.step.loads->force = plant.step.push->share / h * plant.step.push->impulse;
        if (force.size() > 0) plant.step.loads->force += force;
    }
    solve_from_start(plant, settings, h);
    plant.step.loads->force = force;
    // A step of its own integrator ends as that would, so the next one needs no damping.
    plant.state.motion.history.shaken = method != plant.step.settings.integrator;
}

// Solves again where a fibre became taut. That is an impact: an integrator that looks back, or ahead within the step,
// would let it spring back faster than it came, so this step and the next are of implicit Euler.
void stop_by_fibres(Plant& plant, double h) {
    const Timer timer;
    SolveSettings settings = plant.step.settings;
    settings.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    settings.newton_iterations = std::max(settings.newton_iterations, ENOUGH_SOLVES);
    solve_from_start(plant, settings, h);
    plant.state.motion.history.shaken = true;
    look_at_fibres(plant);
    plant.ms_fibres = timer.ms();
}

// Goes only as far along the step as the plant gains no energy that nothing can have given.
static void hold_back(Plant& plant, double h) {
    constexpr double LEAST = 0.01;  // share of the step from which on it is rewound [-]
    Motion& motion = plant.state.motion;
    const VecX way = way_of_step(plant), v = motion.v;
    for (double share = 0.5; plant.report.ok && !is_plausible(plant, h); share /= 2) {
        plant.report.ok = share > LEAST;
        motion.x = plant.step.x_good + share * way;
        motion.v = share * v;
        if (plant.step.push) plant.step.push->gone = share;
    }
}

// Solves again where one solve gave the plant energy that nothing can have given: by its own integrator, which keeps
// vibrations, and if that fails too by implicit Euler. That gains no energy but by a push which no longer points where
// it was to push, for the plant has turned: then it pushes less.
void solve_again(Plant& plant, double h) {
    const frond_integrator own = plant.step.settings.integrator;
    // From rest, entangled rods that are bent by their leaves' tips would stay still and never part.
    const bool from_rest = !plant.state.is_entangled;
    const bool was_solved = plant.report.ok;
    const VecX x_once = plant.state.motion.x, v_once = plant.state.motion.v;
    const bool has_own = own != FROND_INTEGRATOR_IMPLICIT_EULER && !integrator(own).trusts_start;
    if (has_own && !plant.state.is_touched && !plant.report.is_sudden) {
        minimise(plant, own, h, from_rest);
        if (plant.report.ok && is_plausible(plant, h)) return;
    }
    plant.state.motion.history.valid = false;
    for (const double share : {1.0, 0.25, 0.05, 0.0}) {
        if (share > plant.step.takes) continue;
        if (is_pushed(plant)) plant.step.push->share = plant.step.takes = share;
        minimise(plant, FROND_INTEGRATOR_IMPLICIT_EULER, h, from_rest || share < 1);
        if (!is_pushed(plant) || !plant.report.ok || is_plausible(plant, h)) break;
    }
    if (was_solved && !plant.report.converged && way_of_step(plant).isZero(0)) {
        // The search found no way at all, and would find none in the next step: a part of what one solve gave is one.
        plant.state.motion.x = x_once;
        plant.state.motion.v = v_once;
        plant.report.ok = true;
    }
    hold_back(plant, h);
}

}  // namespace frond
