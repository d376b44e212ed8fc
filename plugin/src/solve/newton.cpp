// In: an implicit stage. Out: its velocities, by Newton's method.
//
// The first solve takes forces and stiffness at the start of the step and extrapolates them (Baraff, Witkin 1998);
// alone it is the paper's step. Its stiffness is the positive one, whose directions always descend. Further solves use
// the exact stiffness, which converges quadratically, and fall back to the positive one if that has no factor. A line
// search keeps them from making the residual and the stage's potential both larger.
//
// Without the stiffness that tension adds, hanging parts of rods swing ever farther in steps longer than their period.
// The one solve of such a step takes the exact stiffness, and is shortened to the trust bound; if that has no factor
// and the positive one leads beyond the bound, a line search takes over.
// What springs pull taut from afar swings as fast in any step: it takes the exact stiffness too, and a line search
// takes over wherever the solve leads beyond the bound.
// Where the one solve misses the energy of taut fibres, which turned far or became taut or slack, the stage is
// solved on until one meets it, and is solved roughly.
#include <algorithm>
#include <cmath>

#include "core/timer.hpp"
#include "solve/springs.hpp"
#include "solve/stage_equations.hpp"

namespace frond {

namespace {

struct Newton : StageEquations {
    int iterations = 1;        // most Newton iterations
    bool is_long = false;      // the step is longer than the period of hanging parts, and has one solve
    bool is_pulled = false;    // springs pull at rods from afar, and the step has one solve
    bool for_fibres = false;   // the one solve missed their energy, and others follow
    bool skipped = false;      // the first solve was left to the line search
    bool damps_later = false;  // the search began at rest, without damping
    int most_work = 0;         // limit of report.work; 0: none
};

// Returns whether the last solve, of a system formed with those velocities, took the energy of fibres for what it is.
bool meets_fibres(Newton& n, const VecX& v_before) {
    set_positions(n, v_before);
    const VecX from = n.w.x;
    set_positions(n, n.w.v);
    const FibreLoads& fibres = *n.input.loads.fibres;
    return miss_of_fibres(fibres.list, from, n.w.x) <= fibres.tolerance;
}

// Approximate cost of a factor, in evaluations of the forces.
constexpr int WORK_OF_FACTOR = 4;
bool is_spent(const Newton& n) {
    return n.most_work > 0 && n.report.work >= n.most_work;
}

// Keeps the strain that a solve linearized at `from` gave to what rotates, by velocities that lead there.
void retract(const Newton& n, const VecX& from, VecX& v) {
    follow_guides(n, v);
    if (!n.body.retract) return;
    set_positions(n, v);
    n.body.retract(*n.w.elements, from, n.w.x, n.w.held, n.w.retracted);
    v += (1 / n.stage.step) * (n.w.retracted - n.w.x);
}

// Does so for the first solve, or leaves that to retract_step().
void retract_first(const Newton& n, const VecX& from, VecX& v) {
    if (!n.input.settings.is_touched) return retract(n, from, v);
    follow_guides(n, v);
    if (n.body.retract && n.iterations == 1) n.w.retract_from = from;
}

// Solves for dv with the matrix in A and the right-hand side.
bool solve_linear(Newton& n) {
    const SolveSettings& s = n.input.settings;
    const LinearResult result =
        solve_linear(s.linear_solver, n.w.A, n.w.rhs, {s.max_iterations, s.tolerance}, n.w.linear, n.w.dv);
    n.report.iterations += result.iterations;
    n.report.residual = result.residual;
    n.report.converged = result.converged;
    return result.ok;
}

// Finds a direction by the stiffness at the current velocities: exact, or positive if the exact one has no factor.
bool find_direction(Newton& n, Tangent& tangent, const VecX& rhs) {
    for (;;) {
        Timer timer;
        n.report.work += WORK_OF_FACTOR;
        n.w.rhs = rhs;
        n.w.A.set_zero();
        set_positions(n, n.w.v);
        n.body.add_stiffness(*n.w.elements, n.w.x, tangent, 1, n.w.A);
        form_matrix(n, false, tangent);
        hold(n);
        n.report.ms_assembly += timer.lap();
        const bool ok = solve_linear(n);
        n.report.ms_solve += timer.lap();
        if (ok) return true;
        if (tangent == Tangent::positive) return false;
        tangent = Tangent::positive;
    }
}

// Goes along dv, rods on a curve that gives them its strain, as far as the residual decreases while the potential stays
// below `most`, or the potential decreases enough (Armijo 1966; Nocedal and Wright 2006, section 3.1). Returns false if
// neither does.
bool search_line(Newton& n, double most, VecX& rhs, double& norm) {
    constexpr int HALVINGS = 12;       // of a direction; a step of a 4000th is none
    constexpr double DESCENT = 1e-4;   // share of the linear decrease that is enough [-]
    constexpr double ROUNDING = 1e-6;  // relative change of a potential that is none [-]
    Workspace& w = n.w;
    VecX& direction = w.direction;
    direction = w.dv;
    const double slope = -direction.dot(rhs), start = potential_at(n, w.v);
    w.search_from = w.x;
    const double bound = std::max(most, start + ROUNDING * std::abs(start));
    double part = 1;
    for (int trial = 0; trial <= HALVINGS; ++trial, part *= 0.5) {
        w.v_trial = w.v + part * direction;
        retract(n, w.search_from, w.v_trial);
        const double potential = potential_at(n, w.v_trial);
        if (!(potential <= bound)) continue;
        const double norm_trial = residual_at(n, w.v_trial, w.rhs_trial);
        if (!(norm_trial < (1 - DESCENT * part) * norm) && !(potential <= start + DESCENT * part * slope)) continue;
        std::swap(w.v, w.v_trial);
        std::swap(rhs, w.rhs_trial);
        norm = norm_trial;
        w.dv = part * direction;
        return true;
    }
    return false;
}

// Starts the search at rest if the potential is less there. If straight motion would wind segments up, a search from
// its end reaches another minimum than the plant's, or none; from rest it ends with no more energy than the step began
// with and was given. Returns whether it does.
bool stand_still_if_better(Newton& n) {
    Workspace& w = n.w;
    const double moving = potential_at(n, w.v);
    w.v_trial = w.v;
    for (int i = 0; i < n.system.elements->node_count; ++i)
        if (!w.held[size_t(i)]) point(w.v_trial, i).setZero();
    follow_guides(n, w.v_trial);
    if (moving <= potential_at(n, w.v_trial)) return false;
    std::swap(w.v, w.v_trial);
    return true;
}

// Leaves the first solve to the line search. Returns the norm of the residual, negative on failure.
double skip_first(Newton& n) {
    constexpr int SEARCHED_ITERATIONS = 20;  // solves granted to a stage that is searched
    const SolveSettings& settings = n.input.settings;
    Timer timer;
    if (n.iterations < SEARCHED_ITERATIONS) {
        n.iterations = SEARCHED_ITERATIONS;
        const int most = settings.most_work;
        n.most_work = most > 0 ? n.report.work + most : 0;
    }
    n.skipped = true;
    retract_first(n, n.input.motion.x, n.w.v);
    form_damping(n);
    const bool stands = (settings.from_rest || n.is_pulled) && stand_still_if_better(n);
    // What has no lengths that could be kept as it turns is damped later; what contacts push must not pass them.
    n.damps_later = stands && n.keep_damping && !n.body.retract && !settings.is_touched;
    n.keep_damping &= !n.damps_later;
    const double norm = residual_at(n, n.w.v, n.w.rhs_stage);
    n.report.ms_assembly += timer.lap();
    return std::isfinite(norm) ? norm : -1;
}

bool ends_calmly(Newton& n, double part) {
    n.w.v_trial = n.w.v + part * n.w.dv;
    set_positions(n, n.w.v_trial);
    return is_calm(n.system, n.input.motion.x, n.w.x);
}

// Does the first solve, the only one with one iteration. Returns the norm of its right-hand side, negative on failure.
double solve_first(Newton& n) {
    Timer timer;
    if (n.input.settings.careful) return skip_first(n);
    linearize_at_start(n);
    n.report.ms_assembly += timer.lap();
    if (n.body.needs_search && n.report.inverted > 0) return skip_first(n);
    form_matrix(n, true, n.exact ? Tangent::exact : Tangent::positive);
    hold(n);
    const double norm = free_norm(n, n.w.rhs);
    n.report.ms_assembly += timer.lap();
    const bool ok = std::isfinite(norm) && solve_linear(n);
    n.report.ms_solve += timer.lap();
    if (!ok && n.exact) {
        n.exact = false;
        return solve_first(n);
    }
    if (!ok) return -1;
    constexpr double LEAST = 1.0 / 64;  // smallest share to which a solve is shortened for the trust bound [-]
    double part = 1;
    if ((n.is_pulled || (n.is_long && !n.exact)) && !ends_calmly(n, 1)) return skip_first(n);
    while (n.exact && part > LEAST && !ends_calmly(n, part)) part *= 0.5;
    n.w.v += part * n.w.dv;
    retract_first(n, linearized_from(n), n.w.v);
    return norm;
}

// Change of the positions that counts as none, as a share of the plant's size: the next one would be smaller still.
constexpr double TINY = 1e-11;
// A change of more than the plant's size: if not even a small part of it makes anything better, the search has failed,
// as it does for a plant stretched to many times its length.
constexpr double FAR = 1;

// Begins to damp a search that began at rest, amid the way that it found. Damping is a wall between rest and what has
// turned, beyond which the search would not come. Returns the norm of the residual.
double damp(Newton& n, VecX& rhs) {
    n.damps_later = false;
    form_damping(n);
    stand_still_if_better(n);
    return residual_at(n, n.w.v, rhs);
}

// Does further solves until the residual is small against the first one, or changes reach the resolution of double.
bool iterate(Newton& n, double first) {
    constexpr double ROUGHLY = 0.01;        // residual over the first that is small where fibres are met [-]
    constexpr double BEFORE_DAMPING = 0.1;  // likewise, where damping begins [-]
    const SolveSettings& s = n.input.settings;
    Workspace& w = n.w;
    double change = n.skipped ? INFINITY : w.dv.cwiseAbs().maxCoeff() * n.stage.step;
    Timer timer;
    VecX& rhs = w.rhs_stage;
    double norm = residual_at(n, w.v, rhs);
    n.report.ms_assembly += timer.lap();
    const double most = s.careful || n.is_pulled ? potential_at(n, w.v) : INFINITY;
    Tangent tangent = Tangent::exact;
    VecX v_before;
    bool has_moved = !n.skipped;
    double enough = s.newton_tolerance * first;
    for (int iteration = 1;; ++iteration) {
        if (n.damps_later && (norm <= BEFORE_DAMPING * first || change <= TINY * n.system.size)) norm = damp(n, rhs);
        n.report.converged = norm <= enough || change <= TINY * n.system.size;
        if (n.report.converged || iteration == n.iterations || is_spent(n)) return std::isfinite(norm);
        if (!find_direction(n, tangent, rhs)) return false;
        timer.lap();
        change = w.dv.cwiseAbs().maxCoeff() * n.stage.step;
        if (n.for_fibres) v_before = w.v;
        const bool better = search_line(n, most, rhs, norm);
        if (n.for_fibres && better && meets_fibres(n, v_before)) enough = std::max(enough, ROUGHLY * first);
        n.report.ms_assembly += timer.lap();
        // The exact stiffness may give a direction that does not descend; the positive one's does.
        if (!better && tangent == Tangent::positive && n.damps_later) {
            norm = damp(n, rhs);
        } else if (!better && tangent == Tangent::positive) {
            n.report.converged = change <= TINY * n.system.size;
            return has_moved || change <= FAR * n.system.size;
        }
        has_moved |= better;
        tangent = better ? Tangent::exact : Tangent::positive;
    }
}

}  // namespace

bool is_long_stage(const System& system, double step) {
    return system.row->moves_chain && step > LONG_STAGE;
}

bool solve_stage(Workspace& workspace, const StepInput& input, const Stage& stage, SolveReport& report) {
    const System& system = *workspace.system;
    const SolveSettings& settings = input.settings;
    Newton n = {{workspace, input, stage, report, system, *system.row}};
    n.rayleigh = workspace.damping_scale;
    n.iterations = stage.iterations > 0 ? stage.iterations : settings.newton_iterations;
    n.apart = !workspace.element_damping.empty();
    n.is_pulled = system.row->moves_chain && input.loads.springs_are_far && n.iterations == 1;
    n.is_long = is_long_stage(system, stage.step) && n.iterations == 1;
    n.exact = n.is_long || n.is_pulled;
    n.at_once = n.body.add_ahead && !n.exact && !settings.careful;
    if (settings.careful && settings.most_work > 0) n.most_work = report.work + settings.most_work;
    workspace.v = workspace.v_start;
    follow_guides(n, workspace.v);
    workspace.reach = stage.step;
    workspace.retract_from.resize(0);
    if (n.exact) form_damping(n);
    const bool converged_before = report.converged;
    const double first = solve_first(n);
    if (first < 0) return false;
    if (n.iterations == 1 && input.loads.fibres && !meets_fibres(n, workspace.v_start)) {
        n.for_fibres = true;
        n.iterations = ENOUGH_SOLVES;
    }
    if (n.iterations > 1) {
        if (!n.skipped) form_damping(n);
        if (!iterate(n, first)) return false;
    }
    report.converged &= converged_before;
    set_positions(n, workspace.v);
    return true;
}

}  // namespace frond
