// In: a plant's motion, what acts on it and a time h. Out: its motion h later, or the same motion and ok = false.
#include <cmath>

#include "solve/drags.hpp"
#include "solve/integrator.hpp"
#include "solve/springs.hpp"

namespace frond {

namespace {

// Sizes fit and numbers are finite; what is not would only come back as NaN after an expensive step.
bool input_is_sound(const System& system, const StepInput& input) {
    const SolveSettings& s = input.settings;
    const Eigen::Index n = 3 * Eigen::Index(system.elements->node_count);
    const Motion& motion = input.motion;
    if (s.integrator < 0 || s.integrator >= FROND_INTEGRATOR_COUNT || s.linear_solver < 0 ||
        s.linear_solver >= FROND_LINEAR_SOLVER_COUNT)
        return false;
    if (!(input.h > 0) || !std::isfinite(input.h) || !(s.mass_damping >= 0) || !std::isfinite(s.mass_damping) ||
        !(s.stiffness_damping >= 0) || !std::isfinite(s.stiffness_damping))
        return false;
    if (!(s.full_damping >= 0) || !std::isfinite(s.full_damping)) return false;
    if (motion.x.size() != n || motion.v.size() != n || input.loads.force.size() != n) return false;
    if (!motion.pinned.empty() && (motion.pinned.size() * 3 != size_t(n) || motion.pin_target.size() != n))
        return false;
    if (!(s.spectral_radius >= 0 && s.spectral_radius <= 1)) return false;
    return motion.x.allFinite() && motion.v.allFinite() && input.loads.force.allFinite() &&
           input.loads.gravity.allFinite() && springs_are_sound(system, input.loads.springs) &&
           drags_are_sound(system, input.loads.drags);
}

// What does not change during a step: which nodes are held and how they move, and the forces that do not depend on the
// motion.
void prepare(Workspace& workspace, const StepInput& input) {
    const System& system = *workspace.system;
    const Motion& motion = input.motion;
    workspace.held = system.loose;
    if (system.row->rotary_inertia) system.row->rotary_inertia(*workspace.elements, motion.x, workspace.inertia);
    workspace.external = input.loads.force;
    workspace.v_start = motion.v;
    for (int i = 0; i < system.elements->node_count; ++i) {
        if (!motion.pinned.empty() && motion.pinned[size_t(i)]) {
            workspace.held[size_t(i)] = 1;
            point(workspace.v_start, i) = (point(motion.pin_target, i) - point(motion.x, i)) / input.h;
        }
        // The rows of either mass matrix add up to the lumped mass.
        point(workspace.external, i) += system.masses.node[i] * input.loads.gravity;
    }
}

// Stiffness-proportional damping: the same for all elements, or each its own in a matrix apart.
void prepare_damping(Workspace& workspace, const SolveSettings& settings) {
    const System& system = *workspace.system;
    const std::vector<double>& ratio = system.elements->damping_ratio;
    workspace.element_damping.clear();
    workspace.damping_scale = settings.stiffness_damping;
    if (settings.full_damping == 0 || ratio.empty()) return;
    if (system.damps_alike) {
        workspace.damping_scale += settings.full_damping * ratio.front();
        return;
    }
    workspace.damping_scale = 1;
    workspace.damping.set_pattern(system.elements->pattern);
    for (double share : ratio)
        workspace.element_damping.push_back(settings.stiffness_damping + settings.full_damping * share);
}

// A method that looks back may do so only from the state that it left itself, and not over a jump of the time step.
bool history_holds(const StepInput& input) {
    // Bdf2 is stable while steps grow by less than 1 + sqrt 2 and however they shrink.
    constexpr double LARGEST_GROWTH = 2, LARGEST_FALL = 8;
    const History& history = input.motion.history;
    return history.valid && history.integrator == input.settings.integrator && input.h <= LARGEST_GROWTH * history.h &&
           history.h <= LARGEST_FALL * input.h && history.x_end.size() == input.motion.x.size() &&
           history.pinned == input.motion.pinned && history.x_end == input.motion.x && history.v_end == input.motion.v;
}

// Pinned nodes are where they were told to be, to the last bit, with the velocity that took them there.
void finish_pins(Workspace& workspace, const Motion& motion) {
    for (size_t i = 0; i < motion.pinned.size(); ++i)
        if (motion.pinned[i]) {
            point(workspace.x, int(i)) = point(motion.pin_target, int(i));
            point(workspace.v, int(i)) = point(workspace.v_start, int(i));
        }
}

// The start of this step becomes the past of the next one.
void keep_history(Workspace& workspace, const StepInput& input, Motion& motion) {
    History& history = motion.history;
    const bool was_valid = history.valid;
    history.valid = integrator(input.settings.integrator).looks_back;
    history.shaken = history.valid && !was_valid;
    if (!history.valid) return;
    history.integrator = input.settings.integrator;
    history.h = input.h;
    history.pinned = motion.pinned;
    history.x_prev = motion.x;
    history.v_prev = motion.v;
    history.x_end = workspace.x;
    history.v_end = workspace.v;
    std::swap(history.x_rate, workspace.x_rate);
    std::swap(history.v_rate, workspace.v_rate);
}

}  // namespace

SolveReport solve_step(Workspace& workspace, const SolveSettings& settings, const Loads& loads, double h,
                       Motion& motion) {
    SolveReport report;
    const StepInput input = {settings, loads, motion, h};
    if (!input_is_sound(*workspace.system, input)) return report;
    prepare(workspace, input);
    prepare_damping(workspace, settings);
    const Integrator& method = integrator(settings.integrator);
    motion.history.valid = method.looks_back && history_holds(input);
    if (!method.step(workspace, input, report)) return report;
    finish_pins(workspace, motion);
    if (!workspace.x.allFinite() || !workspace.v.allFinite()) return report;
    keep_history(workspace, input, motion);
    motion.x = workspace.x;
    motion.v = workspace.v;
    if (workspace.system->row->moves_chain) unwind(motion);
    report.ok = true;
    return report;
}

}  // namespace frond
