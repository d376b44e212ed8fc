// Solve: one step in time. Integrators and linear solvers are rows of tables indexed by the public enums.
#pragma once

#include <memory>

#include "mechanics/attachment.hpp"
#include "mechanics/mechanics.hpp"
#include "solve/node_compliance.hpp"

namespace frond {

// What all plants of one model share that have the same mechanics: elements, masses, sparsity and elimination order.
struct System;
// One a mechanics, since each has a rest shape of its own, and one an order of its elements.
std::shared_ptr<const System> make_system(std::shared_ptr<const Model> model, frond_mechanics which, frond_mass mass,
                                          int order = 1);
// Without the elements of the capsules that are gone, one flag a chain node. Nodes stay; those that no element holds
// any more are left where they are.
std::shared_ptr<const System> system_without(const System& whole, const std::vector<uint8_t>& gone);
const Model& model_of(const System& system);
const Elements& elements_of(const System& system);
const VecX& node_mass_of(const System& system);  // sums of the mass matrix's rows, one a node [kg]

// A spring between a point of the plant and a fixed target.
struct Spring {
    Attachment attachment;
    Vec3 target;       // [m]
    double stiffness;  // [N/m]
};

// What resists the motion of a point of the plant: force - damping times the point's velocity. Of grips that do not
// turn.
struct Drag {
    Attachment attachment;
    Vec3 force;    // on the point if it stood still [N]
    Mat3 damping;  // symmetric, never negative [N s/m]
};

// The mechanics are the system's.
struct SolveSettings {
    frond_integrator integrator;
    frond_linear_solver linear_solver;
    int newton_iterations, max_iterations;
    double newton_tolerance, tolerance;
    double mass_damping, stiffness_damping;  // zero when the damping effect is off [1/s], [s]
    // Stiffness-proportional damping of an element whose organ has a damping ratio of one; adds to the above [s].
    double full_damping = 0;
    double spectral_radius = 0.8;  // of generalized_alpha at infinite frequency, 0..1 [-]
    bool careful = false;          // every solve goes no farther than a line search says
    bool from_rest = false;        // and may begin at rest, where the potential is less there
    int most_work = 0;             // after which a stage that searches ends where it is; 0: never
};

// What a method that looks back keeps of its last step. It holds only for the motion that this step left: where
// anything else moved a node since, or the integrator or the time step changed, the method starts anew.
struct History {
    bool valid = false;
    bool shaken = false;  // the last step was a first one too, or something pushed since: bdf2 then starts with damping
    frond_integrator integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    double h = 0;       // of the last step [s]
    VecX x_end, v_end;  // what that step left [m], [m/s]; empty: the motion, which nothing has moved since
    std::vector<uint8_t> pinned;
    VecX x_prev, v_prev;  // what it started from: bdf2
    VecX x_rate, v_rate;  // rates at its end [m/s], [m/s^2]: generalized_alpha
};

// Everything of a plant that a step changes. Nodes in the frame of the rest positions.
struct Motion {
    VecX x, v;                    // node_count*3 [m], [m/s]
    std::vector<uint8_t> pinned;  // node_count
    VecX pin_target;              // where pinned nodes are at the end of the step, node_count*3 [m]
    History history;              // set valid = false after putting x or v to a state of another time
};
// From the i-th node on; node_count when there is none.
int next_pinned(const Motion& motion, int i);

// What acts during a step, gathered by the effects.
struct Loads {
    VecX force;                   // node_count*3, empty: none [N]
    Vec3 gravity = Vec3::Zero();  // [m/s^2]; applied through the mass matrix
    std::vector<Spring> springs;
    std::vector<Drag> drags;
};

struct SolveReport {
    bool ok = false;  // false: the system could not be solved; motion is unchanged
    bool converged = true;
    int iterations = 0;   // of the linear solver
    int work = 0;         // of line searches and what leads to them, in evaluations of all forces
    int inverted = 0;     // tets
    double residual = 0;  // relative, of the last linear solve
    float ms_assembly = 0, ms_solve = 0;

    // What another solve took is in this report too.
    void add_cost(const SolveReport& other) {
        iterations += other.iterations;
        work += other.work;
        ms_assembly += other.ms_assembly;
        ms_solve += other.ms_solve;
    }
};

// Scratch space of one plant: matrix values, factor, vectors. Kept from step to step.
struct Workspace;
struct WorkspaceDeleter {
    void operator()(Workspace* workspace) const;
};
using WorkspacePtr = std::unique_ptr<Workspace, WorkspaceDeleter>;
WorkspacePtr make_workspace(std::shared_ptr<const System> system);

// Steps of this workspace take a plant's own elements, which must live as long; null: the system's again.
void use_elements(Workspace& workspace, const Elements* own);

// Numbers that a step can be taken with.
bool settings_are_sound(const SolveSettings& settings);
bool are_alike(const SolveSettings& a, const SolveSettings& b);
// A method that looks back may do so only from the state that it left itself, and not over a jump of the time step.
bool history_holds(const Motion& motion, frond_integrator integrator, double h);

// Advances motion by h [s].
SolveReport solve_step(Workspace& workspace, const SolveSettings& settings, const Loads& loads, double h,
                       Motion& motion);

// What an impulse on the nodes [N s] adds to the velocities with which the last step ended: dv = A^-1 impulse with the
// matrix of that step's last solve, so that elastic forces answer within the step; held nodes get none. False if it has
// no solution.
bool respond(Workspace& workspace, const SolveSettings& settings, const VecX& impulse, VecX& dv);
// How far places at the end of the last step go with velocities there [s].
double reach_of(const Workspace& workspace);
// Adds such velocities, and where they lead within the step, to the motion that the step left.
void add_response(const Workspace& workspace, const VecX& dv, Motion& motion);
// Adds only where they lead, so that what is moved apart does not fly apart.
void add_correction(const Workspace& workspace, const VecX& dv, Motion& motion);
// The same for impulses along three directions at a few nodes, held ones left out, to be coupled with others. The
// blocks of a node that is given twice add up.
bool make_compliance(Workspace& workspace, const SolveSettings& settings, const std::vector<NodeBlock>& pushes,
                     NodeCompliance& compliance);

// Of nodes that turn: rotation vectors grown beyond half a turn become those of the same rotation the other way round,
// here and in the history, and their rates follow.
void unwind(Motion& motion);
// The other way: what is at `to`, each rotation vector the one of the same rotation that is nearest to that at `from`.
VecX wound_as(const VecX& from, VecX to);
// With the system's mass [J].
double kinetic_energy(const System& system, const VecX& x, const VecX& v);

}  // namespace frond
