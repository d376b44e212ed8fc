// In: what the host asked for: forces, grabs, springs of pins. Out: the loads of a step, in the model's frame.
#include "plant/chain_state.hpp"
#include "plant/pins.hpp"
#include "plant/plant_step.hpp"

namespace frond {

Vec3 gravity_in(const Plant& plant, const Surroundings& surroundings, frond_effects effects) {
    return effects & FROND_EFFECT_GRAVITY ? Vec3(plant.rotation.conjugate() * surroundings.gravity)
                                          : Vec3(Vec3::Zero());
}

void gather_loads(Plant& plant, const Surroundings& surroundings, frond_effects effects) {
    const Quat to_model = plant.rotation.conjugate();
    Loads& loads = *plant.step.loads;
    loads.gravity = gravity_in(plant, surroundings, effects);
    loads.springs = plant.input.pin_springs;
    loads.guides = &guides_of(plant);
    loads.force.resize(0);
    loads.fibres = nullptr;
    if (!(effects & FROND_EFFECT_USER_FORCE)) return;

    if (plant.input.has_user_force) {
        const Mat3 turn = to_model.toRotationMatrix();
        loads.force.setZero(plant.state.motion.x.size());
        gather_chain_loads(plant, loads.force);
        const VecX& given = plant.input.forces->on_nodes;
        for (int i = 0; i < given.size() / 3; i++) {
            const Vec3 force = turn * point(given, i);
            if (force.isZero(0)) continue;
            add_attachment_force(pulled_at_node(plant, i), plant.state.motion.x, force, loads.force);
        }
    }
    for (const Grab& grab : plant.input.grabs)
        if (!fragment_of_vertex(plant, size_t(grab.vertex))) loads.springs.push_back(grab_spring(plant, grab));
}

HostForces& forces_of(Plant& plant) {
    if (!plant.input.forces) plant.input.forces = std::make_unique<HostForces>();
    return *plant.input.forces;
}

void clear_user_force(Plant& plant) {
    if (!plant.input.has_user_force) return;
    plant.input.forces->on_nodes.setZero();
    plant.input.forces->on_chain.setZero();
    plant.input.has_user_force = false;
}

}  // namespace frond
