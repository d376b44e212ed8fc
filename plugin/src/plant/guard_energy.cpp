// In: a plant before and after a solve. Out: whether energy came out of nothing.
//
// One solve takes forces and stiffness of one place; where a plant turns far within the step they point elsewhere, and
// a stiff, light one ends strained by many times what it was.
#include <algorithm>
#include <cmath>

#include "plant/guard.hpp"
#include "plant/plant.hpp"
#include "solve/workspace.hpp"

namespace frond {

// With each node's own mass, and the rotary inertia that the step began with: to work it out anew costs as much as all
// strains do [J].
static double kinetic_in_step(const Plant& plant, const VecX& v) {
    const std::vector<Mat3>& inertia = plant.workspace->inertia;
    const VecX& mass = node_mass_of(*plant.system);
    double twice = 0;
    for (int i = 0; i < mass.size(); i++) twice += mass[i] * point(v, i).squaredNorm();
    for (size_t i = 0; i < inertia.size(); i++) {
        const Vec3 rate = point(v, int(2 * i + 1));
        twice += rate.dot(inertia[i] * rate);
    }
    return 0.5 * twice;
}

static double elastic_energy(const Plant& plant, const VecX& x) {
    return mechanics(plant.which, plant.nodes->order).energy(elements_of(plant), x);
}

// What weight and forces do along a way [J].
static double work_along(const Plant& plant, const VecX& way) {
    const VecX& mass = node_mass_of(*plant.system);
    Vec3 moved = Vec3::Zero();
    for (int i = 0; i < mass.size(); i++) moved += mass[i] * point(way, i);
    const VecX& force = plant.loads.force;
    return (force.size() > 0 ? force.dot(way) : 0) + plant.loads.gravity.dot(moved);
}

// Springs that hold pins are as stiff as what cannot move.
enum class Held { BY_GRABS, BY_PINS_TOO };
// Those of pins come first.
static double spring_energy(const Plant& plant, const VecX& x, Held held) {
    const std::vector<Spring>& springs = plant.loads.springs;
    double energy = 0;
    for (size_t k = held == Held::BY_PINS_TOO ? 0 : plant.pin_springs.size(); k < springs.size(); k++)
        energy +=
            0.5 * springs[k].stiffness * (attachment_place(springs[k].attachment, x) - springs[k].target).squaredNorm();
    return energy;
}

double potential_energy(const Plant& plant, const VecX& x) {
    return elastic_energy(plant, x) - work_along(plant, x) + spring_energy(plant, x, Held::BY_PINS_TOO);
}

// The farthest way of what holds the plant [m].
static double way_of_pins(const Plant& plant) {
    const Motion& motion = plant.motion;
    const int count = int(motion.pinned.size());
    double most = 0;
    for (int i = next_pinned(motion, 0); i < count; i = next_pinned(motion, i + 1))
        if (!plant.follow || i % 2 == 0)
            most = std::max(most, (point(motion.pin_target, i) - point(plant.x_good, i)).norm());
    for (const Spring& spring : plant.pin_springs)
        most = std::max(most, (spring.target - attachment_place(spring.attachment, plant.x_good)).norm());
    return most;
}

double lifting_energy(const Plant& plant) {
    return node_mass_of(*plant.system).sum() * GRAVITY * double(plant.size);
}

EnergyLook look_at_energy(const Plant& plant, double h, double work) {
    constexpr double SHARE = 0.05;  // of what moves and strains it [-]
    constexpr double LIFT = 0.01;   // and what lifts it so far, in its sizes [-]
    constexpr double CARRIED = 2;   // and what carries all of it so many times as fast as what holds it [-]
    EnergyLook look;
    if (!plant.loads.drags.empty()) return look;
    const VecX &x = plant.motion.x, &x_good = plant.x_good;
    const double after = kinetic_in_step(plant, plant.motion.v) + elastic_energy(plant, x);
    const double speed = CARRIED * way_of_pins(plant) / h, lifting = lifting_energy(plant);
    double given = work + work_along(plant, x - x_good) + spring_energy(plant, x_good, Held::BY_GRABS) -
                   spring_energy(plant, x, Held::BY_GRABS) + 0.5 * node_mass_of(*plant.system).sum() * speed * speed;
    // The work of moments, which few nodes have, is done along the turn, not along rotation vectors.
    const VecX& force = plant.loads.force;
    for (int i = 1; plant.follow && i < force.size() / 3; i += 2)
        if (point(force, i) != Vec3::Zero())
            given += point(force, i).dot(turn_of(x, x_good, i) - (point(x, i) - point(x_good, i)));
    // Most often what it had need not be asked.
    look.is_small = after < lifting && after <= given + LIFT * lifting;
    if (look.is_small) return look;
    const double before = kinetic_in_step(plant, plant.v_good) + elastic_energy(plant, x_good);
    look.comes_from_nowhere = !(after <= before + given + SHARE * before + LIFT * lifting);
    look.is_small = before < lifting;
    return look;
}

}  // namespace frond
