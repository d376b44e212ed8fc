// Generalized-alpha for equations of first order (Jansen, Whiting, Hulbert 2000), which on structures is second-order
// accurate in velocity too and does not overshoot (Kadapa, Dettmer, Peric 2017). With y = (x, v), rates r:
//   r_m = f(y_f),  r_m = r + m (r' - r),  y_f = y + a (y' - y),  y' = y + h (r + g (r' - r)),
//   m = (3 - s) / (2 (1 + s)),  a = 1 / (1 + s),  g = 1/2 + m - a,
// s the spectral radius at infinite frequency. Always solved to convergence: with one solve it blows up. The first step
// is of SDIRK2, and each after something else moved the plant of implicit Euler.
#include <algorithm>
#include <cmath>

#include "solve/integrator.hpp"

namespace frond {

namespace {

constexpr int LEAST_ITERATIONS = 30;

// Takes a first step and sets the rates at its end: the velocity, and the acceleration of SDIRK2's second stage, or of
// the whole step if it was implicit Euler's.
bool start(Workspace& w, const StepInput& input, SolveReport& report) {
    if (!step_sdirk2(w, input, report)) return false;
    w.x_rate = w.v;
    if (is_pushed(input))
        w.v_rate = (w.v - input.motion.v) / input.h;
    else
        w.v_rate = (w.v - w.v_base) / (input.h * (1 - std::sqrt(0.5)));
    keep_held(w);
    return true;
}

}  // namespace

bool step_generalized_alpha(Workspace& workspace, const StepInput& input, SolveReport& report) {
    Workspace& w = workspace;
    const History& history = input.motion.history;
    if (!history.valid) return start(w, input, report);

    const VecX &x = input.motion.x, &v = input.motion.v;
    w.x_rate = history.x_rate;
    w.v_rate = history.v_rate;

    // The stage is at y_f.
    const double s = input.settings.spectral_radius, h = input.h;
    const double m = (3 - s) / (2 * (1 + s)), a = 1 / (1 + s), g = 0.5 + m - a;
    const double step = a * g * h / m, old = a * h * (1 - g / m);
    w.x_base = x + old * w.x_rate;
    w.v_base = v + old * w.v_rate;
    w.x_from = x + a * h * v;
    lead_held(w, input, step, a);
    const int iterations = std::max(LEAST_ITERATIONS, input.settings.newton_iterations);
    if (!solve_stage(w, input, {w.x_base, w.v_base, step, w.x_from, nullptr, iterations}, report)) return false;

    // Extrapolates from the stage to the end of the step.
    w.x_rate += (w.v - w.x_rate) / m;
    w.v_rate += ((w.v - w.v_base) / step - w.v_rate) / m;
    w.x = x + (w.x - x) / a;
    w.v = v + (w.v - v) / a;
    keep_held(w);
    return true;
}

}  // namespace frond
