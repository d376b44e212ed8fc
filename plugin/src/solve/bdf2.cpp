// BDF2, two steps back: with w = h / h_prev
//   y' = (1+w)^2/(1+2w) y - w^2/(1+2w) y_prev + h (1+w)/(1+2w) dy'/dt  for y = x and y = v
// (Hairer, Norsett, Wanner 1993, "Solving ordinary differential equations I", III.5). One implicit stage a step. The
// first step, and one after something else moved the plant, is of sdirk2. Where such steps follow each other, as under
// contacts, and where motion is outside the trust bound or too sudden for the step, it is implicit Euler, which damps.
#include "solve/integrator.hpp"

namespace frond {

// Returns whether displacement and velocities agree: after a sudden load on stiff parts sdirk2 ends at the right
// positions, but with wrong velocities.
static bool is_smooth(const Workspace& w, const StepInput& input) {
    const VecX way = w.x - input.motion.x;
    return (way - 0.5 * input.h * (input.motion.v + w.v)).squaredNorm() <=
           ROUGH_START * ROUGH_START * way.squaredNorm();
}

// Takes a first step by sdirk2 where possible: implicit Euler would take 1 % of the energy from a 1 Hz mode at 1/60 s,
// and far more from higher modes.
static bool step_first(Workspace& w, const StepInput& input, SolveReport& report) {
    const Motion& motion = input.motion;
    w.x_from = motion.x + input.h * w.v_start;
    if (!motion.history.shaken && is_calm(*w.system, motion.x, w.x_from) && step_sdirk2(w, input, report) &&
        is_calm(*w.system, motion.x, w.x) && is_smooth(w, input) && report.inverted == 0)
        return true;
    report.is_sudden = !motion.history.shaken;
    return step_euler_ahead(w, input, report);
}

Bdf2 bdf2_after(double h_before, double h) {
    const double ratio = h / h_before;
    return {ratio * ratio / (1 + 2 * ratio), h * (1 + ratio) / (1 + 2 * ratio)};
}

bool step_bdf2(Workspace& workspace, const StepInput& input, SolveReport& report) {
    const Motion& motion = input.motion;
    if (!motion.history.valid) return step_first(workspace, input, report);
    Workspace& w = workspace;

    // Forces are evaluated at the predicted positions, so the warped stiffness is off at second order only. Motion
    // outside the trust bound does not use the history either, but is damped.
    w.x_from = motion.x + input.h * w.v_start;
    if (!is_calm(*w.system, motion.x, w.x_from)) return step_euler_ahead(w, input, report);

    const auto [back, step] = bdf2_after(motion.history.h, input.h);
    w.x_base = motion.x + back * (motion.x - motion.history.x_prev);
    w.v_base = motion.v + back * (motion.v - motion.history.v_prev);
    // Held nodes get the velocity that the method finds in their positions, as free ones do: otherwise a foot that
    // stops would tear at a plant that goes on.
    lead_held(w, input, step);
    predict_held(w, motion.x, input.h, motion.v);
    const StageBase base = {motion.x.data(), motion.history.x_prev.data(), back};
    return solve_stage(w, input, {w.x_base, w.v_base, step, w.x_from, nullptr, 0, nullptr, base}, report);
}

}  // namespace frond
