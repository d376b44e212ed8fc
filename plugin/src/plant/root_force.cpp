// A pinned node does not accelerate: the force that holds it is opposite to all others on it, elastic forces, those of
// taut fibres and weight. If the mechanics move the chain, nodes are pairs of a position and a rotation, and a held
// rotation is held by a moment.
#include "plant/root_force.hpp"

#include "mechanics/rotation.hpp"

namespace frond {

Wrench root_force(const Plant& plant, const Vec3& gravity, const Vec3& about) {
    const VecX& x = plant.motion.x;
    const VecX& mass = node_mass_of(*plant.system);
    const Mechanics& row = mechanics(plant.which, plant.nodes->order);
    const Vec3 centre = plant.to_model(about), weight = plant.rotation.conjugate() * gravity;
    VecX pull = VecX::Zero(x.size());
    row.add_force(elements_of(plant), x, pull);
    if (plant.fibre_force.size() == pull.size()) pull += plant.fibre_force;
    Wrench held;
    const auto hold = [&](const Vec3& force, const Vec3& place) {
        held.force += force;
        held.moment += (place - centre).cross(force);
    };
    const int pinned_count = int(plant.motion.pinned.size());
    for (int i = next_pinned(plant.motion, 0); i < pinned_count; i = next_pinned(plant.motion, i + 1)) {
        if (row.moves_chain && i % 2 == 1)
            held.moment -= inverse_rate_matrix<double>(Vec3(point(x, i))).transpose() * point(pull, i);
        else
            hold(-point(pull, i) - mass[i] * weight, point(x, i));
    }
    for (const Spring& spring : plant.pin_springs) {
        const Vec3 place = attachment_place(spring.attachment, x);
        hold(spring.stiffness * (spring.target - place), place);
    }
    return {plant.rotation * held.force, plant.rotation * held.moment};
}

}  // namespace frond
