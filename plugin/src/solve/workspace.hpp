// Workspace: the memory that a plant's steps reuse, so that none after the first allocates.
#pragma once

#include "solve/linear_solver.hpp"
#include "solve/system.hpp"

namespace frond {

struct Workspace {
    std::shared_ptr<const System> system;
    const Elements* elements = nullptr;  // the system's, or a plant's own that has yielded
    BlockMatrix A;                       // stiffness, then the matrix of the linear system
    // D = mass_damping M + damping_scale K + damping, of K at the start of the step. Where all elements damp alike,
    // `damping` is that K and filled only if several Newton iterations need it; else K has each element's own share in
    // it.
    double damping_scale = 0;             // [s]
    std::vector<double> element_damping;  // one an element, if they do not damp alike [s]
    BlockMatrix damping;
    LinearScratch linear;

    std::vector<Mat3> inertia;    // rotary, at the start of the step, of nodes that turn [kg m^2]
    std::vector<Mat3> drag;       // of an explicit step: its length times lumped damping, one a node; empty: none [kg]
    std::vector<uint8_t> held;    // one a node: its velocity is given, not solved for
    VecX external;                // forces that do not depend on the motion [N]
    VecX elastic;                 // force of the mechanics [N]
    VecX momentum, product;       // M v and K v
    VecX rhs, dv;                 // of the linear system
    VecX x, v;                    // at the end of the stage: positions and velocities [m], [m/s]
    VecX v_start;                 // of the step; held nodes have the velocity that takes them to their targets
    VecX x_prev, v_prev;          // of the step before, held nodes likewise
    VecX x_rate, v_rate;          // rates at the end of the step, for the next one
    VecX x_base, v_base, x_from;  // of the stage
    VecX force, impulse;          // at the start of the step [N], [N s]
    double reach = 0;             // how far places at the end go with velocities there [s]
    VecX rhs_stage;               // residual at v
    VecX direction, v_trial, rhs_trial;  // of a line search
};

}  // namespace frond
