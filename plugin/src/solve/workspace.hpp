// Workspace: the memory that a plant's steps reuse, so that none after the first allocates.
#pragma once

#include "solve/linear_solver.hpp"
#include "solve/system.hpp"

namespace frond {

struct Workspace {
    std::shared_ptr<const System> system;
    const Elements* elements = nullptr;  // the system's, or those of a plant that has yielded
    BlockMatrix A;                       // stiffness, then the matrix of the linear system
    // D = mass_damping M + damping_scale K + damping, see solve/stage_equations.hpp. If all elements damp alike,
    // `damping` is that K and filled only if several Newton iterations need it; else it has each element's own share of
    // damping times stiffness.
    double damping_scale = 0;             // [s]
    std::vector<double> element_damping;  // one an element, if they do not damp alike [s]
    BlockMatrix damping;
    LinearScratch linear;

    std::vector<Mat3> inertia;     // rotary, at the start of the step, of nodes that rotate [kg m^2]
    std::vector<Mat3> drag;        // length of an explicit step times lumped damping, one a node; empty: none [kg]
    std::vector<uint8_t> held;     // one a node: its velocity is given, not solved for
    std::vector<Guide> guides;     // of nodes that are held in part
    std::vector<Mat3> held_parts;  // projection on what is held of each, see look_at_guides()
    VecX external;                 // forces that do not depend on the motion [N]
    VecX elastic;                  // force of the mechanics [N]
    VecX momentum, product;        // M v and K v
    VecX rhs, dv;                  // right-hand side and solution of the linear system
    VecX x, v;                     // at the end of the stage: positions and velocities [m], [m/s]
    VecX v_start;                  // velocities at the start of the step; held nodes have that to their targets
    VecX x_prev, v_prev;           // start of the step before, held nodes likewise
    VecX x_rate, v_rate;           // rates at the end of the step, for the next one
    VecX x_base, v_base, x_from;   // base and prediction of the stage
    VecX x_middle;                 // of its straight way
    VecX v_rigid, v_damped;        // velocities of a rigid way, and those beside it
    VecX force, impulse;           // forces at the start of the step [N], impulse of the stage [N s]
    double reach = 0;              // derivative of positions by velocities at the end [s]
    VecX rhs_stage;                // residual at v
    VecX retracted;                // end of the stage after Mechanics::retract [m]
    VecX retract_from;             // where the only solve was linearized, if retract_step() is to come; else empty [m]
    VecX direction, v_trial, rhs_trial;  // scratch of the line search
    VecX search_from;                    // positions where it begins
};

}  // namespace frond
