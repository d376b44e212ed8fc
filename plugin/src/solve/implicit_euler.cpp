// Implicit Euler, the paper's equations (2) and (3) with corrected signs:
//   (M + h D + h^2 K) dv = h (f - D v - h K v),  v' = v + dv,  x' = x + h v'
// with f the forces at x. Several Newton iterations solve M dv = h (f(x') - D v') itself.
#include "solve/integrator.hpp"

namespace frond {

bool step_implicit_euler(Workspace& workspace, const StepInput& input, SolveReport& report) {
    carry_held(workspace, input);
    return solve_stage(workspace, input, {input.motion.x, input.motion.v, input.h, input.motion.x}, report);
}

bool takes_forces_ahead(const System& system, const SolveSettings& settings) {
    return !system.row->retract && !settings.is_touched;
}

bool step_euler_ahead(Workspace& workspace, const StepInput& input, SolveReport& report) {
    const Motion& motion = input.motion;
    if (!takes_forces_ahead(*workspace.system, input.settings)) return step_implicit_euler(workspace, input, report);
    carry_held(workspace, input);
    workspace.x_from = motion.x + input.h * motion.v;
    return solve_stage(workspace, input, {motion.x, motion.v, input.h, workspace.x_from}, report);
}

}  // namespace frond
