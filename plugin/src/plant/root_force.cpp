// The force that holds a node is what its motion takes, mass times acceleration, less all others on it: elastic and
// damping forces, those of taut fibres and weight. If the mechanics move the chain, nodes are pairs of a position and a
// rotation, and a held rotation is held by a moment.
#include "plant/root_force.hpp"

#include "mechanics/rotation.hpp"
#include "plant/pins.hpp"
#include "plant/plant_step.hpp"
#include "solve/guides.hpp"
#include "solve/integrator.hpp"

namespace frond {

// Velocities at the end of the last step, and accelerations over it, of held nodes.
struct HeldMotion {
    VecX v;             // [m/s]
    VecX acceleration;  // [m/s^2]; empty: none
};
static HeldMotion motion_of_held(const Plant& plant) {
    const Motion& motion = plant.state.motion;
    HeldMotion out = {motion.v, {}};
    const bool is_known = plant.state.stepped_by > 0 && plant.step.v_good.size() == motion.v.size();
    if (!is_known || !is_carried(motion, plant.step.x_good, plant.step.v_good)) return out;
    out.acceleration = (motion.v - plant.step.v_good) / plant.state.stepped_by;
    // Methods of stages leave the mean velocity over the step.
    const Integrator& method = integrator(plant.input.settings.integrator);
    const int count = int(motion.pinned.size());
    if (method.has_stages && !method.looks_back)
        for (int i = next_pinned(motion, 0); i < count; i = next_pinned(motion, i + 1))
            point(out.v, i) += 0.5 * plant.state.stepped_by * point(out.acceleration, i);
    return out;
}

// Adds damping forces at velocities v, as a step would have them, to f [N].
static void add_damping_force(const Plant& plant, const SolveSettings& settings, const VecX& v, VecX& f) {
    const System& system = *plant.system;
    const Elements& elements = elements_of(plant);
    for (int i = 0; i < elements.node_count; ++i)
        point(f, i) -= settings.mass_damping * node_mass_of(system)[i] * point(v, i);
    std::vector<double> of_element;
    const double damping = damping_of(system, settings, of_element);
    if (damping == 0) return;
    BlockMatrix K, D;
    for (BlockMatrix* matrix : {&K, &D}) {
        matrix->set_pattern(elements.pattern);
        matrix->set_zero();
    }
    VecX elastic = VecX::Zero(v.size()), product;
    if (of_element.empty())
        system.row->add_stiffness(elements, plant.state.motion.x, Tangent::positive, damping, D);
    else
        system.row->add_force_stiffness_and_damping(elements, plant.state.motion.x, of_element, elastic, K, D);
    D.multiply(v, product);
    f -= product;
}

// Returns all forces on nodes but weight and what accelerates them [N].
static VecX forces_on_nodes(const Plant& plant, frond_effects effects, const VecX& v) {
    VecX pull = VecX::Zero(plant.state.motion.x.size());
    plant.system->row->add_force(elements_of(plant), plant.state.motion.x, pull);
    add_fibre_forces(plant, plant.state.motion.x, pull);
    if (v.size() == pull.size() && !v.isZero(0)) add_damping_force(plant, settings_for(plant, effects), v, pull);
    return pull;
}

// Forces on the nodes of a chain or a cage that hold them.
struct HoldingForces {
    const Plant& plant;
    Vec3 weight;  // acceleration, model frame [m/s^2]
    HeldMotion motion;
    VecX pull;  // on all nodes, but of what holds them [N]

    HoldingForces(const Plant& plant, const Vec3& gravity, frond_effects effects)
        : plant(plant),
          weight(plant.rotation.conjugate() * gravity),
          motion(motion_of_held(plant)),
          pull(forces_on_nodes(plant, plant.input.effects & effects, motion.v)) {}
    bool is_turn(int node) const { return plant.system->row->moves_chain && node % 2 == 1; }
    // Returns the force on a pinned place.
    Vec3 on_place(int node) const {
        const double mass = node_mass_of(*plant.system)[node];
        Vec3 force = -point(pull, node) - mass * weight;
        if (motion.acceleration.size() > 0) force += mass * point(motion.acceleration, node);
        return force;
    }
    // Returns the moment on a rotation, of which a part is held.
    Vec3 on_turn(int node, const Mat3& held = Mat3::Identity()) const {
        const Vec3 turn = point(plant.state.motion.x, node);
        return -inverse_rate_matrix<double>(turn).transpose() * (held * point(pull, node));
    }
    Vec3 on_guided(const Guide& guide) const {
        return on_turn(guide.node, held_part(guide, point(plant.state.motion.x, guide.node)));
    }
};

Wrench root_force(const Plant& plant, const Vec3& gravity, frond_effects effects, const Vec3& about) {
    const Motion& motion = plant.state.motion;
    const Vec3 centre = plant.to_model(about);
    const HoldingForces forces(plant, gravity, effects);
    Wrench held;
    const auto hold = [&](const Vec3& force, const Vec3& place) {
        held.force += force;
        held.moment += (place - centre).cross(force);
    };
    const int pinned_count = int(motion.pinned.size());
    for (int i = next_pinned(motion, 0); i < pinned_count; i = next_pinned(motion, i + 1)) {
        if (forces.is_turn(i))
            held.moment += forces.on_turn(i);
        else
            hold(forces.on_place(i), point(motion.x, i));
    }
    for (const Guide& guide : guides_of(plant)) held.moment += forces.on_guided(guide);
    for (const Spring& spring : plant.input.pin_springs) {
        const Vec3 place = attachment_place(spring.attachment, motion.x);
        hold(spring.stiffness * (spring.target - place), place);
    }
    return {plant.rotation * held.force, plant.rotation * held.moment};
}

Wrench support_force(const Plant& plant, const Vec3& gravity, frond_effects effects, int chain_node) {
    const Motion& motion = plant.state.motion;
    const HoldingForces forces(plant, gravity, effects);
    const int place = 2 * chain_node, turn = place + 1;
    Wrench held;
    if (motion.pinned[size_t(place)]) held.force = plant.rotation * forces.on_place(place);
    if (motion.pinned[size_t(turn)]) held.moment = plant.rotation * forces.on_turn(turn);
    for (const Guide& guide : guides_of(plant))
        if (guide.node == turn) held.moment = plant.rotation * forces.on_guided(guide);
    return held;
}

}  // namespace frond
