// In: a plant's motion, its loads and a time h. Out: its motion h later, or the same motion and ok = false.
#include <cmath>
#include <tuple>

#include "core/assert.hpp"
#include "solve/drags.hpp"
#include "solve/guides.hpp"
#include "solve/integrator.hpp"
#include "solve/springs.hpp"

namespace frond {

namespace {

// Returns the first mark from i on; the number of marks if there is none.
int next_marked(const std::vector<uint8_t>& marks, int i) {
    const size_t count = marks.size();
    if (size_t(i) >= count) return int(count);
    const void* found = std::memchr(marks.data() + i, 1, count - size_t(i));
    FROND_ASSERT(i >= 0);
    return found ? int(static_cast<const uint8_t*>(found) - marks.data()) : int(count);
}

// Returns whether sizes fit and loads are finite; others would only give NaN after an expensive step.
bool input_is_sound(const System& system, const StepInput& input) {
    const SolveSettings& s = input.settings;
    const Eigen::Index n = 3 * Eigen::Index(system.elements->node_count);
    const Motion& motion = input.motion;
    if (!(input.h > 0) || !std::isfinite(input.h) || !settings_are_sound(s)) return false;
    const VecX& force = input.loads.force;
    if (motion.x.size() != n || motion.v.size() != n || (force.size() != 0 && force.size() != n)) return false;
    if (!motion.pinned.empty() && (motion.pinned.size() * 3 != size_t(n) || motion.pin_target.size() != n))
        return false;
    if (input.loads.guides && !guides_are_sound(system, *input.loads.guides)) return false;
    return are_finite(force) && input.loads.gravity.allFinite() && springs_are_sound(system, input.loads.springs) &&
           drags_are_sound(system, input.loads.drags);
}

// Sets what does not change during a step: which nodes are held and how they move, and the forces that do not depend on
// the motion.
void prepare(Workspace& workspace, const StepInput& input) {
    const System& system = *workspace.system;
    const Motion& motion = input.motion;
    workspace.held = system.loose;
    if (system.row->rotary_inertia) system.row->rotary_inertia(*workspace.elements, motion.x, workspace.inertia);
    if (input.loads.force.size() > 0)
        workspace.external = input.loads.force;
    else
        workspace.external.setZero(motion.x.size());
    workspace.v_start = motion.v;
    const int pinned_count = int(motion.pinned.size());
    for (int i = next_pinned(motion, 0); i < pinned_count; i = next_pinned(motion, i + 1))
        workspace.held[size_t(i)] = 1;
    carry_held(workspace, input);
    workspace.guides.clear();
    if (input.loads.guides) workspace.guides = *input.loads.guides;
    look_at_guides(workspace, motion.x);
    keep_free_parts(workspace, workspace.v_start);
    // The rows of either mass matrix add up to the lumped mass.
    for (int i = 0; i < system.elements->node_count; ++i)
        point(workspace.external, i) += system.masses.node[i] * input.loads.gravity;
}

// Sets stiffness-proportional damping: the same for all elements, or each element's own in a separate matrix.
void prepare_damping(Workspace& workspace, const SolveSettings& settings) {
    const System& system = *workspace.system;
    workspace.damping_scale = damping_of(system, settings, workspace.element_damping);
    if (!workspace.element_damping.empty()) workspace.damping.set_pattern(system.elements->pattern);
}

// Puts pinned nodes at their targets, to the last bit, with the velocity that took them there, guided ones onto their
// ways, and those that belong to no element to rest.
void finish_pins(Workspace& workspace, const Motion& motion) {
    const int count = int(motion.pinned.size());
    for (int i = next_pinned(motion, 0); i < count; i = next_pinned(motion, i + 1)) {
        point(workspace.x, i) = point(motion.pin_target, i);
        point(workspace.v, i) = point(workspace.v_start, i);
    }
    const std::vector<uint8_t>& loose = workspace.system->loose;
    for (int i = next_marked(loose, 0); i < int(loose.size()); i = next_marked(loose, i + 1))
        point(workspace.v, i).setZero();
    for (const Guide& guide : workspace.guides)
        point(workspace.x, guide.node) = guided(guide, point(workspace.x, guide.node));
    look_at_guides(workspace, workspace.x);
    keep_free_parts(workspace, workspace.v);
}

// Keeps this step as the history of the next one.
void keep_history(Workspace& workspace, const StepInput& input, bool is_valid, Motion& motion) {
    History& history = motion.history;
    const bool was_valid = history.valid;
    history.valid = is_valid;
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

// Takes a step; `keeps` says whether that leaves a history. Stages on a straight line stretch rods that turn far: those
// take a step of implicit Euler, as bdf2's do.
bool take_step(Workspace& w, const StepInput& input, const Integrator& method, SolveReport& report, bool& keeps) {
    const VecX& x = input.motion.x;
    keeps = method.looks_back;
    if (!method.has_stages || !w.system->row->retract) return method.step(w, input, report);
    w.x_from = x + input.h * w.v_start;
    if (is_calm(*w.system, x, w.x_from) && method.step(w, input, report) && is_calm(*w.system, x, w.x)) return true;
    keeps = false;
    return step_euler_ahead(w, input, report);
}

}  // namespace

bool settings_are_sound(const SolveSettings& s) {
    const auto is_damping = [](double value) { return value >= 0 && std::isfinite(value); };
    return s.integrator >= 0 && s.integrator < FROND_INTEGRATOR_COUNT && s.linear_solver >= 0 &&
           s.linear_solver < FROND_LINEAR_SOLVER_COUNT && is_damping(s.mass_damping) &&
           is_damping(s.stiffness_damping) && is_damping(s.full_damping) && s.spectral_radius >= 0 &&
           s.spectral_radius <= 1;
}

bool are_alike(const SolveSettings& a, const SolveSettings& b) {
    const auto all = [](const SolveSettings& s) {
        return std::tie(s.integrator, s.linear_solver, s.newton_iterations, s.max_iterations, s.newton_tolerance,
                        s.tolerance, s.mass_damping, s.stiffness_damping, s.full_damping, s.spectral_radius, s.careful);
    };
    return all(a) == all(b);
}

double damping_of(const System& system, const SolveSettings& settings, std::vector<double>& of_element) {
    const std::vector<double>& ratio = system.elements->damping_ratio;
    of_element.clear();
    if (settings.full_damping == 0 || ratio.empty()) return settings.stiffness_damping;
    if (system.damps_alike) return settings.stiffness_damping + settings.full_damping * ratio.front();
    for (double share : ratio) of_element.push_back(settings.stiffness_damping + settings.full_damping * share);
    return 1;
}

static bool is_as_left(const Motion& motion) {
    const History& history = motion.history;
    return history.x_end.size() == 0 || (are_same(history.x_end, motion.x) && are_same(history.v_end, motion.v));
}

int next_pinned(const Motion& motion, int i) {
    return next_marked(motion.pinned, i);
}

bool history_holds(const Motion& motion, frond_integrator integrator, double h) {
    // Bdf2 is stable while steps grow by less than 1 + sqrt 2 and however they shrink.
    constexpr double LARGEST_GROWTH = 2, LARGEST_FALL = 8;
    const History& history = motion.history;
    return history.valid && history.integrator == integrator && h <= LARGEST_GROWTH * history.h &&
           history.h <= LARGEST_FALL * h && history.pinned == motion.pinned && is_as_left(motion);
}

SolveReport solve_step(Workspace& workspace, const SolveSettings& settings, const Loads& loads, double h,
                       Motion& motion) {
    SolveReport report;
    const StepInput input = {settings, loads, motion, h};
    FROND_ASSERT(workspace.elements->node_count == workspace.system->elements->node_count);
    FROND_ASSERT(workspace.A.pattern == &workspace.system->elements->pattern);
    if (!input_is_sound(*workspace.system, input)) return report;
    if (workspace.system->row->moves_chain) unwind(motion);
    const Integrator& method = integrator(settings.integrator);
    const bool goes_on = method.looks_back && history_holds(motion, settings.integrator, h);
    if (!goes_on && !(are_finite(motion.x) && are_finite(motion.v))) return report;  // after a step they are
    prepare(workspace, input);
    prepare_damping(workspace, settings);
    motion.history.valid = goes_on;
    bool keeps = false;
    if (!take_step(workspace, input, method, report, keeps)) return report;
    finish_pins(workspace, motion);
    if (!are_finite(workspace.x) || !are_finite(workspace.v)) return report;
    keep_history(workspace, input, keeps && !report.is_sudden, motion);
    motion.x = workspace.x;
    motion.v = workspace.v;
    FROND_ASSERT(are_finite(motion.x) && are_finite(motion.v));
    FROND_ASSERT(motion.x.size() == 3 * workspace.system->elements->node_count);
    report.ok = true;
    return report;
}

}  // namespace frond
