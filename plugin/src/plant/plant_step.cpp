// One step of a plant: effects -> solve -> (contact response) -> accept, with plastic strain, or rewind -> chain.
#include <algorithm>
#include <cmath>

#include "core/assert.hpp"
#include "core/timer.hpp"
#include "plant/guard.hpp"
#include "plant/load_work.hpp"
#include "plant/pins.hpp"
#include "plant/plant_step.hpp"
#include "plant/seen.hpp"
#include "solve/integrator.hpp"

namespace frond {

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

}  // namespace frond
