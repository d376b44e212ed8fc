// In: a step just taken, and impulses that it did not include. Out: the change of velocities and positions at its end.
#include "solve/integrator.hpp"

#include "core/assert.hpp"
#include "solve/guides.hpp"

namespace frond {

bool responds_by_mass(const Workspace& workspace, const SolveSettings& settings) {
    return integrator(settings.integrator).is_explicit && workspace.system->masses.lumped;
}

bool respond(Workspace& workspace, const SolveSettings& settings, const VecX& impulse, VecX& dv) {
    Workspace& w = workspace;
    w.rhs = impulse;
    FROND_ASSERT(w.held.size() == size_t(w.system->elements->node_count));
    FROND_ASSERT(impulse.size() == 3 * Eigen::Index(w.held.size()));
    for (size_t i = 0; i < w.held.size(); ++i)
        if (w.held[i]) point(w.rhs, int(i)).setZero();
    keep_free_parts(w, w.rhs);
    if (responds_by_mass(w, settings)) {
        divide_by_mass(w, w.rhs, dv);
        return dv.allFinite();
    }
    if (!make_factor(w.A, w.linear)) return false;
    solve(w.linear.block, w.rhs, dv);
    return dv.allFinite();
}

bool go_on_changing(Workspace& workspace, const SolveSettings& settings, const VecX& before, VecX& change) {
    multiply_mass(*workspace.system, workspace.inertia, before, workspace.momentum);
    return respond(workspace, settings, workspace.momentum, change);
}

void add_response(const Workspace& workspace, const VecX& dv, Motion& motion) {
    motion.v += dv;
    add_correction(workspace, dv, motion);
}

void add_correction(const Workspace& workspace, const VecX& dv, Motion& motion) {
    FROND_ASSERT(dv.size() == motion.x.size());
    motion.x += workspace.reach * dv;
    motion.history.shaken = true;
}

void retract_step(Workspace& workspace, Motion& motion) {
    Workspace& w = workspace;
    if (w.retract_from.size() == 0) return;
    for (const Guide& guide : w.guides) point(motion.x, guide.node) = guided(guide, point(motion.x, guide.node));
    w.system->row->retract(*w.elements, w.retract_from, motion.x, w.held, w.retracted);
    // Of pairs of nodes only the positions change; velocities keep what the responses gave them, for contacts bound
    // those.
    for (int i = 0; i < motion.x.size() / 3; i += 2) point(motion.x, i) = point(w.retracted, i);
    w.retract_from.resize(0);
}

}  // namespace frond
