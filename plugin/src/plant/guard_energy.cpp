// In: a plant before and after a solve. Out: whether energy came out of nothing.
//
// One solve takes forces and stiffness of one place; where a plant turns far within the step they point elsewhere, and a
// stiff, light one ends strained by many times what it was.
#include <algorithm>
#include <cmath>

#include "mechanics/rotation.hpp"
#include "plant/guard.hpp"
#include "plant/plant.hpp"

namespace frond {

// Of every so many nodes from the first on.
static double farthest(const VecX& x, const VecX& from, int first, int next) {
    double most = 0;
    for (int i = first; i < x.size() / 3; i += next) {
        const double way = (point(x, i) - point(from, i)).squaredNorm();
        if (!(way <= most)) most = std::isnan(way) ? INFINITY : way;
    }
    return std::sqrt(most);
}

// Of a chain's node, whose rotation vector turns back by 2 pi where it has turned by more than pi [rad].
static Vec3 turn_of(const VecX& x, const VecX& from, int node) {
    return rotation_vector<double>(rotation_of<double>(point(x, node)) * rotation_of<double>(point(from, node)).transpose());
}

double farthest_way(const Plant& plant) {
    return farthest(plant.motion.x, plant.x_good, 0, plant.follow ? 2 : 1);
}

bool ends_off_course(const Plant& plant, double h) {
    constexpr double FAR = 0.02;        // over the plant's size [-]
    constexpr double TURNED_FAR = 0.2;  // [rad]
    const VecX &x = plant.motion.x, &x_good = plant.x_good, &v_good = plant.v_good;
    const double far = std::pow(FAR * double(plant.size), 2), turned_far = plant.follow ? TURNED_FAR * TURNED_FAR : far;
    if ((x - x_good - h * v_good).squaredNorm() < std::min(far, turned_far)) return false;  // all together even
    for (int i = 0; i < x.size() / 3; i++) {
        const double off = (point(x, i) - point(x_good, i) - h * point(v_good, i)).squaredNorm();
        if (off < (i % 2 ? turned_far : far)) continue;
        const bool turns = plant.follow && i % 2;
        if (!turns || !((turn_of(x, x_good, i) - h * point(v_good, i)).squaredNorm() < turned_far)) return true;
    }
    return false;
}

double reach_at_start(const Plant& plant) {
    return farthest(plant.x_good, elements_of(*plant.system).modelled, 0, plant.follow ? 2 : 1);
}

StepEnergy energy_at(const Plant& plant, const VecX& x, const VecX& v, Held held) {
    const System& system = *plant.system;
    const Loads& loads = plant.loads;
    const VecX& mass = node_mass_of(system);
    const double own = kinetic_energy(system, x, v) + mechanics(plant.which, plant.nodes->order).energy(elements_of(plant), x);
    double loaded = own - loads.force.dot(x);
    for (int i = 0; i < mass.size(); i++) loaded -= mass[i] * loads.gravity.dot(point(x, i));
    // Those of pins come first.
    for (size_t k = held == Held::BY_PINS_TOO ? 0 : plant.pin_springs.size(); k < loads.springs.size(); k++)
        loaded += 0.5 * loads.springs[k].stiffness * (grip_place(loads.springs[k].grip, x) - loads.springs[k].target).squaredNorm();
    return {own, loaded};
}

// The farthest way of what holds the plant [m].
static double way_of_pins(const Plant& plant) {
    const Motion& motion = plant.motion;
    const int next = plant.follow ? 2 : 1;
    double most = 0;
    for (int i = 0; i < int(motion.pinned.size()); i += next)
        if (motion.pinned[size_t(i)]) most = std::max(most, (point(motion.pin_target, i) - point(plant.x_good, i)).norm());
    for (const Spring& spring : plant.pin_springs)
        most = std::max(most, (spring.target - grip_place(spring.grip, plant.x_good)).norm());
    return most;
}

bool has_gained_energy(const Plant& plant, double h) {
    constexpr double SHARE = 0.05;  // of what moves and strains it [-]
    constexpr double LIFT = 0.01;   // and what lifts it so far, in its sizes [-]
    constexpr double CARRIED = 2;   // and what carries all of it so many times as fast as what holds it [-]
    if (!plant.loads.drags.empty() || plant.is_touched) return false;
    const StepEnergy before = energy_at(plant, plant.x_good, plant.v_good, Held::BY_GRABS);
    const StepEnergy after = energy_at(plant, plant.motion.x, plant.motion.v, Held::BY_GRABS);
    const double mass = node_mass_of(*plant.system).sum(), speed = CARRIED * way_of_pins(plant) / h;
    double given = 0.5 * mass * speed * speed + LIFT * mass * GRAVITY * double(plant.size);
    for (int i = 1; plant.follow && i < plant.motion.x.size() / 3; i += 2)
        given += point(plant.loads.force, i)
                     .dot(turn_of(plant.motion.x, plant.x_good, i) - (point(plant.motion.x, i) - point(plant.x_good, i)));
    return !(after.loaded <= before.loaded + SHARE * before.own + given);
}

}  // namespace frond
