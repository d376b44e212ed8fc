// In: a plant's motion, what acts on it and a time h. Out: its motion h later, or the same motion and ok = false.
#include <cmath>

#include "solve/integrator.hpp"
#include "solve/springs.hpp"

namespace frond {

namespace {

// Sizes fit and numbers are finite; what is not would only come back as NaN after an expensive step.
bool input_is_sound(const System& system, const StepInput& input) {
    const SolveSettings& s = input.settings;
    const Eigen::Index n = 3 * Eigen::Index(system.elements.node_count);
    const Motion& motion = input.motion;
    if (s.mechanics < 0 || s.mechanics >= FROND_MECHANICS_COUNT || s.integrator < 0 ||
        s.integrator >= FROND_INTEGRATOR_COUNT || s.linear_solver < 0 || s.linear_solver >= FROND_LINEAR_SOLVER_COUNT)
        return false;
    if (!(input.h > 0) || !std::isfinite(input.h) || !(s.mass_damping >= 0) || !std::isfinite(s.mass_damping) ||
        !(s.stiffness_damping >= 0) || !std::isfinite(s.stiffness_damping))
        return false;
    if (motion.x.size() != n || motion.v.size() != n || input.loads.force.size() != n) return false;
    if (!motion.pinned.empty() && (motion.pinned.size() * 3 != size_t(n) || motion.pin_target.size() != n))
        return false;
    return motion.x.allFinite() && motion.v.allFinite() && input.loads.force.allFinite() &&
           input.loads.gravity.allFinite() && springs_are_sound(system, input.loads.springs);
}

// What does not change during a step: which nodes are held, and the forces that do not depend on the motion.
void prepare(Workspace& workspace, const StepInput& input) {
    const System& system = *workspace.system;
    workspace.held = system.loose;
    workspace.external = input.loads.force;
    for (int i = 0; i < system.elements.node_count; ++i) {
        if (!input.motion.pinned.empty() && input.motion.pinned[size_t(i)]) workspace.held[size_t(i)] = 1;
        // The rows of either mass matrix add up to the lumped mass.
        point(workspace.external, i) += system.node_mass[i] * input.loads.gravity;
    }
}

}  // namespace

SolveReport solve_step(Workspace& workspace, const SolveSettings& settings, const Loads& loads, double h,
                       Motion& motion) {
    SolveReport report;
    const StepInput input = {settings, loads, motion, h};
    if (!input_is_sound(*workspace.system, input)) return report;
    prepare(workspace, input);
    if (!integrator(settings.integrator).step(workspace, input, report)) return report;

    // Pinned nodes are where they were told to be, to the last bit.
    for (size_t i = 0; i < motion.pinned.size(); ++i)
        if (motion.pinned[i]) point(workspace.x, int(i)) = point(motion.pin_target, int(i));
    if (!workspace.x.allFinite() || !workspace.v.allFinite()) return report;
    motion.x = workspace.x;
    motion.v = workspace.v;
    report.ok = true;
    return report;
}

}  // namespace frond
