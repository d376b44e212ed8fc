// The equations of an implicit stage. In: velocities at its end. Out: their residual, the potential that is least at
// the solution, and the matrix of a linear system for the next ones.
//
// D = mass_damping M + stiffness_damping K plus each element's own damping times its part of K, K being a positive
// stiffness, so that it never adds energy. It does not resist rotation as a whole where K is that of positions at which
// the stage's velocities turn the plant: of a straight way from the step's start, that is the middle. At the start,
// half of the step's turn behind, a rod that was solved to the end lost all energy within a second at 4 rad/s. A
// stage's only solve takes the stiffness at hand, for one factor.
#pragma once

#include "solve/integrator.hpp"

namespace frond {

// Vectors and matrices are the workspace's: elastic force and positions belong to the velocities that were given last.
struct StageEquations {
    Workspace& w;
    const StepInput& input;
    const Stage& stage;
    SolveReport& report;
    const System& system;
    const Mechanics& body;
    double rayleigh = 0;        // workspace.damping_scale [s]
    bool apart = false;         // elements differ in damping ratio: the damping is not a multiple of the stiffness
    bool keep_damping = false;  // the damping matrix is kept besides the stiffness, for several solves
    bool exact = false;         // the first solve uses the exact stiffness, the damping still the positive one
    bool at_once = false;       // the mechanics assemble right-hand side and matrix of the first solve in one pass
};

// Sets w.x to the end of the stage with velocities v.
void set_positions(const StageEquations& equations, const VecX& v);
// Returns the predicted positions if they are within the trust bound, else the start of the step.
const VecX& linearized_from(const StageEquations& equations);
// Computes force and stiffness at those, extrapolated to the end of the stage with the velocities known so far.
void linearize_at_start(StageEquations& equations);
// Forms the damping matrix for several solves, and for those that use the exact stiffness.
void form_damping(StageEquations& equations);
// Computes the residual at the end of the stage with velocities v and returns its norm.
double residual_at(StageEquations& equations, const VecX& v, VecX& rhs);
// Returns the stage's potential: minus its gradient by v is the residual.
double potential_at(const StageEquations& equations, const VecX& v);
// Changes v so that guided nodes end where their guides allow.
void follow_guides(const StageEquations& equations, VecX& v);
// Returns the norm over nodes that are not held, and free parts of guided ones.
double free_norm(const StageEquations& equations, const VecX& rhs);
// Forms A = (1 + step a) M + step^2 K + step b K_damping + springs + drags of the stiffness in w.A. `first`: K is the
// one at the start of the step, of which the damping is a multiple unless elements differ in damping ratio.
void form_matrix(StageEquations& equations, bool first, Tangent tangent);
// Makes rows and columns of held nodes, whose velocities are known, the identity, so that the pattern stays; likewise
// of held parts of guided ones.
void hold(StageEquations& equations);

}  // namespace frond
