// Reading and setting a plant's state: energy, nodes, the force of a grab.
#include "plant/plant.hpp"

namespace frond {

frond_energy energy_of(const Plant& plant, const Vec3& gravity) {
    const VecX& mass = node_mass_of(*plant.system);
    frond_energy energy = {};
    energy.kinetic = kinetic_energy(*plant.system, plant.motion.v);
    energy.elastic = mechanics(plant.settings.mechanics).energy(elements_of(*plant.system), plant.motion.x);
    for (int i = 0; i < mass.size(); i++)
        energy.gravity -= mass[i] * gravity.dot(plant.to_world(point(plant.motion.x, i)));
    return energy;
}

Vec3 grab_force(const Plant& plant, const Grab& grab) {
    return grab.stiffness * (grab.target - vertex_position(plant, grab.vertex));
}

void set_state(Plant& plant, const double* positions, const double* velocities) {
    const Quat to_model = plant.rotation.conjugate();
    Motion& motion = plant.motion;
    for (int i = 0; i < motion.x.size() / 3; i++) {
        if (positions) point(motion.x, i) = plant.to_model(Vec3(positions + 3 * i));
        if (velocities) point(motion.v, i) = to_model * Vec3(velocities + 3 * i);
    }
    if (positions) motion.pin_target = motion.x;
    motion.history.valid = false;
    update_chain(plant);
    plant.surface_stale = true;
}

}  // namespace frond
