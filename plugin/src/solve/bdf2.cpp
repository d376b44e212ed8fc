// BDF2, two steps back: with w = h / h_prev
//   y' = (1+w)^2/(1+2w) y - w^2/(1+2w) y_prev + h (1+w)/(1+2w) dy'/dt  for y = x and y = v
// (Hairer, Norsett, Wanner 1993, "Solving ordinary differential equations I", III.5). One implicit stage a step. The
// first step, each after something else moved the plant, and each that is too wild for its length, is implicit Euler.
#include "solve/integrator.hpp"

namespace frond {

bool step_bdf2(Workspace& workspace, const StepInput& input, SolveReport& report) {
    const Motion& motion = input.motion;
    if (!motion.history.valid) return step_implicit_euler(workspace, input, report);
    Workspace& w = workspace;

    // Forces are taken where the plant is heading: warped stiffness is then off by second order only. Motion that is
    // too wild for the step is not looked back on either, but damped.
    w.x_from = motion.x + input.h * w.v_start;
    if (!is_calm(*w.system, motion.x, w.x_from)) return step_implicit_euler(workspace, input, report);

    // Held nodes move evenly, whatever they did before.
    w.x_prev = motion.history.x_prev;
    w.v_prev = motion.history.v_prev;
    for (size_t i = 0; i < w.held.size(); ++i) {
        if (!w.held[i]) continue;
        point(w.x_prev, int(i)) = point(motion.x, int(i)) - motion.history.h * point(w.v_start, int(i));
        point(w.v_prev, int(i)) = point(w.v_start, int(i));
    }

    const double ratio = input.h / motion.history.h;
    const double back = ratio * ratio / (1 + 2 * ratio), step = input.h * (1 + ratio) / (1 + 2 * ratio);
    w.x_base = motion.x + back * (motion.x - w.x_prev);
    w.v_base = w.v_start + back * (w.v_start - w.v_prev);
    return solve_stage(w, input, {w.x_base, w.v_base, step, w.x_from}, report);
}

}  // namespace frond
