// Implicit Euler, the paper's equations (2) and (3) with corrected signs:
//   (M + h D + h^2 K) dv = h (f - D v - h K v),  v' = v + dv,  x' = x + h v'
// with f the forces at x. Several Newton iterations solve M dv = h (f(x') - D v') itself.
#include "core/assert.hpp"
#include "mechanics/rotation.hpp"
#include "solve/integrator.hpp"

namespace frond {

// Moves a body on for h [s] as its momentum and its moment of momentum would if it were rigid.
static void go_on_rigidly(const System& system, const Motion& motion, double h, VecX& x) {
    const VecX& mass = node_mass_of(system);
    const double whole = mass.sum();
    FROND_ASSERT(whole > 0);
    Vec3 centre = Vec3::Zero(), velocity = Vec3::Zero(), moment = Vec3::Zero();
    for (int i = 0; i < mass.size(); ++i) {
        centre += mass[i] / whole * point(motion.x, i);
        velocity += mass[i] / whole * point(motion.v, i);
    }
    Mat3 inertia = Mat3::Zero();
    for (int i = 0; i < mass.size(); ++i) {
        const Vec3 arm = point(motion.x, i) - centre;
        moment += mass[i] * arm.cross(Vec3(point(motion.v, i)));
        inertia += mass[i] * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
    }
    const Mat3 turn = rotation_of<double>(Vec3(h * (inertia.inverse() * moment)));
    x.resize(motion.x.size());
    for (int i = 0; i < mass.size(); ++i) point(x, i) = centre + h * velocity + turn * (point(motion.x, i) - centre);
}

// The step of the paper, by forces at its start.
static bool step_from_start(Workspace& workspace, const StepInput& input, SolveReport& report) {
    carry_held(workspace, input);
    return solve_stage(workspace, input, {input.motion.x, input.motion.v, input.h, input.motion.x}, report);
}

// A step by forces where the body would be if it went on rigidly; that way is not damped.
static bool step_from_rigid_way(Workspace& workspace, const StepInput& input, SolveReport& report) {
    const Motion& motion = input.motion;
    carry_held(workspace, input);
    go_on_rigidly(*workspace.system, motion, input.h, workspace.x_from);
    workspace.v_rigid = (workspace.x_from - motion.x) / input.h;
    return solve_stage(workspace, input,
                       {motion.x, motion.v, input.h, workspace.x_from, nullptr, 0, &workspace.v_rigid}, report);
}

bool step_implicit_euler(Workspace& workspace, const StepInput& input, SolveReport& report) {
    return (input.settings.is_touched ? step_euler_ahead : step_from_start)(workspace, input, report);
}

bool goes_on_rigidly(const System& system, const Motion& motion) {
    return system.row->turns && !system.row->retract && !system.is_gone && is_loose(motion);
}

bool takes_forces_ahead(const System& system, const SolveSettings& settings) {
    return !system.row->retract && !settings.is_touched;
}

bool step_euler_ahead(Workspace& workspace, const StepInput& input, SolveReport& report) {
    const Motion& motion = input.motion;
    if (goes_on_rigidly(*workspace.system, motion)) return step_from_rigid_way(workspace, input, report);
    if (!takes_forces_ahead(*workspace.system, input.settings)) return step_from_start(workspace, input, report);
    carry_held(workspace, input);
    workspace.x_from = motion.x + input.h * motion.v;
    return solve_stage(workspace, input, {motion.x, motion.v, input.h, workspace.x_from}, report);
}

}  // namespace frond
