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
//
// D = mass_damping M + stiffness_damping K plus each element's own damping times its part of K, K being the positive
// stiffness at the start of the step: it never adds energy and does not resist rotation as a whole.
#include <algorithm>
#include <cmath>

#include "core/timer.hpp"
#include "solve/drags.hpp"
#include "solve/integrator.hpp"
#include "solve/springs.hpp"

namespace frond {

namespace {

struct Newton {
    Workspace& w;
    const StepInput& input;
    const Stage& stage;
    SolveReport& report;
    const System& system;
    const Mechanics& body;
    double rayleigh = 0;        // workspace.damping_scale [s]
    int iterations = 1;         // most Newton iterations
    bool apart = false;         // elements differ in damping ratio: the damping is not a multiple of the stiffness
    bool keep_damping = false;  // the damping matrix is needed besides the stiffness
    bool is_long = false;       // the step is longer than the period of hanging parts, and has one solve
    bool is_pulled = false;     // springs pull at rods from afar, and the step has one solve
    bool exact = false;         // the first solve uses the exact stiffness, the damping still the positive one
    bool skipped = false;       // the first solve was left to the line search
    bool at_once = false;       // the mechanics assemble right-hand side and matrix of the only solve in one pass
    int most_work = 0;          // limit of report.work; 0: none
};

// Approximate cost of a factor, in evaluations of the forces.
constexpr int WORK_OF_FACTOR = 4;
bool is_spent(const Newton& n) {
    return n.most_work > 0 && n.report.work >= n.most_work;
}

// Sets w.x to the end of the stage with velocities v.
void move(const Newton& n, const VecX& v) {
    n.w.x = n.stage.x_base + n.stage.step * v;
}

// Keeps the strain that the solve linearized at `from` gave to what rotates, by velocities that lead there; or leaves
// that to retract_step().
void retract(const Newton& n, const VecX& from, VecX& v) {
    if (!n.body.retract) return;
    if (!n.input.settings.retracts) {
        if (n.iterations == 1) n.w.retract_from = from;
        return;
    }
    move(n, v);
    n.body.retract(*n.w.elements, from, n.w.x, n.w.held, n.w.retracted);
    v += (1 / n.stage.step) * (n.w.retracted - n.w.x);
}

// Computes the residual without the terms of K: step * f + impulse - M (v - v_base) - step * a M v.
void start_residual(const Newton& n, const VecX& v, VecX& rhs) {
    const double step = n.stage.step;
    rhs = n.w.external + n.w.elastic;
    add_spring_force(n.input.loads.springs, n.w.x, rhs);
    add_drag_force(n.input.loads.drags, n.w.x, v, rhs);
    rhs *= step;
    if (n.stage.impulse) rhs += *n.stage.impulse;
    n.w.dv = n.stage.v_base - (1 + step * n.input.settings.mass_damping) * v;
    multiply_mass(n.system, n.w.inertia, n.w.dv, n.w.momentum);
    rhs += n.w.momentum;
}

// Returns the norm over nodes that are not held.
double free_norm(const Newton& n, const VecX& rhs) {
    double sum = 0;
    for (int i = 0; i < n.system.elements->node_count; ++i)
        if (!n.w.held[size_t(i)]) sum += point(rhs, i).squaredNorm();
    return std::sqrt(sum);
}

// Returns the predicted positions if they are within the trust bound, else the start of the step.
const VecX& linearized_from(const Newton& n) {
    const VecX& start = n.input.motion.x;
    return &n.stage.x_from == &start || is_calm(n.system, start, n.stage.x_from) ? n.stage.x_from : start;
}

// Computes force and stiffness at x_from, extrapolated to the end of the stage with the velocities known so far.
void linearize_at_start(Newton& n) {
    Workspace& w = n.w;
    const auto assemble = [&](const VecX& x) {
        w.elastic.setZero(x.size());
        w.A.set_zero();
        if (n.apart) w.damping.set_zero();
        n.report.inverted =
            n.apart
                ? n.body.add_force_stiffness_and_damping(*n.w.elements, x, w.element_damping, w.elastic, w.A, w.damping)
                : n.body.add_force_and_stiffness(*n.w.elements, x, Tangent::positive, w.elastic, w.A);
        move(n, w.v);
        w.dv = w.x - x;
    };
    const VecX& from = linearized_from(n);
    if (n.at_once) {
        w.elastic.setZero(from.size());
        w.A.set_zero();
        move(n, w.v);
        w.dv = w.x - from;
        n.report.inverted = n.body.add_ahead(
            *w.elements, from, {w.dv.data(), w.v.data(), n.stage.step, n.apart ? 0 : n.rayleigh, w.element_damping},
            w.elastic, w.A);
        return start_residual(n, w.v, w.rhs);
    }
    assemble(from);
    const bool is_multiple = !n.apart && !n.exact;  // the damping is a multiple of this stiffness
    if (!n.apart && (n.exact || n.keep_damping)) w.damping = w.A;
    if (n.exact) {
        w.A.set_zero();
        n.body.add_stiffness(*n.w.elements, from, Tangent::exact, 1, w.A);
    }
    if (is_multiple) w.dv += n.rayleigh * w.v;
    w.A.multiply(w.dv, w.product);
    start_residual(n, w.v, w.rhs);
    w.rhs -= n.stage.step * w.product;
    if (is_multiple) return;
    w.damping.multiply(w.v, w.product);
    w.rhs -= n.stage.step * n.rayleigh * w.product;
}

// Computes the residual at the end of the stage with velocities v and returns its norm; leaves elastic force and
// positions in the workspace.
double residual_at(Newton& n, const VecX& v, VecX& rhs) {
    Workspace& w = n.w;
    n.report.work++;
    move(n, v);
    w.elastic.setZero(v.size());
    n.report.inverted = n.body.add_force(*n.w.elements, w.x, w.elastic);
    start_residual(n, v, rhs);
    if (n.keep_damping) {
        w.damping.multiply(v, w.product);
        rhs -= n.stage.step * n.rayleigh * w.product;
    }
    return free_norm(n, rhs);
}

// Returns the stage's potential, which is least at the solution: minus its gradient by v is the residual.
double potential_at(const Newton& n, const VecX& v) {
    Workspace& w = n.w;
    const double step = n.stage.step, a = n.input.settings.mass_damping;
    n.report.work++;
    move(n, v);
    double potential =
        n.body.energy(*n.w.elements, w.x) + spring_energy(n.input.loads.springs, w.x) - step * w.external.dot(v);
    w.dv = v - n.stage.v_base;
    multiply_mass(n.system, w.inertia, w.dv, w.momentum);
    potential += 0.5 * w.dv.dot(w.momentum);
    multiply_mass(n.system, w.inertia, v, w.momentum);
    potential += 0.5 * step * a * v.dot(w.momentum);
    potential += step * drag_potential(n.input.loads.drags, w.x, v);
    if (n.stage.impulse) potential -= n.stage.impulse->dot(v);
    if (n.keep_damping) {
        w.damping.multiply(v, w.product);
        potential += 0.5 * step * n.rayleigh * v.dot(w.product);
    }
    return potential;
}

void add_mass(const Masses& masses, double scale, BlockMatrix& A) {
    const auto add = [&](int slot) { A.block(slot).diagonal().array() += scale * masses.slot[size_t(slot)]; };
    const BlockPattern& pattern = *A.pattern;
    if (masses.lumped)
        for (int i = 0; i < pattern.node_count; ++i) add(pattern.start[size_t(i)]);
    else
        for (int k = 0; k < pattern.block_count(); ++k) add(k);
}

// Forms A = (1 + step a) M + step^2 K + step b K_damping + springs + drags. `first`: K is the one at the start of the
// step, of which the damping is a multiple unless elements differ in damping ratio.
void form_matrix(Newton& n, bool first, Tangent tangent) {
    BlockMatrix& A = n.w.A;
    const double step = n.stage.step, mass = 1 + step * n.input.settings.mass_damping;
    const bool alike = first && !n.apart && !n.exact;
    const double scale = step * step + (alike ? step * n.rayleigh : 0);
    if (!n.at_once)
        for (double& value : A.values) value *= scale;
    if (!n.at_once && !alike && n.keep_damping)
        for (size_t k = 0; k < A.values.size(); ++k) A.values[k] += step * n.rayleigh * n.w.damping.values[k];
    add_mass(n.system.masses, mass, A);
    add_inertia(n.w, mass);
    add_spring_stiffness(n.input.loads.springs, n.w.x, tangent, step * step, A);
    add_drag_damping(n.input.loads.drags, n.w.x, step, A);
}

// Makes rows and columns of held nodes, whose velocities are known, the identity, so that the pattern stays.
void hold(Newton& n) {
    Workspace& w = n.w;
    const BlockPattern& pattern = *w.A.pattern;
    for (int j = 0; j < pattern.node_count; ++j)
        for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; ++k) {
            const int i = pattern.row[size_t(k)];
            if (!w.held[size_t(i)] && !w.held[size_t(j)]) continue;
            auto block = w.A.block(k);
            block.setZero();
            if (i == j) block.setIdentity();
        }
    for (int i = 0; i < pattern.node_count; ++i)
        if (w.held[size_t(i)]) point(w.rhs, i).setZero();
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
        move(n, n.w.v);
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

// Goes along dv as far as the residual decreases while the potential stays below `most`, or the potential decreases
// enough (Armijo 1966; Nocedal and Wright 2006, section 3.1). Returns false if neither does.
bool search_line(Newton& n, double most, VecX& rhs, double& norm) {
    constexpr int HALVINGS = 12;       // of a direction; a step of a 4000th is none
    constexpr double DESCENT = 1e-4;   // share of the linear decrease that is enough [-]
    constexpr double ROUNDING = 1e-6;  // relative change of a potential that is none [-]
    Workspace& w = n.w;
    VecX& direction = w.direction;
    direction = w.dv;
    const double slope = -direction.dot(rhs), start = potential_at(n, w.v);
    const double bound = std::max(most, start + ROUNDING * std::abs(start));
    double part = 1;
    for (int trial = 0; trial <= HALVINGS; ++trial, part *= 0.5) {
        w.v_trial = w.v + part * direction;
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
// with and was given.
void stand_still_if_better(Newton& n) {
    Workspace& w = n.w;
    const double moving = potential_at(n, w.v);
    w.v_trial = w.v;
    for (int i = 0; i < n.system.elements->node_count; ++i)
        if (!w.held[size_t(i)]) point(w.v_trial, i).setZero();
    if (!(moving <= potential_at(n, w.v_trial))) std::swap(w.v, w.v_trial);
}

// Leaves the first solve to the line search. Returns the norm of the residual, negative on failure.
double skip_first(Newton& n) {
    constexpr int SEARCHED_ITERATIONS = 20;  // solves granted to a stage that is searched
    Timer timer;
    if (n.iterations < SEARCHED_ITERATIONS) {
        n.iterations = SEARCHED_ITERATIONS;
        const int most = n.input.settings.most_work;
        n.most_work = most > 0 ? n.report.work + most : 0;
    }
    n.skipped = true;
    if (n.input.settings.from_rest || n.is_pulled) stand_still_if_better(n);
    const double norm = residual_at(n, n.w.v, n.w.rhs_stage);
    n.report.ms_assembly += timer.lap();
    return std::isfinite(norm) ? norm : -1;
}

bool ends_calmly(Newton& n, double part) {
    n.w.v_trial = n.w.v + part * n.w.dv;
    move(n, n.w.v_trial);
    return is_calm(n.system, n.input.motion.x, n.w.x);
}

// Does the first solve, the only one with one iteration. Returns the norm of its right-hand side, negative on failure.
double solve_first(Newton& n) {
    Timer timer;
    linearize_at_start(n);
    if (n.input.settings.careful || (n.body.needs_search && n.report.inverted > 0)) {
        n.report.ms_assembly += timer.lap();
        return skip_first(n);
    }
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
    retract(n, linearized_from(n), n.w.v);
    return norm;
}

// Change of the positions that counts as none, as a share of the plant's size: the next one would be smaller still.
constexpr double TINY = 1e-11;
// A change of more than the plant's size: if not even a small part of it makes anything better, the search has failed,
// as it does for a plant stretched to many times its length.
constexpr double FAR = 1;

// Does further solves until the residual is small against the first one, or changes reach the resolution of double.
bool iterate(Newton& n, double first) {
    const SolveSettings& s = n.input.settings;
    Workspace& w = n.w;
    double change = n.skipped ? INFINITY : w.dv.cwiseAbs().maxCoeff() * n.stage.step;
    Timer timer;
    VecX& rhs = w.rhs_stage;
    double norm = residual_at(n, w.v, rhs);
    n.report.ms_assembly += timer.lap();
    const double most = s.careful || n.is_pulled ? potential_at(n, w.v) : INFINITY;
    Tangent tangent = Tangent::exact;
    bool has_moved = !n.skipped;
    for (int iteration = 1;; ++iteration) {
        n.report.converged = norm <= s.newton_tolerance * first || change <= TINY * n.system.size;
        if (n.report.converged || iteration == n.iterations || is_spent(n)) return std::isfinite(norm);
        if (!find_direction(n, tangent, rhs)) return false;
        timer.lap();
        change = w.dv.cwiseAbs().maxCoeff() * n.stage.step;
        const bool better = search_line(n, most, rhs, norm);
        n.report.ms_assembly += timer.lap();
        // The exact stiffness may give a direction that does not descend; the positive one's does.
        if (!better && tangent == Tangent::positive) {
            n.report.converged = change <= TINY * n.system.size;
            return has_moved || change <= FAR * n.system.size;
        }
        has_moved |= better;
        tangent = better ? Tangent::exact : Tangent::positive;
    }
}

}  // namespace

void add_inertia(Workspace& w, double scale) {
    for (size_t i = 0; i < w.inertia.size(); ++i)
        if (!w.held[2 * i + 1]) w.A.block(w.A.pattern->start[2 * i + 1]) += scale * w.inertia[i];
}

bool is_long_stage(const System& system, double step) {
    return system.row->moves_chain && step > LONG_STAGE;
}

bool solve_stage(Workspace& workspace, const StepInput& input, const Stage& stage, SolveReport& report) {
    const System& system = *workspace.system;
    const SolveSettings& settings = input.settings;
    Newton n = {workspace, input, stage, report, system, *system.row};
    n.rayleigh = workspace.damping_scale;
    n.iterations = stage.iterations > 0 ? stage.iterations : settings.newton_iterations;
    n.apart = !workspace.element_damping.empty();
    n.is_pulled = system.row->moves_chain && input.loads.springs_are_far && n.iterations == 1;
    n.is_long = is_long_stage(system, stage.step) && n.iterations == 1;
    n.exact = n.is_long || n.is_pulled;
    n.keep_damping =
        n.apart || (n.rayleigh > 0 && (n.iterations > 1 || n.exact || n.body.needs_search || settings.careful));
    n.at_once = n.body.add_ahead && n.iterations == 1 && !n.exact && !settings.careful;
    if (settings.careful && settings.most_work > 0) n.most_work = report.work + settings.most_work;
    workspace.v = workspace.v_start;
    workspace.reach = stage.step;
    workspace.retract_from.resize(0);
    const bool converged_before = report.converged;
    const double first = solve_first(n);
    if (first < 0) return false;
    if (n.iterations > 1 && !iterate(n, first)) return false;
    report.converged &= converged_before;
    move(n, workspace.v);
    return true;
}

}  // namespace frond
