// Solve: one step in time. Integrators and linear solvers are rows of tables indexed by the public enums.
#pragma once

#include <memory>

#include "mechanics/attachment.hpp"
#include "mechanics/mechanics.hpp"
#include "solve/node_compliance.hpp"

namespace frond {

// Data shared by all plants of one model and mechanics: elements, masses, sparsity and elimination order.
struct System;
// Makes a system: one a mechanics, since each has its own rest shape, and one an order of its elements.
std::shared_ptr<const System> make_system(std::shared_ptr<const Model> model, frond_mechanics which, frond_mass mass,
                                          int order = 1);
// Makes a system without the elements of the capsules that are `gone`, one flag a chain node. Nodes stay; those that
// belong to no element any more are left where they are.
std::shared_ptr<const System> system_without(const System& whole, const std::vector<uint8_t>& gone);
const Model& model_of(const System& system);
const Elements& elements_of(const System& system);
const VecX& node_mass_of(const System& system);  // row sums of the mass matrix, one a node [kg]

// A spring between a point of the plant and a fixed target.
struct Spring {
    Attachment attachment;
    Vec3 target;       // [m]
    double stiffness;  // [N/m]
};

// A fibre between two points of the plant, without rotating arms. It only pulls: its energy is half its stiffness times
// the square of what the points are farther apart than its length.
struct Fibre {
    Attachment begin, end;
    double length;     // [m]
    double stiffness;  // [N/m]
};

// Those of a solve. A stage whose one solve misses their energy by more than the tolerance is solved further.
struct FibreLoads {
    std::vector<Fibre> list;
    double tolerance;  // [J]
};

// Resistance to the motion of a point of the plant: force - damping times the point's velocity. Only for attachments
// without rotating arms.
struct Drag {
    Attachment attachment;
    Vec3 force;    // on the point at rest [N]
    Mat3 damping;  // symmetric, positive semi-definite [N s/m]
};

// Newton iterations granted where one is not enough; most steps take two to four.
constexpr int ENOUGH_SOLVES = 10;

// Settings of a step; the mechanics are the system's.
struct SolveSettings {
    frond_integrator integrator;
    frond_linear_solver linear_solver;
    int newton_iterations, max_iterations;
    double newton_tolerance, tolerance;
    double mass_damping, stiffness_damping;  // zero when the damping effect is off [1/s], [s]
    // Stiffness-proportional damping of an element whose organ has a damping ratio of one; adds to the above [s].
    double full_damping = 0;
    double spectral_radius = 0.8;  // generalized_alpha's at infinite frequency, 0..1 [-]
    bool careful = false;          // every solve has a line search
    bool from_rest = false;        // and may begin at rest, if the potential is less there
    bool is_touched = false;       // contacts will respond: rods keep the strain that a solve gives them (see
                                   // Mechanics::retract) only after that, by retract_step()
    int most_work = 0;             // work after which a stage with line searches ends where it is; 0: no limit
};

// State that a method with history keeps of its last step. It is valid only for the motion that this step left: if
// anything else moved a node since, or the integrator changed or the time step jumped, the method starts anew.
struct History {
    bool valid = false;
    bool shaken = false;  // the last step was a first one too, or something pushed since: bdf2 then starts with damping
    frond_integrator integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    double h = 0;       // length of the last step [s]
    VecX x_end, v_end;  // end of that step [m], [m/s]; empty: the motion, which nothing has moved since
    std::vector<uint8_t> pinned;
    VecX x_prev, v_prev;  // start of that step: bdf2
    VecX x_rate, v_rate;  // rates at its end [m/s], [m/s^2]: generalized_alpha
};

// All of a plant's state that a step changes. Nodes are in the frame of the rest positions.
struct Motion {
    VecX x, v;                    // node_count*3 [m], [m/s]
    std::vector<uint8_t> pinned;  // node_count
    VecX pin_target;              // pinned nodes at the end of the step, node_count*3 [m]
    History history;              // set valid = false after replacing x or v
};
// Returns the first pinned node from the i-th on; the size of `pinned` if there is none.
int next_pinned(const Motion& motion, int i);
// Returns whether no node is pinned.
inline bool is_loose(const Motion& motion) {
    return next_pinned(motion, 0) == int(motion.pinned.size());
}

// A node that rotates about one axis only, as on a hinge, or about all but one, as in a fork.
struct Guide {
    int node;       // of the rotation vector
    bool is_hinge;  // it turns about the axis only; else it does not turn about the axis
    Vec3 axis;      // of length one, in the frame of the nodes
    Vec3 made_at;   // rotation vector from which turns count
};

// Loads during a step, gathered by the effects.
struct Loads {
    VecX force;                   // node_count*3, empty: none [N]
    Vec3 gravity = Vec3::Zero();  // [m/s^2]; applied through the mass matrix
    std::vector<Spring> springs;
    bool springs_are_far = false;  // some pull from farther than their derivative holds for: see lead_pin_springs()
    std::unique_ptr<FibreLoads> fibres;  // of the plant itself; null: none is taut
    std::vector<Drag> drags;
    const std::vector<Guide>* guides = nullptr;  // borrowed; null: no node is held in part
};

struct SolveCost {
    int iterations = 0;  // iterations of the linear solver
    int work = 0;        // cost of line searches and their directions, in evaluations of all forces
    float ms_assembly = 0, ms_solve = 0;
    // Adds the cost of another solve.
    void add_cost(const SolveCost& other) {
        iterations += other.iterations;
        work += other.work;
        ms_assembly += other.ms_assembly;
        ms_solve += other.ms_solve;
    }
};

struct SolveReport : SolveCost {
    bool ok = false;  // false: the system could not be solved; motion is unchanged
    bool converged = true;
    bool is_sudden = false;  // a first step of bdf2 that was too sudden for any but implicit Euler: so is the next one
    bool leaves_bound = false;  // a stage was linearized at its start, its prediction being outside the trust bound
    int inverted = 0;           // number of inverted tets
    double residual = 0;        // relative, of the last linear solve
};

// Scratch space of one plant: matrix values, factor, vectors. Kept from step to step.
struct Workspace;
struct WorkspaceDeleter {
    void operator()(Workspace* workspace) const;
};
using WorkspacePtr = std::unique_ptr<Workspace, WorkspaceDeleter>;
WorkspacePtr make_workspace(std::shared_ptr<const System> system);

// Makes steps of this workspace use a plant's own elements, which must outlive it; null: the system's again.
void use_elements(Workspace& workspace, const Elements* own);

// Returns whether a step can be taken with these settings.
bool settings_are_sound(const SolveSettings& settings);
bool are_alike(const SolveSettings& a, const SolveSettings& b);
// Returns whether a method may use its history: only from the state that it left itself, and not across a jump of the
// time step.
bool history_holds(const Motion& motion, frond_integrator integrator, double h);

// Advances motion by h [s].
SolveReport solve_step(Workspace& workspace, const SolveSettings& settings, const Loads& loads, double h,
                       Motion& motion);

// Computes the change of the velocities at the end of the last step by an impulse on the nodes [N s]: dv = A^-1 impulse
// with the matrix of that step's last solve, so that elastic forces respond within the step; held nodes get none.
// Returns false if there is no solution.
bool respond(Workspace& workspace, const SolveSettings& settings, const VecX& impulse, VecX& dv);
// Estimates by how much velocities change in a step after one that changed them by `before`, with the same loads and
// impulses: change = A^-1 M before, in which elastic forces resist that change alone, not the velocity there was.
// Returns false if there is no solution.
bool go_on_changing(Workspace& workspace, const SolveSettings& settings, const VecX& before, VecX& change);
// Adds such velocities, and the displacements by them within the step, to the motion that the step left.
void add_response(const Workspace& workspace, const VecX& dv, Motion& motion);
// Does what a step with SolveSettings::is_touched left out, to its solution with all responses.
void retract_step(Workspace& workspace, Motion& motion);
// Adds only the displacements, so that what is moved apart gains no velocity.
void add_correction(const Workspace& workspace, const VecX& dv, Motion& motion);
// Does the same for impulses along three directions at a few nodes, except held ones, in a form that can be coupled
// with others. Blocks of a node that is given twice add up.
bool make_compliance(Workspace& workspace, const SolveSettings& settings, const std::vector<NodeBlock>& pushes,
                     NodeCompliance& compliance);

// Replaces rotation vectors beyond half a turn by those of the same rotation the other way round, in the motion, its
// pins and its history, and converts their rates. Between steps alone: see unwind.cpp.
void unwind(Motion& motion);
// Does the inverse: returns the rotation vector of the same rotation as `to` that is nearest to `from`; likewise those
// of all nodes that rotate.
Vec3 wound_as(const Vec3& from, const Vec3& to);
VecX wound_as(const VecX& from, VecX to);
// Returns the kinetic energy with the system's mass matrix [J].
double kinetic_energy(const System& system, const VecX& x, const VecX& v);

}  // namespace frond
