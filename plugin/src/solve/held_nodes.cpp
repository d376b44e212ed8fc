// Held nodes: only the place of each at the end of a step is known. Their velocities within it are those that the
// integrator finds in their places, as it does in those of free nodes: where a foot carries its plant evenly, or with
// even acceleration, nothing between them is strained or damped but what bears the load.
#include "solve/integrator.hpp"

namespace frond {

// Returns the mean velocity of a held node over the step; one that belongs to no element stays where it is.
static Vec3 mean_velocity(const StepInput& input, int node) {
    const Motion& motion = input.motion;
    const bool is_pinned = size_t(node) < motion.pinned.size() && motion.pinned[size_t(node)];
    return is_pinned ? Vec3((point(motion.pin_target, node) - point(motion.x, node)) / input.h) : Vec3(Vec3::Zero());
}

template <class F>
static void for_held(const Workspace& w, const F& act) {
    for (size_t i = 0; i < w.held.size(); ++i)
        if (w.held[i]) act(int(i));
}

void carry_held(Workspace& w, const StepInput& input) {
    for_held(w, [&](int i) { point(w.v_start, i) = mean_velocity(input, i); });
}

void predict_held(Workspace& w, const VecX& x, double ahead, const VecX& v) {
    for_held(w, [&](int i) { point(w.x_from, i) = point(x, i) + ahead * point(v, i); });
}

void pace_held(Workspace& w, const StepInput& input, double share) {
    for_held(w, [&](int i) {
        const Vec3 before = point(input.motion.v, i), mean = mean_velocity(input, i);
        point(w.v_start, i) = 0.5 * (before + mean) + share * (mean - before);
    });
}

void lead_held(Workspace& w, const StepInput& input, double step, double share) {
    for_held(w, [&](int i) {
        const Vec3 end = point(input.motion.x, i) + share * input.h * mean_velocity(input, i);
        point(w.v_start, i) = 1 / step * (end - point(w.x_base, i));
    });
}

void keep_held(Workspace& w) {
    for_held(w, [&](int i) { point(w.v_start, i) = point(w.v, i); });
}

}  // namespace frond
