// In: a plant before and after a solve. Out: whether it gained energy that nothing can have given.
//
// One solve takes forces and stiffness at one position; if a plant turns far within the step, they have the wrong
// directions, and a stiff, light plant ends strained by many times what it was.
#include <algorithm>
#include <cmath>

#include "plant/guard.hpp"
#include "plant/plant.hpp"

namespace frond {

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

// Returns the work of the air along the step [J].
static double work_of_air(const Plant& plant, double h) {
    double work = 0;
    for (const Drag& drag : plant.loads.drags) {
        const Vec3 way =
            attachment_place(drag.attachment, plant.motion.x) - attachment_place(drag.attachment, plant.x_good);
        work += way.dot(drag.force - drag.damping * way / h);
    }
    return work;
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

struct EnergyLook {
    // It has more energy than it had and than forces, springs and moving pins can have given.
    bool comes_from_nowhere = false;
    // Its energy could not lift it by its size: at the start, or at the end with hardly more than it was given.
    bool is_small = false;
};
static EnergyLook look_at_energy(const Plant& plant, double h, bool is_pushed, double work) {
    // Allowed error, as shares of the energy at the start and of that which lifts the plant by its size [-]. In cages
    // the response to a push is soft. The air's work on a chain that turns is known as well as its order alone.
    const double by_air = work_of_air(plant, h);
    const bool is_lax = !plant.follow && is_pushed;
    const double share = is_lax ? 1 : 0.05, lift = is_lax ? 1 : 0.01;
    constexpr double CARRIED = 2;  // speed at which moving pins may carry the plant, over their own [-]
    EnergyLook look;
    const VecX &x = plant.motion.x, &x_good = plant.x_good;
    const double after = kinetic_energy(*plant.system, x, plant.motion.v) + elastic_energy(plant, x);
    const double speed = CARRIED * way_of_pins(plant) / h, lifting = lifting_energy(plant);
    double given = work + work_along(plant, x - x_good) + by_air + (plant.follow ? std::abs(by_air) : 0) +
                   spring_energy(plant, x_good, Held::BY_GRABS) - spring_energy(plant, x, Held::BY_GRABS) +
                   0.5 * node_mass_of(*plant.system).sum() * speed * speed;
    // The work of moments, which few nodes have, goes along the rotation, not along rotation vectors.
    const VecX& force = plant.loads.force;
    for (int i = 1; plant.follow && i < force.size() / 3; i += 2)
        if (point(force, i) != Vec3::Zero())
            given += point(force, i).dot(turn_of(x, x_good, i) - (point(x, i) - point(x_good, i)));
    // The energy before the step is seldom needed.
    look.is_small = after < lifting && after <= given + lift * lifting;
    if (look.is_small) return look;
    const double before = kinetic_energy(*plant.system, x_good, plant.v_good) + elastic_energy(plant, x_good);
    look.comes_from_nowhere = !(after <= before + given + share * before + lift * lifting);
    look.is_small = before < lifting;
    return look;
}

bool keeps_course(Plant& plant, double h, bool is_pushed, double work) {
    plant.is_off_course = ends_off_course(plant, h) || is_carried(plant.motion, plant.x_good, plant.v_good);
    const EnergyLook look = plant.is_off_course ? look_at_energy(plant, h, is_pushed, work) : EnergyLook();
    plant.is_off_course &= !look.is_small;  // too little energy for damage
    return !look.comes_from_nowhere && !has_run_away(plant);
}

}  // namespace frond
