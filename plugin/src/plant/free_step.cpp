// Repeats and shortens the second half of a step.
#include "plant/guard.hpp"
#include "plant/load_work.hpp"
#include "plant/plant_step.hpp"
#include "solve/workspace.hpp"

namespace frond {

FreeStep free_step(const Plant& plant) {
    FreeStep step = {plant.state.motion.x,
                     plant.state.motion.v,
                     {},
                     plant.state.motion.history.shaken,
                     plant.state.motion.history.valid,
                     plant.step.is_sound,
                     plant.step.is_off_course,
                     plant.report,
                     plant.trouble};
    if (plant.step.workspace) step.retract_from = plant.step.workspace->retract_from;
    return step;
}

void take_back(Plant& plant, const FreeStep& step) {
    plant.state.motion.x = step.x;
    plant.state.motion.v = step.v;
    plant.state.motion.history.shaken = step.is_shaken;
    plant.state.motion.history.valid = step.has_history;
    plant.step.is_sound = step.is_sound;
    plant.step.is_off_course = step.is_off_course;
    const SolveCost spent = plant.report;
    plant.report = step.report;
    static_cast<SolveCost&>(plant.report) = spent;  // it was spent all the same
    plant.trouble = step.trouble;
    plant.step.push = nullptr;
    if (plant.step.workspace) plant.step.workspace->retract_from = step.retract_from;
}

static void shorten(Plant& plant, double share) {
    plant.state.motion.x = plant.step.x_good + share * way_of_step(plant);
    plant.state.motion.v *= share;
}

bool may_go_part_of_way(Plant& plant, double share, double h) {
    Motion& motion = plant.state.motion;
    const VecX x = motion.x, v = motion.v;
    shorten(plant, share);
    const bool may = gains_no_energy(plant, h);
    motion.x = x;
    motion.v = v;
    return may;
}

void go_part_of_way(Plant& plant, double share) {
    shorten(plant, share);
    plant.state.motion.history.valid = false;
    if (plant.step.push) plant.step.push->gone = share;
}

}  // namespace frond
