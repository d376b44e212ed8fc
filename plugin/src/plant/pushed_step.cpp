// In: a step solved without contacts, and what these do to it. Out: the step with them.
#include <algorithm>

#include "core/assert.hpp"
#include "plant/guard.hpp"
#include "plant/plant_step.hpp"
#include "solve/integrator.hpp"

namespace frond {

// Returns whether the solution, as moved since then, can be the next state.
static bool is_sound(const Plant& plant) {
    return plant.report.ok && are_finite(plant.state.motion.x) && are_finite(plant.state.motion.v) &&
           !has_run_away(plant);
}

// Returns whether one solve predicts the displacements well. An unwound rotation vector has not turned far.
static bool is_calm_way(const Plant& plant) {
    const VecX& from = plant.step.x_good;
    const auto is_calm_to = [&](const VecX& to) { return is_calm(*plant.system, from, to); };
    return is_calm_to(plant.state.motion.x) || (plant.follow && is_calm_to(wound_as(from, plant.state.motion.x)));
}

double parting_work(double mass, double h) {
    constexpr double SPEED = 0.1;  // [m/s]
    return mass * GRAVITY * SPEED * h;
}
double parting_work(const Plant& plant, double h) {
    return parting_work(node_mass_of(*plant.system).sum(), h);
}

// Corrects positions as far as nothing bends much and the work done on the plant, and by it on what pulls it, stays
// small: contacts with conflicting corrections would compress it like a spring. The rest is left to the next steps;
// even of an excessive correction a little is applied, or thick stems would never part.
static VecX move_by(Plant& plant, const VecX& dv, double h) {
    constexpr double LEAST = 0.002;  // share [-]
    const VecX x = plant.state.motion.x;
    const ContactPush* push = plant.step.push.get();
    const bool is_known = push && push->x.size() == x.size() && push->x == x;
    const double allowed =
        (is_known ? push->elastic : elastic_energy(plant, x)) + potential_of_pulls(plant, x) + parting_work(plant, h);
    const auto energy_at = [&](const VecX& at) { return elastic_energy(plant, at) + potential_of_pulls(plant, at); };
    for (double share = 1; share > LEAST; share /= 2) {
        add_correction(*plant.step.workspace, share * dv, plant.state.motion);
        if (is_calm_way(plant) && energy_at(plant.state.motion.x) <= allowed) return plant.state.motion.x - x;
        plant.state.motion.x = x;
    }
    return {};
}

// Solves a chain again in another workspace: the responses that follow in this step are by the factor of the step
// without contacts, from which all contacts' velocities are. A chain that a push has thrown far may be stiffer there by
// far, and the next push would be as much larger. A cage stiffens as it bends, which foretells what the next push does.
static void solve_again_aside(Plant& plant, double h) {
    if (!plant.follow) return solve_again(plant, h);
    WorkspacePtr without = std::move(plant.step.workspace);
    take_workspace(plant);
    solve_again(plant, h);
    return_workspace(plant);
    plant.step.workspace = std::move(without);
}

ContactPush& push_of(Plant& plant) {
    if (!plant.step.push) plant.step.push = std::make_unique<ContactPush>();
    return *plant.step.push;
}

void add_contacts(Plant& plant, double h) {
    FROND_ASSERT(plant.step.workspace);
    ContactPush& push = push_of(plant);
    if (!plant.step.is_sound) return push.impulse.resize(0);
    VecX dv;
    const bool has_impulse = push.impulse.size() > 0;
    if (has_impulse && respond(*plant.step.workspace, plant.input.settings, push.impulse, dv))
        add_response(*plant.step.workspace, dv, plant.state.motion);
    // What is pushed goes along with what pushes it, as far as the response is linear; what stands gives nothing.
    if (has_impulse) push.most_work = push.impulse.dot(plant.state.motion.v);
    retract_step(*plant.step.workspace, plant.state.motion);
    if (has_impulse) {
        const double by_what_stands = std::max(0.0, push.asked_work - parting_work(plant, h));
        const double on_way = push.impulse.dot(way_of_step(plant)) / h;
        push.most_work = std::max(0.0, std::min(push.most_work, on_way) - by_what_stands);
    }
    // Cages are not retracted: what turns in them is inflated.
    const bool is_bent =
        has_impulse && !plant.follow && !is_calm(*plant.system, plant.step.x_good, plant.state.motion.x);
    // Where this is too far for the linear response, the same push is solved as a force, nonlinearly.
    if (has_impulse) look_at_fibres(plant);
    if (is_bent || !is_plausible(plant, h)) solve_again_aside(plant, h);
    plant.step.is_sound = is_sound(plant) && !is_far_out(plant);
}

VecX correct_position(Plant& plant, const VecX& impulses, double h) {
    FROND_ASSERT(plant.step.workspace);
    VecX dv;
    if (!plant.step.is_sound || !respond(*plant.step.workspace, plant.input.settings, impulses, dv)) return {};
    const VecX way = move_by(plant, dv, h);
    plant.step.is_sound = is_sound(plant) && !is_far_out(plant);
    return way;
}

}  // namespace frond
