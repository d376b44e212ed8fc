// One step of a plant: effects -> solve -> (contact response) -> accept, with plastic strain, or rewind -> chain.
#include <algorithm>
#include <cmath>

#include "core/assert.hpp"
#include "core/timer.hpp"
#include "plant/chain_state.hpp"
#include "plant/guard.hpp"
#include "plant/load_work.hpp"
#include "plant/pins.hpp"
#include "plant/seen.hpp"
#include "solve/integrator.hpp"

namespace frond {

Vec3 gravity_in(const Plant& plant, const Surroundings& surroundings, frond_effects effects) {
    return effects & FROND_EFFECT_GRAVITY ? Vec3(plant.rotation.conjugate() * surroundings.gravity)
                                          : Vec3(Vec3::Zero());
}

// Gathers the forces on nodes, gravity and springs of this step, in the model's frame.
static void gather_loads(Plant& plant, const Surroundings& surroundings, frond_effects effects) {
    const Quat to_model = plant.rotation.conjugate();
    Loads& loads = *plant.step.loads;
    loads.gravity = gravity_in(plant, surroundings, effects);
    loads.springs = plant.input.pin_springs;
    loads.guides = &guides_of(plant);
    loads.force.resize(0);
    loads.fibres = nullptr;
    if (!(effects & FROND_EFFECT_USER_FORCE)) return;

    if (plant.input.has_user_force) {
        const Mat3 turn = to_model.toRotationMatrix();
        loads.force.setZero(plant.state.motion.x.size());
        gather_chain_loads(plant, loads.force);
        const VecX& given = plant.input.forces->on_nodes;
        for (int i = 0; i < given.size() / 3; i++) {
            const Vec3 force = turn * point(given, i);
            if (force.isZero(0)) continue;
            add_attachment_force(pulled_at_node(plant, i), plant.state.motion.x, force, loads.force);
        }
    }
    for (const Grab& grab : plant.input.grabs)
        if (!fragment_of_vertex(plant, size_t(grab.vertex))) loads.springs.push_back(grab_spring(plant, grab));
}

// Has steps with forces of the host, and those that follow, look back on none: where a force begins or ends, bdf2 would
// give half a step too little or too much of its momentum.
static void drop_history_at_forces(Plant& plant) {
    if (plant.step.loads->force.size() > 0)
        plant.state.motion.history.valid = plant.state.motion.history.shaken = false;
}

// Makes a part of what is strained beyond its yield plastic.
static void keep_sets(Plant& plant, double h) {
    const Mechanics& row = mechanics(plant.which, plant.nodes->order);
    const Elements& shared = elements_of(*plant.system);
    if (shared.yields.empty()) return;
    if (!plant.state.own_elements) {
        if (!plant.step.may_yield || !row.yields(shared, plant.state.motion.x)) return;
        plant.state.own_elements = row.copy(shared);
    }
    row.flow(*plant.state.own_elements, plant.state.motion.x, h);
}

// Returns whether the solution, as moved since then, can be the next state.
static bool is_sound(const Plant& plant) {
    return plant.report.ok && are_finite(plant.state.motion.x) && are_finite(plant.state.motion.v) &&
           !has_run_away(plant);
}

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
static void stop_by_fibres(Plant& plant, double h) {
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
static void solve_again(Plant& plant, double h) {
    const frond_integrator own = plant.step.settings.integrator;
    // From rest, entangled rods that are bent by their leaves' tips would stay still and never part.
    const bool from_rest = !plant.state.is_entangled;
    const bool was_solved = plant.report.ok;
    const VecX x_once = plant.state.motion.x, v_once = plant.state.motion.v;
    if (!plant.state.is_touched && own != FROND_INTEGRATOR_IMPLICIT_EULER && !integrator(own).trusts_start) {
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

// Returns whether one solve predicts the displacements well. An unwound rotation vector has not turned far.
static bool is_calm_way(const Plant& plant) {
    const VecX& from = plant.step.x_good;
    const auto is_calm_to = [&](const VecX& to) { return is_calm(*plant.system, from, to); };
    return is_calm_to(plant.state.motion.x) || (plant.follow && is_calm_to(wound_as(from, plant.state.motion.x)));
}

SolveSettings settings_for(const Plant& plant, frond_effects effects) {
    SolveSettings settings = plant.input.settings;
    if (!(effects & FROND_EFFECT_DAMPING))
        settings.mass_damping = settings.stiffness_damping = settings.full_damping = 0;
    damp_recovering(plant, settings);
    if (need_several_solves(plant)) settings.newton_iterations = std::max(settings.newton_iterations, ENOUGH_SOLVES);
    // Contacts add their response to the linear solution first.
    settings.is_touched = plant.state.is_touched;
    return settings;
}

void solve_plant(Plant& plant, const Surroundings& surroundings, double h) {
    const frond_effects effects = plant.input.effects & surroundings.effects;
    Motion& motion = plant.state.motion;
    FROND_ASSERT(h > 0 && !plant.state.is_compressed && !plant.state.modal);
    FROND_ASSERT(motion.x.size() == 3 * elements_of(plant).node_count && motion.v.size() == motion.x.size());
    FROND_ASSERT(std::abs(plant.rotation.norm() - 1) < 1e-9);
    plant.step.x_good = motion.x;
    plant.step.v_good = motion.v;
    plant.trouble = 0;
    plant.view.lead = 0;
    plant.step.may_yield = true;
    plant.step.push = nullptr;
    plant.step.takes = 1;
    plant.step.has_fibres = effects & FROND_EFFECT_FIBRES;

    // Effects.
    take_workspace(plant);
    Timer timer;
    apply_pins(plant);
    if (jump_with_pins(plant, JUMP)) plant.trouble |= FROND_TROUBLE_PASSED;
    plant.step.loads->springs_are_far = lead_pin_springs(plant);
    gather_loads(plant, surroundings, effects);
    plant.ms_user_force = timer.lap();
    gather_air(plant, surroundings, effects, h);
    plant.ms_air = timer.lap();
    plant.step.settings = settings_for(plant, effects);
    plant.ms_effects = plant.ms_user_force + plant.ms_air;
    plant.ms_fibres = plant.ms_plasticity = 0;

    // Solve.
    drop_history_at_forces(plant);
    motion.history.shaken |= plant.state.is_touched;
    plant.step.starts_anew = integrator(plant.input.settings.integrator).looks_back && !motion.history.valid;
    plant.report = solve_in_substeps(plant, h);
    if (plant.report.ok && fibre_becomes_taut(plant)) stop_by_fibres(plant, h);
    if (!plant.report.ok || !is_plausible(plant, h)) solve_again(plant, h);
    finish_solving(plant);
}

void finish_solving(Plant& plant) {
    // No node has moved since the plausibility check. A plant on its course is not being stretched.
    plant.step.is_sound = plant.report.ok && !(plant.step.is_off_course && is_far_out(plant));
}

double parting_work(double mass, double h) {
    constexpr double SPEED = 0.1;  // [m/s]
    return mass * GRAVITY * SPEED * h;
}
double parting_work(const Plant& plant, double h) {
    return parting_work(node_mass_of(*plant.system).sum(), h);
}

// Corrects positions as far as nothing bends much and the work done on the plant stays small: contacts with conflicting
// corrections would compress it like a spring. The rest is left to the next steps; even of an excessive correction a
// little is applied, or thick stems would never part.
static VecX move_by(Plant& plant, const VecX& dv, double h) {
    constexpr double LEAST = 0.002;  // share [-]
    const VecX x = plant.state.motion.x;
    const ContactPush* push = plant.step.push.get();
    const bool is_known = push && push->x.size() == x.size() && push->x == x;
    const double allowed = (is_known ? push->elastic : elastic_energy(plant, x)) + parting_work(plant, h);
    for (double share = 1; share > LEAST; share /= 2) {
        add_correction(*plant.step.workspace, share * dv, plant.state.motion);
        if (is_calm_way(plant) && elastic_energy(plant, plant.state.motion.x) <= allowed)
            return plant.state.motion.x - x;
        plant.state.motion.x = x;
    }
    return {};
}

// Solves a chain again in another workspace: the responses that follow in this step are by the factor of the step
// without contacts, from which all contacts' velocities are. A chain that a push has thrown far may be stiffer there by
// far, and the next push would be as much larger. A cage stiffens as it bends, which foretells what the next push does.
static void solve_again_aside(Plant& plant, double h) {
    if (!plant.follow) return solve_again(plant, h);
    WorkspacePtr without = std::move(plant.step.workspace);
    take_workspace(plant);
    solve_again(plant, h);
    return_workspace(plant);
    plant.step.workspace = std::move(without);
}

ContactPush& push_of(Plant& plant) {
    if (!plant.step.push) plant.step.push = std::make_unique<ContactPush>();
    return *plant.step.push;
}

void add_contacts(Plant& plant, double h) {
    FROND_ASSERT(plant.step.workspace);
    ContactPush& push = push_of(plant);
    if (!plant.step.is_sound) return push.impulse.resize(0);
    VecX dv;
    const bool has_impulse = push.impulse.size() > 0;
    if (has_impulse && respond(*plant.step.workspace, plant.input.settings, push.impulse, dv))
        add_response(*plant.step.workspace, dv, plant.state.motion);
    // What is pushed goes along with what pushes it, as far as the response is linear.
    if (has_impulse) push.most_work = std::max(0.0, push.impulse.dot(plant.state.motion.v));
    retract_step(*plant.step.workspace, plant.state.motion);
    if (has_impulse) push.most_work = std::min(push.most_work, std::max(0.0, push.impulse.dot(way_of_step(plant)) / h));
    // Cages are not retracted: what turns in them is inflated.
    const bool is_bent =
        has_impulse && !plant.follow && !is_calm(*plant.system, plant.step.x_good, plant.state.motion.x);
    // Where this is too far for the linear response, the same push is solved as a force, nonlinearly.
    if (has_impulse) look_at_fibres(plant);
    if (is_bent || !is_plausible(plant, h)) solve_again_aside(plant, h);
    plant.step.is_sound = is_sound(plant) && !is_far_out(plant);
}

VecX correct_position(Plant& plant, const VecX& impulses, double h) {
    FROND_ASSERT(plant.step.workspace);
    VecX dv;
    if (!plant.step.is_sound || !respond(*plant.step.workspace, plant.input.settings, impulses, dv)) return {};
    const VecX way = move_by(plant, dv, h);
    plant.step.is_sound = is_sound(plant) && !is_far_out(plant);
    return way;
}

void accept_step(Plant& plant, const Surroundings& surroundings, double h) {
    const frond_effects effects = plant.input.effects & surroundings.effects;
    Motion& motion = plant.state.motion;
    if (!plant.report.converged) plant.trouble |= FROND_TROUBLE_NOT_CONVERGED;
    if (plant.report.inverted > 0) plant.trouble |= FROND_TROUBLE_INVERTED;
    // Accept, or rewind to the last good state, at rest; from where that leads nowhere, start from the modelled shape.
    if (!plant.step.is_sound) {
        const bool is_stuck = plant.step.v_good.isZero(0);
        motion.x = plant.step.x_good;
        motion.v.setZero();
        motion.history.valid = false;
        plant.trouble |= FROND_TROUBLE_REWOUND;
        if (is_stuck && !jump_with_pins(plant, STUCK_BEHIND)) start_from_modelled(plant);
    }
    if (plant.step.work) *plant.step.work = work_of_loads(plant, h);
    if (plant.step.is_sound) {
        watch_recovery(plant, h);

        // Where a search gave up is no place in which the plant stays.
        const bool is_lost = plant.trouble & FROND_TROUBLE_RETRIED && !plant.report.converged;
        if (effects & FROND_EFFECT_PLASTICITY && plant.state.recovers_for <= 0 && !is_lost) {
            const Timer timer;
            keep_sets(plant, h);
            plant.ms_plasticity = timer.ms();
        }
    }
    FROND_ASSERT(are_finite(motion.x) && are_finite(motion.v));
    FROND_ASSERT(motion.x.size() == 3 * elements_of(plant).node_count);
    drop_history_at_forces(plant);
    plant.state.stepped_by = h;
    let_fibres_give(plant, h);
    if (is_pushed(plant) || plant.trouble & (FROND_TROUBLE_RETRIED | FROND_TROUBLE_REWOUND)) look_at_fibres(plant);
    carry_stumps(plant);
    if (plant.follow) unwind(motion);
    pass_blend_time(plant, h);
    moved(plant);
    return_workspace(plant);
}

void drop_step(Plant& plant) {
    if (!plant.step.workspace) return;  // not begun, or done
    Motion& motion = plant.state.motion;
    if (plant.step.x_good.size() == motion.x.size()) {
        motion.x = plant.step.x_good;
        motion.v = plant.step.v_good;
    }
    motion.history.valid = false;
    plant.state.stepped_by = 0;
    moved(plant);
    return_workspace(plant);
}

void step_plant(Plant& plant, const Surroundings& surroundings, double h) {
    solve_plant(plant, surroundings, h);
    accept_step(plant, surroundings, h);
}

HostForces& forces_of(Plant& plant) {
    if (!plant.input.forces) plant.input.forces = std::make_unique<HostForces>();
    return *plant.input.forces;
}

void clear_user_force(Plant& plant) {
    if (!plant.input.has_user_force) return;
    plant.input.forces->on_nodes.setZero();
    plant.input.forces->on_chain.setZero();
    plant.input.has_user_force = false;
}

}  // namespace frond
