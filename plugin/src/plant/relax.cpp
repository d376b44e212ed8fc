// In: mechanics that have just taken over a plant's shape and motion. Out: nearly the same, with no more energy than
// the plant had before.
//
// A cage takes a chain's shape, and a chain a cage's, with errors that cost little to bend but much to stretch. Steps
// of implicit Euler from rest, with the organs' fibres, relax those first and leave slow bending unchanged; one solve
// does the same to velocities: (M + h^2 K) v = M v_given. What is strained too far for that goes part of the way to the
// modelled shape.
#include <algorithm>

#include "plant/guard.hpp"
#include "plant/pins.hpp"
#include "plant/plant_step.hpp"
#include "plant/supports.hpp"

namespace frond {

StoredEnergy stored_energy(const Plant& plant) {
    const Mechanics& row = mechanics(plant.which, plant.nodes->order);
    const Elements& new_ones = elements_of(*plant.system);  // plastic strain leaves the modelled shape strained
    const VecX& x = plant.state.motion.x;
    const double lifted = -work_of_weight(plant, x - new_ones.modelled);
    return {elastic_energy(plant, x) - row.energy(new_ones, new_ones.modelled) + lifted,
            kinetic_energy(*plant.system, plant.state.motion.x, plant.state.motion.v)};
}

// Takes velocities over as far as the stiffness at the end of the last step lets them be.
static void take_velocities(Plant& plant, const SolveSettings& settings, const VecX& given) {
    VecX momentum = given;
    const VecX& mass = node_mass_of(*plant.system);
    for (int i = 0; i < mass.size(); i++) point(momentum, i) *= mass[i];
    if (!respond(*plant.step.workspace, settings, momentum, plant.state.motion.v)) plant.state.motion.v.setZero();
}

// Lets go of pinned nodes that are not where their pins were moved: what those do is work of the next step.
static void let_go_of_moved(Plant& plant) {
    apply_pins(plant);
    Motion& motion = plant.state.motion;
    const double near = PINS_STAND * double(plant.size);
    const int next = plant.follow ? 2 : 1, count = int(motion.pinned.size());
    for (int i = 0; i < count; i += next)
        if (motion.pinned[size_t(i)] && (point(motion.pin_target, i) - point(motion.x, i)).norm() > near)
            std::fill_n(motion.pinned.begin() + i, next, uint8_t(0));
    plant.input.pins_changed = true;
}

// Takes steps from rest, longer ones where these gain little, until the plant stores no more than `bound` or as little
// as it can as it is held. Returns whether there was a step; its workspace is that of the last one.
static bool take_steps(Plant& plant, SolveSettings& settings, double bound) {
    constexpr int ROUNDS = 30, ITERATIONS = 10;  // steps, and solves in each
    constexpr double SLOW = 0.9;                 // share of what is too much that a step leaves before a longer one [-]
    double h = 1.0 / 60;                         // [s]
    Motion& motion = plant.state.motion;
    Loads loads;
    loads.gravity = plant.step.loads->gravity;
    loads.guides = &guides_of(plant);
    loads.fibres = fibres_of(plant);
    if (loads.gravity.isZero(0) && plant.model->stands_as_modelled) loads.gravity = Vec3(0, -GRAVITY, 0);
    double stored = stored_energy(plant).potential;
    if (stored <= bound) return false;
    for (int round = 0; round < ROUNDS && !(stored <= bound); round++) {
        take_workspace(plant);
        const VecX before = motion.x;
        motion.v.setZero();
        plant.report = solve_step(*plant.step.workspace, settings, loads, h, motion);
        const double next = stored_energy(plant).potential;
        if (plant.report.ok && next < stored) {
            if (!(next - bound < SLOW * (stored - bound))) h *= 2;
            stored = next;
            continue;
        }
        motion.x = before;
        if (settings.careful) break;
        // One solve overshoots: a search does not.
        settings.newton_iterations = std::max(settings.newton_iterations, ITERATIONS);
        settings.careful = settings.from_rest = true;
    }
    return true;
}

void relax(Plant& plant, const StoredEnergy& most, bool pins_moved) {
    // Shares of the energy that lifts the plant by its size: what counts as none, and what a step's check allows [-].
    constexpr double SHARE = 0.001, ALLOWED = 0.01;
    Motion& motion = plant.state.motion;
    const double none = SHARE * lifting_energy(plant), bound = most.potential + none;
    const VecX given = motion.v;
    SolveSettings settings = plant.input.settings;
    settings.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    if (pins_moved)
        let_go_of_moved(plant);
    else
        apply_pins(plant);
    plant.step.has_fibres = true;
    if (take_steps(plant, settings, bound)) {
        take_velocities(plant, settings, given);
        return_workspace(plant);
        const double most_left = bound + ALLOWED * lifting_energy(plant);
        if (!(stored_energy(plant).potential <= most_left)) approach_modelled(plant, most_left);
    }
    // What could not be relaxed is taken from the motion.
    const StoredEnergy now = stored_energy(plant);
    const double kinetic = std::max(0.0, most.kinetic + std::min(0.0, bound - now.potential));
    if (!(now.kinetic <= kinetic + none)) motion.v *= std::sqrt(kinetic / now.kinetic);
    motion.history.valid = false;
    motion.history.shaken = true;  // the first step damps the rest
}

}  // namespace frond
