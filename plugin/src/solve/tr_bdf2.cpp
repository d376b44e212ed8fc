// TR-BDF2 (Bank et al. 1985; Hosea, Shampine 1996, "Analysis and implementation of TR-BDF2"): the trapezoidal rule over
// g h with g = 2 - sqrt 2, then BDF2 from both ends of that to the end of the step; L-stable. Both stages have the same
// length g h / 2, yet each has its own factor: with the first one's in the second it blows up. Motion outside the trust
// bound is stepped by SDIRK2, as are plants that contacts push.
#include <cmath>

#include "solve/integrator.hpp"

namespace frond {

bool step_tr_bdf2(Workspace& workspace, const StepInput& input, SolveReport& report) {
    Workspace& w = workspace;
    const VecX &x = input.motion.x, &v = w.v_base;
    const double g = 2 - std::sqrt(2.0), step = g * input.h / 2;
    w.x_from = x + input.h * w.v_start;
    if (is_pushed(input) || !is_calm(*w.system, x, w.x_from)) return step_sdirk2(w, input, report);

    // Trapezoidal: half of the change comes from the forces at the start.
    pace_held(w, input, 0);
    force_at_start(w, input, report);
    w.impulse = step * w.force;
    w.v_base = w.v_start;
    w.x_base = x + step * v;
    w.x_from = x + 2 * step * v;
    pace_held(w, input, g);
    if (!solve_stage(w, input, {w.x_base, v, step, w.x_from, &w.impulse}, report)) return false;

    // y2 = (y1 - (1-g)^2 y) / (g (2-g)) + (1-g)/(2-g) h dy2/dt.
    const double back = (1 - g) * (1 - g) / (g * (2 - g));
    w.x_base = w.x + back * (w.x - x);
    w.v_base = w.v + back * (w.v - w.v_base);
    w.x_from = w.x + (1 - g) * input.h * w.v;
    lead_held(w, input, step);
    const bool ok = solve_stage(w, input, {w.x_base, w.v_base, step, w.x_from}, report);
    carry_held(w, input);
    return ok && (is_calm(*w.system, x, w.x) || step_sdirk2(w, input, report));
}

}  // namespace frond
