// Batch: plants of one system that take a step together, one plant a lane (core/lanes.hpp). Each number of a vector is
// stored once a lane. A batch does only what every healthy step needs; a lane that needs more is reported, and its
// plant left as it was.
#pragma once

#include "core/lanes.hpp"
#include "solve/block_factor.hpp"
#include "solve/linear_solver.hpp"
#include "solve/solve.hpp"

namespace frond {

struct Batch {
    std::shared_ptr<const System> system;
    int lanes = 0;
    // In, for each plant:
    NumbersInLines x, v, x_prev, v_prev;  // see Motion and History
    NumbersInLines gravity;               // [m/s^2]
    // Air drag at each chain node, which is a pair of nodes or a point of System::chain; zero: none.
    NumbersInLines drag_force, drag_damping;     // three numbers [N], and xx, xy, xz, yy, yz, zz [N s/m]
    unsigned with_fibres = 0;                    // lanes whose plants have taut fibres, a bit each
    const std::vector<Fibre>* fibres = nullptr;  // of each of those plants
    // Out:
    NumbersInLines x_end, v_end;
    std::array<double, MOST_LANES> residual;
    std::array<int, MOST_LANES> inverted;  // number of inverted tets where forces were evaluated
    double reach = 0;                      // see Workspace [s]
    unsigned wound = 0;  // lanes with a rotation vector longer than half a turn, or nearly so, a bit each: see unwind()
    unsigned may_yield = 0;  // see BatchMechanics::retract

    // Scratch of the step.
    NumbersInLines v_start, x_from, x_base, v_base, way, elastic, rhs, dv, inertia, retracted, seen;
    std::vector<uint8_t> held, filled;
    std::vector<double> element_damping;
    BlockMatrix A;
    BlockFactor factor;
};

// Returns whether plants of such a system can be batched, with such settings, in steps of h [s].
bool may_be_batched(const System& system, const SolveSettings& settings, double h);
// Returns the number of lanes for so many plants on this processor.
int lanes_for(int count);
// Resizes a batch for a system and a number of lanes.
void make_room(Batch& batch, std::shared_ptr<const System> system, int lanes);
// Takes a step of h [s]: of bdf2 after a step of h_before, with a valid history in all lanes, or of implicit Euler if
// h_before is 0. Pinned nodes stay where they are. Returns a bit for each lane that has to be stepped alone.
unsigned step_batch(Batch& batch, const SolveSettings& settings, const std::vector<uint8_t>& pinned, double h,
                    double h_before);
// Returns where a lane's fibres were linearized in the last step: its end, with the velocities before the solve.
VecX linearized_end(const Batch& batch, int lane);
// Computes |b - A x| / |b| of each lane; `left` is scratch.
void relative_residuals(const BlockMatrix& A, const NumbersInLines& b, const NumbersInLines& x, NumbersInLines& left,
                        double* out);
// Returns whether a batch of a system that may be batched can be taken apart: plans of trees cannot.
bool can_be_taken_apart(const System& system);
// Fills each lane's workspace, if any, with what respond() and make_compliance() need.
void take_apart(const Batch& batch, Workspace* const* workspaces);

}  // namespace frond
