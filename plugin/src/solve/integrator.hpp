// Integrator: takes a step in time; rows of a table indexed by frond_integrator. Most consist of implicit stages.
#pragma once

#include "solve/workspace.hpp"

namespace frond {

// Input of a step.
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
    double step;                     // [s]
    const VecX& x_from;              // positions at which the first solve evaluates forces and stiffness [m]
    const VecX* impulse = nullptr;   // [N s]
    int iterations = 0;              // Newton iterations at most; 0: as the settings say
    const VecX* undamped = nullptr;  // velocities that strain nothing at x_from [m/s]; null: none
    StageBase base = {};             // whence x_base is, if from two positions
};

// Length beyond which a stage of rods is longer than the period of hanging parts [s].
constexpr double LONG_STAGE = 0.04;
// Returns whether a stage is so long.
bool is_long_stage(const System& system, double step);
// Returns the factor on the stiffness in stiffness-proportional damping [s]; `of_element` gets each element's own
// unless all damp alike.
double damping_of(const System& system, const SolveSettings& settings, std::vector<double>& of_element);

// Share of the last step's change in the base of bdf2, and the step of its stage [s].
struct Bdf2 {
    double back, step;
};
Bdf2 bdf2_after(double h_before, double h);
// Largest error of bdf2's first step by sdirk2, over the displacement, up to which it is taken [-].
constexpr double ROUGH_START = 0.5;

// Solves a stage and leaves the solution in workspace.x and .v; held nodes keep the velocity of workspace.v_start.
// Returns false if it cannot be solved.
bool solve_stage(Workspace& workspace, const StepInput& input, const Stage& stage, SolveReport& report);

// Returns whether something pushed the plant, so that its history is not used. The response to impulses is the last
// stage's; a stage much shorter than the step is softer, by the square of the ratio, and the plant would be pushed on
// in every step. Such a step is of implicit Euler, which has one stage.
inline bool is_pushed(const StepInput& input) {
    return !input.motion.history.valid && input.motion.history.shaken;
}

// Sets workspace.v_start of held nodes to their mean velocities over the step.
void carry_held(Workspace& workspace, const StepInput& input);
// Sets it to the velocities at the end of the step, for methods that go on from those.
void keep_held(Workspace& workspace);
// Predicts held nodes as free ones are, by velocities that they had, though their ends are known: where only those of
// free nodes were extrapolated, forces would be linearized at a foot that is bent against its plant.
void predict_held(Workspace& workspace, const VecX& x, double ahead, const VecX& v);
// Sets workspace.v_start of held nodes for methods of stages, whose steps leave their mean velocities: to that at a
// share of the step, at the acceleration from the last mean to this one.
void pace_held(Workspace& workspace, const StepInput& input, double share);
// Sets it to what leads them from workspace.x_base, within a stage, to where they are at that share of the way.
void lead_held(Workspace& workspace, const StepInput& input, double step, double share = 1);

// Returns whether predicted positions are within the trust bound.
inline bool is_calm(const System& system, const VecX& from, const VecX& to) {
    return system.row->is_calm(*system.elements, from, to);
}

// Adds the rotary inertia of free nodes that rotate to the matrix in workspace.A.
void add_inertia(Workspace& workspace, double scale);

// Returns whether the response to impulses is by mass alone, since the step solved no system.
bool responds_by_mass(const Workspace& workspace, const SolveSettings& settings);
// Computes x = M^-1 b for a lumped mass, with workspace.drag added; rows of held nodes are left as they are.
void divide_by_mass(const Workspace& workspace, const VecX& b, VecX& x);

// Puts forces and damping at the start of the step [N] into workspace.force.
void force_at_start(Workspace& workspace, const StepInput& input, SolveReport& report);

// Takes the step of implicit Euler by which other integrators step where they are not to look back, or have no stages.
// With forces at the start, as the paper's, what turns ends inflated, so they are taken at the positions that the
// velocities predict, where these are within the trust bound; of a cage that nothing holds at those to which it would
// go on rigidly.
bool step_euler_ahead(Workspace& workspace, const StepInput& input, SolveReport& report);
// Returns whether it does the latter.
bool goes_on_rigidly(const System& system, const Motion& motion);
// Returns whether it does the former otherwise: not where contacts follow, as velocities lead into what touches the
// plant, nor for what is retracted and so keeps its lengths anyway.
bool takes_forces_ahead(const System& system, const SolveSettings& settings);

struct Integrator {
    const char* name;
    // Takes a step and leaves its end in workspace.x and .v.
    bool (*step)(Workspace& workspace, const StepInput& input, SolveReport& report);
    bool looks_back;    // uses and needs the motion's history
    bool trusts_start;  // takes the change, or half of it, from forces at the step's start
    bool is_explicit;   // stable only for steps below about two over the highest frequency
    bool has_stages;    // its end, or a stage, lies on a straight line through another
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
