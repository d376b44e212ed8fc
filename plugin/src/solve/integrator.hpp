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

// One implicit stage: the v for which M (v - v_base) = step * (forces at x - D v) + impulse, x = x_base + step * v.
struct Stage {
    const VecX& x_base;
    const VecX& v_base;
    double step;                    // [s]
    const VecX& x_from;             // where the first solve takes forces and stiffness [m]
    const VecX* impulse = nullptr;  // [N s]
    int iterations = 0;             // of Newton at most; 0: as the settings say
};

// Longer than what hangs takes to swing.
bool is_long_stage(const System& system, double step);
// What stiffness-proportional damping is times the stiffness [s]; `of_element` has each element's own unless all damp
// alike.
double damping_of(const System& system, const SolveSettings& settings, std::vector<double>& of_element);

// What bdf2 takes of the step before, and the step of its stage [s].
struct Bdf2 {
    double back, step;
};
Bdf2 bdf2_after(double h_before, double h);

// Leaves the stage's solution in workspace.x and .v; held nodes keep the velocity of workspace.v_start. False if it
// cannot be solved.
bool solve_stage(Workspace& workspace, const StepInput& input, const Stage& stage, SolveReport& report);

// Tells whether something pushed the plant that its integrator does not look back beyond. Impulses are answered to by
// the last stage; one that is much shorter than the step is softer than what the step's forces bend, by the square of
// that, and would be pushed on by the same each step: then the step is of implicit Euler, which has one stage.
inline bool is_pushed(const StepInput& input) {
    return !input.motion.history.valid && input.motion.history.shaken;
}

// Tells whether a guess of where a plant will be is near enough to be used.
inline bool is_calm(const System& system, const VecX& from, const VecX& to) {
    return system.row->is_calm(*system.elements, from, to);
}

// Adds the rotary inertia of free nodes that turn to the matrix in workspace.A.
void add_inertia(Workspace& workspace, double scale);

// Tells whether impulses are answered to by a mass alone, since the step solved no system.
bool responds_by_mass(const Workspace& workspace, const SolveSettings& settings);
// x = M^-1 b for a lumped mass, with workspace.drag beside it; rows of held nodes are left as they are.
void divide_by_mass(const Workspace& workspace, const VecX& b, VecX& x);

// Forces and damping at the start of the step [N], into workspace.force.
void force_at_start(Workspace& workspace, const StepInput& input, SolveReport& report);

struct Integrator {
    const char* name;
    // Leaves the end of the step in workspace.x and .v.
    bool (*step)(Workspace& workspace, const StepInput& input, SolveReport& report);
    bool looks_back;    // uses and needs the motion's history
    bool trusts_start;  // takes the change, or half of it, from the forces at the step's start
    bool is_explicit;   // stable only for steps below about two over the highest frequency
};
const Integrator& integrator(frond_integrator which);

// The rows.
bool step_implicit_euler(Workspace& workspace, const StepInput& input, SolveReport& report);
bool step_bdf2(Workspace& workspace, const StepInput& input, SolveReport& report);
bool step_sdirk2(Workspace& workspace, const StepInput& input, SolveReport& report);
bool step_tr_bdf2(Workspace& workspace, const StepInput& input, SolveReport& report);
bool step_generalized_alpha(Workspace& workspace, const StepInput& input, SolveReport& report);
bool step_symplectic_euler(Workspace& workspace, const StepInput& input, SolveReport& report);

}  // namespace frond
