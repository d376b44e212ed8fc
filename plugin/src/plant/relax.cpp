// In: a cage that has just taken over a chain's shape and motion. Out: nearly the same, without strain that would snap
// back at once.
//
// A cage takes a chain's shape with errors that cost little to bend but much to stretch. A few steps of implicit Euler
// from rest, with the organs' fibres, relax those and leave slow bending unchanged; one solve does the same to
// velocities: (M + h^2 K) v = M v_given.
#include "plant/plant.hpp"

namespace frond {

void relax(Plant& plant) {
    constexpr int ROUNDS = 6;
    constexpr double STEP = 1.0 / 60;  // [s]
    Motion& motion = plant.motion;
    const VecX given = motion.v;
    SolveSettings settings = plant.settings;
    settings.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    Loads loads;
    if (plant.model->stands_as_modelled) loads.gravity = Vec3(0, -GRAVITY, 0);
    apply_pins(plant);
    take_workspace(plant);
    const VecX start = motion.x;
    bool ok = true;
    for (int round = 0; round < ROUNDS && ok; round++) {
        motion.v.setZero();
        plant.report = solve_step(*plant.workspace, settings, loads, STEP, motion);
        ok = plant.report.ok;
        hold_lengths(plant, STEP);
    }
    VecX momentum = given;
    const VecX& mass = node_mass_of(*plant.system);
    for (int i = 0; i < mass.size(); i++) point(momentum, i) *= mass[i];
    if (!ok || !motion.x.allFinite()) motion.x = start;
    if (!ok || !respond(*plant.workspace, settings, momentum, motion.v)) motion.v = given;
    motion.history.valid = false;
    motion.history.shaken = true;  // the first step damps the rest
    return_workspace(plant);
}

}  // namespace frond
