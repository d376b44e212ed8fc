// Symplectic Euler, explicit: M (v' - v) = h (f - D v), x' = x + h v'. Keeps the energy of slow motion well and needs
// no factor, but is stable only below h = 2 / (highest frequency), which for a plant is some microseconds: it is here
// to show that. Drags, which may be stiffer still, are implicit: M + h D in place of M, D lumped as the mass is.
#include <Eigen/Cholesky>

#include "core/timer.hpp"
#include "solve/drags.hpp"
#include "solve/guides.hpp"
#include "solve/integrator.hpp"

namespace frond {

namespace {

// A consistent mass matrix needs a factor after all; held nodes are left out as in a stage.
bool solve_mass(Workspace& w, const StepInput& input, SolveReport& report) {
    const BlockPattern& pattern = w.system->elements->pattern;
    w.A.set_zero();
    add_drag_damping(input.loads.drags, input.motion.x, input.h, w.A);
    for (int j = 0; j < pattern.node_count; ++j)
        for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; ++k) {
            const int i = pattern.row[size_t(k)];
            const bool held = w.held[size_t(i)] || w.held[size_t(j)];
            auto block = w.A.block(k);
            if (held) block.setZero();
            block.diagonal().array() += !held ? w.system->masses.slot[size_t(k)] : i == j ? 1.0 : 0.0;
        }
    add_inertia(w, 1);
    hold_parts(w);
    const SolveSettings& s = input.settings;
    const LinearResult result =
        solve_linear(s.linear_solver, w.A, w.force, {s.max_iterations, s.tolerance}, w.linear, w.dv);
    report.iterations += result.iterations;
    report.residual = result.residual;
    report.converged = result.converged;
    return result.ok;
}

}  // namespace

// Returns the rotary inertia in the free part of a guided node.
static Mat3 free_inertia(const Mat3& inertia, const Mat3& held) {
    const Mat3 free = Mat3::Identity() - held;
    return free * inertia * free + inertia.trace() * held;
}

void divide_by_mass(const Workspace& w, const VecX& b, VecX& x) {
    x = b;
    keep_free_parts(w, x);
    const auto turns = [&](size_t i) { return !w.inertia.empty() && i % 2 == 1; };
    for (size_t i = 0; i < w.held.size(); ++i) {
        if (w.held[i]) continue;
        const double mass = w.system->masses.node[Eigen::Index(i)];
        const int guide = guide_of(w, int(i));
        if (guide >= 0)
            point(x, int(i)) =
                free_inertia(w.inertia[i / 2], w.held_parts[size_t(guide)]).ldlt().solve(Vec3(point(x, int(i))));
        else if (turns(i))
            point(x, int(i)) = w.inertia[i / 2].ldlt().solve(point(b, int(i)));
        else if (!w.drag.empty())
            point(x, int(i)) = Mat3(w.drag[i] + mass * Mat3::Identity()).llt().solve(point(b, int(i)));
        else
            point(x, int(i)) /= mass;
    }
}

bool step_symplectic_euler(Workspace& workspace, const StepInput& input, SolveReport& report) {
    Workspace& w = workspace;
    force_at_start(w, input, report);
    w.drag.clear();
    if (!input.loads.drags.empty()) lump_drags(input.loads.drags, w.held.size(), input.h, w.drag);
    for (size_t i = 0; i < w.held.size(); ++i)
        if (w.held[i]) point(w.force, int(i)).setZero();
    keep_free_parts(w, w.force);

    Timer timer;
    if (w.system->masses.lumped) {
        divide_by_mass(w, w.force, w.dv);
    } else if (!w.force.allFinite() || !solve_mass(w, input, report)) {
        return false;
    }
    report.ms_solve += timer.lap();
    w.v = w.v_start + input.h * w.dv;
    w.x = input.motion.x + input.h * w.v;
    w.reach = input.h;
    return true;
}

}  // namespace frond
