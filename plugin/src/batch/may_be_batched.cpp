// In: plants and a time h. Out: which of them may share a batch.
#include "batch/batch_step.hpp"
#include "batch/plants.hpp"
#include "plant/guard.hpp"
#include "plant/pins.hpp"
#include "plant/plant_step.hpp"
#include "solve/integrator.hpp"

namespace frond {

// Predicts whether the step continues from the history, or starts anew and damped. After a batched step the history is
// not compared here but in goes_on(), where the job has the plant's numbers at hand.
static bool foresee_method(Plant& plant, double h) {
    const History& history = plant.state.motion.history;
    plant.step.looks_back = history.valid && (history.x_end.size() == 0 ||
                                              history_holds(plant.state.motion, plant.input.settings.integrator, h));
    if (plant.step.looks_back) return true;
    return (history.shaken || plant.state.is_touched) && !goes_on_rigidly(*plant.system, plant.state.motion);
}

bool goes_on(const Plant& plant, double h) {
    const Motion& motion = plant.state.motion;
    return history_holds(motion, plant.input.settings.integrator, h) == plant.step.looks_back &&
           ((plant.step.looks_back && motion.history.x_end.size() == 0) || !is_carried(motion, motion.x, motion.v));
}

bool may_be_batched(Plant& plant, const Surroundings& surroundings, double h) {
    return !plant.state.modal && !plant.state.own_elements && !plant.step.workspace && !plant.input.has_user_force &&
           plant.input.grabs.empty() && plant.step.bonded.empty() && !plant.input.supports &&
           plant.state.fragments.empty() && plant.input.pin_springs.empty() && !plant.input.pins_changed &&
           plant.state.recovers_for <= 0 && plant.input.max_substeps <= 1 && plant.state.fibre_give.empty() && h > 0 &&
           h <= TRUSTED &&
           frond::may_be_batched(*plant.system, settings_for(plant, plant.input.effects & surroundings.effects), h) &&
           (!waits(plant) || can_be_taken_apart(*plant.system)) && foresee_method(plant, h);
}

bool go_alike(const Plant& a, const Plant& b) {
    return a.system == b.system && a.input.effects == b.input.effects && a.size == b.size &&
           a.step.looks_back == b.step.looks_back &&
           (a.step.looks_back ? a.state.motion.history.h == b.state.motion.history.h
                              : a.state.is_touched == b.state.is_touched) &&
           are_alike(a.input.settings, b.input.settings) && a.state.motion.pinned == b.state.motion.pinned;
}

int most_in_batch() {
    return lanes_for(MOST_LANES);
}

}  // namespace frond
