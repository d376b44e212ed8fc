// SDIRK2 (Alexander 1977, "Diagonally implicit Runge-Kutta methods for stiff ODEs"): two implicit stages with
// g = 1 - 1/sqrt 2, the second one at the end of the step; stable at any step (L-stable). Each stage has its own
// factor. Plants that contacts push are stepped by implicit Euler.
#include <cmath>

#include "solve/integrator.hpp"

namespace frond {

bool step_sdirk2(Workspace& workspace, const StepInput& input, SolveReport& report) {
    if (is_pushed(input)) return step_euler_ahead(workspace, input, report);
    Workspace& w = workspace;
    const VecX &x = input.motion.x, &v = w.v_base;
    const double g = 1 - std::sqrt(0.5), step = g * input.h;
    pace_held(w, input, 0);
    w.v_base = w.v_start;
    w.x_from = x + step * v;
    pace_held(w, input, g);
    if (!solve_stage(w, input, {x, v, step, w.x_from}, report)) return false;

    // y2 = y + (1-g) h dy1/dt + g h dy2/dt, and dy1/dt = (y1 - y) / (g h).
    w.x_base = x + ((1 - g) / g) * (w.x - x);
    w.v_base += ((1 - g) / g) * (w.v - w.v_base);
    w.x_from = w.x + (input.h - step) * w.v;
    lead_held(w, input, step);
    const bool ok = solve_stage(w, input, {w.x_base, w.v_base, step, w.x_from}, report);
    carry_held(w, input);
    return ok;
}

}  // namespace frond
