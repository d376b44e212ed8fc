// Abreast: plants of one system that take a step side by side, a plant a lane of the processor (core/lanes.hpp). Of
// each vector every number is there once a lane. Only what every healthy step goes through is done so; a lane that
// needs more is told of, and left as it was.
#pragma once

#include "core/lanes.hpp"
#include "solve/front_batch.hpp"
#include "solve/linear_solver.hpp"
#include "solve/solve.hpp"
#include "solve/tree_batch.hpp"

namespace frond {

struct Batch {
    std::shared_ptr<const System> system;
    int lanes = 0;
    // In: of each plant.
    NumbersInLines x, v, x_prev, v_prev;  // as in Motion and History
    NumbersInLines gravity;               // [m/s^2]
    // Drags of places at rest with the air, one a chain node, which are pairs of nodes or System::chain; zero: there is
    // none there.
    NumbersInLines drag_force, drag_damping;  // three numbers [N], and xx, xy, xz, yy, yz, zz [N s/m]
    // Out.
    NumbersInLines x_end, v_end;
    std::array<double, MOST_LANES> residual;
    std::array<int, MOST_LANES> inverted;  // tets, where the forces were taken
    double reach = 0;                      // as in Workspace [s]
    unsigned wound = 0;  // lanes with a rotation vector longer than half a turn, or nearly so, a bit each: see unwind()

    // Room for the step.
    NumbersInLines v_start, x_from, x_base, v_base, way, elastic, rhs, dv, inertia;
    std::vector<uint8_t> held, filled;
    std::vector<double> element_damping;
    BlockMatrix A;
    TreeBatch tree;
    FrontBatch fronts;
};

// Whether plants of such a system, with such settings, can go abreast in steps of h [s].
bool may_be_batched(const System& system, const SolveSettings& settings, double h);
// In which so many plants go, on this processor.
int lanes_for(int count);
// For as many of a system.
void make_room(Batch& batch, std::shared_ptr<const System> system, int lanes);
// A step of h [s] after one of h_before by bdf2, whose history holds in all lanes, or by implicit Euler where that is
// 0. Pinned nodes stay where they are. Returns the lanes that have to be stepped alone, a bit each.
unsigned step_batch(Batch& batch, const SolveSettings& settings, const std::vector<uint8_t>& pinned, double h,
                    double h_before);
// Gives lanes that have a workspace, of a plan of fronts, what respond() and make_answer() ask of it.
void take_apart(const Batch& batch, Workspace* const* workspaces);

}  // namespace frond
