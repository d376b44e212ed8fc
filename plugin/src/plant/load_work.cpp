// In: a plant, and the loads, start and end of its last step. Out: the work of each kind of load.
//
// The force that moves a held node is what the equation of motion lacks there:
//   R = M dv/dt - (elastic and damping forces, weight, other loads).
// The sum of R over all held nodes follows from the plant's momentum alone, as its mean over the step, however the step
// was solved. So the mean displacement of held nodes counts with that, and only what each moves beside it with its R.
#include "plant/load_work.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/rotation.hpp"
#include "plant/plant_step.hpp"
#include "solve/drags.hpp"
#include "solve/integrator.hpp"
#include "solve/springs.hpp"

namespace frond {

namespace {

Vec3 displacement(const Attachment& attachment, const Plant& plant) {
    return attachment_place(attachment, plant.state.motion.x) - attachment_place(attachment, plant.step.x_good);
}

VecX elastic_force(const Plant& plant, const VecX& x) {
    VecX force = VecX::Zero(x.size());
    mechanics(plant.which, plant.nodes->order).add_force(elements_of(plant), x, force);
    add_fibre_forces(plant, x, force);
    return force;
}

// Adds work in the air: at the end of the step each drag's force is force - damping v.
void add_air(const Plant& plant, LoadWork& work) {
    for (const Drag& drag : plant.step.loads->drags) {
        const Vec3 before = attachment_velocity(drag.attachment, plant.step.x_good, plant.step.v_good);
        const Vec3 after = attachment_velocity(drag.attachment, plant.state.motion.x, plant.state.motion.v);
        const Vec3 way = displacement(drag.attachment, plant);
        work.air += (drag.force - drag.damping * after).dot(way);
        work.air_error += 0.5 * std::abs((drag.damping * (after - before)).dot(way));
    }
}

// Returns the springs of grabs, which follow those that hold pinned nodes.
std::vector<Spring> grab_springs(const Plant& plant) {
    return {plant.step.loads->springs.begin() + long(plant.input.pin_springs.size()), plant.step.loads->springs.end()};
}

void add_grabs(const Plant& plant, LoadWork& work) {
    for (const Spring& spring : grab_springs(plant)) {
        const Vec3 before = spring.target - attachment_place(spring.attachment, plant.step.x_good),
                   after = spring.target - attachment_place(spring.attachment, plant.state.motion.x);
        work.grabs += 0.5 * spring.stiffness * (before - after).dot(before + after);
    }
}

// Returns which nodes pins hold: those that are pinned, and those that stiff springs hold for pinned cage nodes. Such a
// spring's own force would be the difference of two nearly equal places.
std::vector<uint8_t> held_nodes(const Plant& plant) {
    std::vector<uint8_t> held = plant.state.motion.pinned;
    held.resize(size_t(plant.state.motion.x.size() / 3));
    for (const Spring& spring : plant.input.pin_springs)
        for (int k = 0; k < spring.attachment.count; k++) {
            const size_t node = size_t(spring.attachment.node[size_t(k)]);
            held[node] = 1;
            if (spring.attachment.turns) held[node + 1] = 1;
        }
    return held;
}

// Returns the forces on all nodes but those that hold them and damping proportional to stiffness.
VecX forces_at_end(const Plant& plant, const VecX& elastic, double h) {
    const Motion& motion = plant.state.motion;
    const VecX& mass = node_mass_of(*plant.system);
    VecX force = elastic;
    if (plant.step.loads->force.size() > 0) force += plant.step.loads->force;
    if (is_pushed(plant)) force += plant.step.push->share / h * plant.step.push->impulse;
    add_spring_force(grab_springs(plant), motion.x, force);
    add_drag_force(plant.step.loads->drags, motion.x, motion.v, force);
    for (int i = 0; i < mass.size(); i++)
        point(force, i) +=
            mass[i] * (plant.step.loads->gravity - plant.step.settings.mass_damping * Vec3(point(motion.v, i)));
    return force;
}

// Returns the mean force on all held nodes together in the step.
Vec3 mean_holding_force(const Plant& plant, double h) {
    const Motion& motion = plant.state.motion;
    const VecX& mass = node_mass_of(*plant.system);
    const int next = plant.follow ? 2 : 1;
    Vec3 momentum = Vec3::Zero(), loads = Vec3::Zero();
    for (int i = 0; i < mass.size(); i += next) {
        momentum += mass[i] * (point(motion.v, i) - point(plant.step.v_good, i));
        loads += mass[i] * (plant.step.loads->gravity - plant.step.settings.mass_damping * Vec3(point(motion.v, i)));
        if (plant.step.loads->force.size() > 0) loads += point(plant.step.loads->force, i);
        if (is_pushed(plant)) momentum -= plant.step.push->share * point(plant.step.push->impulse, i);
    }
    for (const Spring& spring : grab_springs(plant))
        loads += spring.stiffness * (spring.target - attachment_place(spring.attachment, motion.x));
    for (const Drag& drag : plant.step.loads->drags)
        loads += drag.force - drag.damping * attachment_velocity(drag.attachment, motion.x, motion.v);
    return momentum / h - loads;
}

// Returns the mean displacement of held nodes.
Vec3 mean_way(const Plant& plant, const std::vector<uint8_t>& held, const VecX& way) {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (int i = 0; i < int(held.size()); i += plant.follow ? 2 : 1) {
        if (!held[size_t(i)]) continue;
        sum += point(way, i);
        count++;
    }
    return sum / std::max(count, 1);
}

// Elastic forces count by Simpson's rule, by how much that differs from the force halfway as error. Damping counts by
// the change of elastic forces, which turning does not feign: velocities at the end of a step are off by what stiff
// parts would damp with a multiple of all other forces. Where elements differ it counts by its mean; half of the
// largest counts as error, since the step took it from a stiffness that is not known here.
void add_pins(const Plant& plant, double h, const std::vector<uint8_t>& held, const VecX& way, LoadWork& work) {
    const VecX &x = plant.state.motion.x, &x_good = plant.step.x_good;
    const VecX elastic = elastic_force(plant, x), mean_elastic = 0.5 * (elastic + elastic_force(plant, x_good));
    const VecX off_mean = elastic_force(plant, x_good + 0.5 * way) - mean_elastic;
    const VecX& mass = node_mass_of(*plant.system);
    std::vector<double> of_element;
    double damping = damping_of(*plant.system, plant.step.settings, of_element), most = damping;
    if (!of_element.empty()) {
        const auto [low, high] = std::minmax_element(of_element.begin(), of_element.end());
        damping = 0.5 * (*low + *high);
        most = *high;
    }
    const VecX force = forces_at_end(plant, elastic, h);
    const Vec3 mean = mean_way(plant, held, way);
    work.pins += mean_holding_force(plant, h).dot(mean);
    for (int i = 0; i < int(held.size()); i++) {
        if (!held[size_t(i)]) continue;
        const bool is_turn = plant.follow && i % 2 == 1;
        const Vec3 own = is_turn ? Vec3(point(way, i)) : Vec3(point(way, i) - mean);
        const Vec3 acceleration = (point(plant.state.motion.v, i) - point(plant.step.v_good, i)) / h;
        const Vec3 elastic_change = point(elastic, i) - point(mean_elastic, i), per_second = 2 / h * elastic_change;
        const Vec3 reaction = mass[i] * acceleration - point(force, i) + elastic_change - 2.0 / 3 * point(off_mean, i) -
                              damping * per_second;
        work.pins += reaction.dot(own);
        work.error += std::abs(point(off_mean, i).dot(own)) / 3 + 0.5 * most * std::abs(per_second.dot(own));
    }
}

bool any_moves(const std::vector<uint8_t>& held, const VecX& way) {
    for (size_t i = 0; i < held.size(); i++)
        if (held[i] && !point(way, int(i)).isZero(0)) return true;
    return false;
}

// Returns the rotation of a chain node in the step [rad]; unlike the difference of rotation vectors it is one about an
// axis in space.
Vec3 rotation_in_step(const Plant& plant, int node) {
    return rotation_vector<double>(rotation_of<double>(point(plant.state.motion.x, node)) *
                                   rotation_of<double>(point(plant.step.x_good, node)).transpose());
}

// A constant force works along any way, a constant moment along a turn about one axis. Turns about several do not add
// up, which is an error of third order.
void add_forces(const Plant& plant, const VecX& way, LoadWork& work) {
    const VecX& force = plant.step.loads->force;
    if (force.size() == 0) return;
    work.forces = force.dot(way);
    for (int i = 1; plant.follow && i < way.size() / 3; i += 2) {
        if (point(force, i) == Vec3::Zero()) continue;
        const Vec3 turn = rotation_in_step(plant, i);
        work.forces += point(force, i).dot(turn - point(way, i));
        work.error += point(force, i).norm() * turn.norm() * turn.squaredNorm() / 6;
    }
}

}  // namespace

VecX way_of_step(const Plant& plant) {
    const VecX& end = plant.state.motion.x;
    return (plant.follow ? wound_as(plant.step.x_good, end) : end) - plant.step.x_good;
}

LoadWork work_of_loads(const Plant& plant, double h) {
    LoadWork work;
    const VecX way = way_of_step(plant);
    add_forces(plant, way, work);
    add_air(plant, work);
    add_grabs(plant, work);
    if (is_pushed(plant)) work.contacts = plant.step.push->share / h * plant.step.push->impulse.dot(way);
    const std::vector<uint8_t> held = held_nodes(plant);
    if (any_moves(held, way)) add_pins(plant, h, held, way, work);
    return work;
}

}  // namespace frond
