// In: a plant before and after a solve. Out: whether it gained energy that nothing can have given.
//
// One solve takes forces and stiffness at one position; if a plant turns far within the step, they have the wrong
// directions, and a stiff, light plant ends strained by many times what it was.
#include <algorithm>
#include <cmath>

#include "plant/guard.hpp"
#include "plant/load_work.hpp"
#include "plant/pins.hpp"
#include "plant/plant_step.hpp"
#include "solve/integrator.hpp"

namespace frond {

double work_of_weight(const Plant& plant, const VecX& way) {
    const VecX& mass = node_mass_of(*plant.system);
    Vec3 moved = Vec3::Zero();
    for (int i = 0; i < mass.size(); i++) moved += mass[i] * point(way, i);
    return plant.step.loads->gravity.dot(moved);
}

double potential_of_pulls(const Plant& plant, const VecX& x) {
    const Loads& loads = *plant.step.loads;
    double energy = loads.force.size() > 0 ? -loads.force.dot(x) : 0;
    for (const Spring& spring : loads.springs)
        energy += 0.5 * spring.stiffness * (attachment_place(spring.attachment, x) - spring.target).squaredNorm();
    return energy;
}

double potential_energy(const Plant& plant, const VecX& x) {
    return elastic_energy(plant, x) - work_of_weight(plant, x) + potential_of_pulls(plant, x);
}

double lifting_energy(const Plant& plant) {
    return node_mass_of(*plant.system).sum() * GRAVITY * double(plant.size);
}

// Allowed errors of energy, as shares of that at the start and of that which lifts the plant by its size [-].
struct AllowedEnergy {
    double share, lift;
};
constexpr AllowedEnergy OF_ONE_SOLVE = {0.01, 0.01}, CONVERGED = {0, 1e-5};

// Returns whether the plant has more energy than it had and than the loads and contacts can have given. The air's work
// on a chain that turns is known as well as its order alone.
static bool has_energy_from_nowhere(Plant& plant, const AllowedEnergy& allowed, double h) {
    const LoadWork work = work_of_loads(plant, h);
    const VecX way = way_of_step(plant);
    const ContactPush* push = plant.step.push.get();
    const double by_contacts = is_pushed(plant) ? std::min(push->share * push->most_work, work.contacts) : 0;
    const VecX &x = plant.state.motion.x, &x_good = plant.step.x_good;
    const double given = by_contacts + work.forces + work.grabs + work.air + work.pins + work.error +
                         (plant.follow ? std::abs(work.air) : 0) + work_of_weight(plant, way) +
                         allowed.lift * lifting_energy(plant);
    const double elastic = elastic_energy(plant, x);
    if (plant.step.push) {
        plant.step.push->x = x;
        plant.step.push->elastic = elastic;
    }
    const double after = kinetic_energy(*plant.system, x, plant.state.motion.v) + elastic;
    // The energy before the step is seldom needed.
    if (after <= given) return false;
    const double before = kinetic_energy(*plant.system, x_good, plant.step.v_good) + elastic_energy(plant, x_good);
    return !(after <= given + (1 + allowed.share) * before);
}

// Returns whether a spring that holds a pinned node was led anywhere in the step.
static bool leads_springs(const Plant& plant) {
    const auto is_led = [&](const Spring& spring) {
        const Vec3 way = spring.target - attachment_place(spring.attachment, plant.step.x_good);
        return way.norm() > PINS_STAND * double(plant.size);
    };
    return std::any_of(plant.input.pin_springs.begin(), plant.input.pin_springs.end(), is_led);
}

bool may_inflate(const Plant& plant) {
    if (plant.follow) return false;
    const bool is_implicit_euler =
        plant.state.is_touched || plant.input.settings.integrator == FROND_INTEGRATOR_IMPLICIT_EULER;
    return is_implicit_euler || is_loose(plant.state.motion);
}

// Returns whether elements turn so far that a step on its course may be wrong. A neo-Hookean twig of 2 mm that turned
// by 9 degrees ended with five times its energy; springs of a leaf, which are far stiffer along it than its tissue,
// with eight times.
static bool turns_far(const Plant& plant) {
    const double share = plant.system->row->asked_from;
    return share > 0 && !is_calm(*plant.system, plant.step.x_good, plant.step.x_good + 1 / share * way_of_step(plant));
}

bool keeps_course(Plant& plant, double h) {
    plant.step.is_off_course = ends_off_course(plant, h);
    const bool recovers = plant.state.recovers_for > 0;
    const bool is_asked = plant.step.is_off_course || plant.step.is_inexact || plant.step.starts_anew ||
                          is_pushed(plant) || recovers || plant.report.inverted > 0 || may_inflate(plant) ||
                          hold_several_places(plant) || integrator(plant.step.settings.integrator).has_stages ||
                          is_carried(plant.state.motion, plant.step.x_good, plant.step.v_good) ||
                          leads_springs(plant) || turns_far(plant) || (plant.report.leaves_bound && !plant.follow);
    // Thousands of times the energy of a vibration leave no share of it to errors.
    const AllowedEnergy& allowed = recovers ? CONVERGED : OF_ONE_SOLVE;
    return !(is_asked && has_energy_from_nowhere(plant, allowed, h)) && !has_run_away(plant);
}

bool gains_no_energy(Plant& plant, double h) {
    return !has_energy_from_nowhere(plant, OF_ONE_SOLVE, h);
}

bool is_plausible(Plant& plant, double h) {
    if (plant.step.push || !plant.state.is_touched) return keeps_course(plant, h);
    plant.step.is_off_course = ends_off_course(plant, h);
    return !has_run_away(plant);
}

}  // namespace frond
