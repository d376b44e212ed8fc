// Integrator: takes a step in time; rows of a table indexed by frond_integrator. Each is made of implicit stages.
#pragma once

#include "solve/workspace.hpp"

namespace frond {

// What a step was given.
struct StepInput {
    const SolveSettings& settings;
    const Loads& loads;
    const Motion& motion;  // at the start of the step
    double h;              // [s]
};

// One implicit stage: the v for which M (v - v_base) = step * (forces at x - D v), x = x_base + step * v.
struct Stage {
    const VecX& x_base;
    const VecX& v_base;
    double step;  // [s]
};

// Leaves the stage's solution in workspace.x and .v; pinned nodes get to their targets. False if it cannot be solved.
bool solve_stage(Workspace& workspace, const StepInput& input, const Stage& stage, SolveReport& report);

struct Integrator {
    const char* name;
    // Leaves the end of the step in workspace.x and .v.
    bool (*step)(Workspace& workspace, const StepInput& input, SolveReport& report);
};
const Integrator& integrator(frond_integrator which);

// The rows.
bool step_implicit_euler(Workspace& workspace, const StepInput& input, SolveReport& report);

}  // namespace frond
