// In: a plant before and after a solve. Out: whether it gained energy that nothing can have given.
//
// One solve takes forces and stiffness at one position; if a plant turns far within the step, they have the wrong
// directions, and a stiff, light plant ends strained by many times what it was.
#include <algorithm>
#include <cmath>

#include "plant/guard.hpp"
#include "plant/plant.hpp"
#include "solve/workspace.hpp"

namespace frond {

// Returns the kinetic energy by nodal masses and the rotary inertia at the start of the step: computing that anew costs
// as much as all strains do [J].
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

// Returns the work of weight and forces along a displacement [J].
static double work_along(const Plant& plant, const VecX& way) {
    const VecX& mass = node_mass_of(*plant.system);
    Vec3 moved = Vec3::Zero();
    for (int i = 0; i < mass.size(); i++) moved += mass[i] * point(way, i);
    const VecX& force = plant.loads.force;
    return (force.size() > 0 ? force.dot(way) : 0) + plant.loads.gravity.dot(moved);
}

// Springs that hold pins are nearly rigid.
enum class Held { BY_GRABS, BY_PINS_TOO };
// Pin springs come first in the list.
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

// Returns the largest displacement of pins in the step [m].
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
    constexpr double SHARE = 0.05;  // allowed error, of kinetic and elastic energy [-]
    constexpr double LIFT = 0.01;   // and of the energy that lifts the plant by its size [-]
    constexpr double CARRIED = 2;   // speed at which moving pins may carry the plant, over their own [-]
    EnergyLook look;
    if (!plant.loads.drags.empty()) return look;
    const VecX &x = plant.motion.x, &x_good = plant.x_good;
    const double after = kinetic_in_step(plant, plant.motion.v) + elastic_energy(plant, x);
    const double speed = CARRIED * way_of_pins(plant) / h, lifting = lifting_energy(plant);
    double given = work + work_along(plant, x - x_good) + spring_energy(plant, x_good, Held::BY_GRABS) -
                   spring_energy(plant, x, Held::BY_GRABS) + 0.5 * node_mass_of(*plant.system).sum() * speed * speed;
    // The work of moments, which few nodes have, goes along the rotation, not along rotation vectors.
    const VecX& force = plant.loads.force;
    for (int i = 1; plant.follow && i < force.size() / 3; i += 2)
        if (point(force, i) != Vec3::Zero())
            given += point(force, i).dot(turn_of(x, x_good, i) - (point(x, i) - point(x_good, i)));
    // The energy before the step is seldom needed.
    look.is_small = after < lifting && after <= given + LIFT * lifting;
    if (look.is_small) return look;
    const double before = kinetic_in_step(plant, plant.v_good) + elastic_energy(plant, x_good);
    look.comes_from_nowhere = !(after <= before + given + SHARE * before + LIFT * lifting);
    look.is_small = before < lifting;
    return look;
}

}  // namespace frond
