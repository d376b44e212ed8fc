// Workspace: the memory that a plant's steps reuse, so that none after the first allocates.
#pragma once

#include "solve/linear_solver.hpp"
#include "solve/system.hpp"

namespace frond {

struct Workspace {
    std::shared_ptr<const System> system;
    BlockMatrix A;        // stiffness, then the matrix of the linear system
    BlockMatrix damping;  // stiffness at the start of the step; filled only when several Newton iterations need it
    LinearScratch linear;

    std::vector<uint8_t> held;           // one a node: its velocity is given, not solved for
    VecX external;                       // forces that do not depend on the motion [N]
    VecX elastic;                        // force of the mechanics [N]
    VecX momentum, product;              // M v and K v
    VecX rhs, dv, held_dv;               // of the linear system
    VecX x, v;                           // at the end of the stage: positions and velocities [m], [m/s]
    VecX rhs_stage;                      // residual at v
    VecX direction, v_trial, rhs_trial;  // of a line search
};

}  // namespace frond
