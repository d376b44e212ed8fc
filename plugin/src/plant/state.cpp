// Reading and setting a plant's state: energy, nodes, the force of a grab.
#include <algorithm>

#include "core/assert.hpp"
#include "plant/pins.hpp"
#include "plant/seen.hpp"

namespace frond {

frond_energy energy_of(const Plant& plant, const Vec3& gravity) {
    const VecX& mass = node_mass_of(*plant.system);
    frond_energy energy = {};
    energy.kinetic = kinetic_energy(*plant.system, plant.state.motion.x, plant.state.motion.v);
    energy.elastic = elastic_energy(plant, plant.state.motion.x);
    for (int i = 0; i < mass.size(); i++)
        energy.gravity -= mass[i] * gravity.dot(plant.to_world(point(plant.state.motion.x, i)));
    return energy;
}

double elastic_energy(const Plant& plant, const VecX& x) {
    return mechanics(plant.which, plant.nodes->order).energy(elements_of(plant), x) + fibre_energy(plant, x);
}

double rest_time(const Plant& plant) {
    constexpr double LEAST = 0.5, MOST = 3;  // limits that a game notices [s]
    return plant.sway > 0 ? std::clamp(0.5 / plant.sway, LEAST, MOST) : MOST;
}

Spring grab_spring(const Plant& plant, const Grab& grab) {
    FROND_ASSERT(grab.vertex >= 0 && size_t(grab.vertex) < plant.model->surface.positions.size());
    FROND_ASSERT(grab.stiffness >= 0);
    return {pulled_at_vertex(plant, grab.vertex), plant.to_model(grab.target), grab.stiffness};
}

Vec3 pulled_place(const Plant& plant, int vertex) {
    if (fragment_of_vertex(plant, size_t(vertex))) return vertex_position(plant, vertex);
    return plant.to_world(attachment_place(pulled_at_vertex(plant, vertex), plant.state.motion.x));
}

Vec3 grab_force(const Plant& plant, const Grab& grab) {
    return grab.stiffness * (grab.target - pulled_place(plant, grab.vertex));
}

// Returns whether the nodes that the ground holds are where it held them when the plant was made.
static bool stands_where_made(const Plant& plant, const VecX& x) {
    constexpr double NEAR = 1e-9;  // distance over the plant's size [-]
    for (size_t n = 0; n < plant.input.foot->pinned.size(); n++)
        if (plant.input.foot->pinned[n] &&
            !((point(x, int(n)) - point(plant.input.foot->pin_target, int(n))).norm() < NEAR * double(plant.size)))
            return false;
    return true;
}

// Lets steps go on from a motion that was set.
static void go_on_anew(Plant& plant) {
    plant.state.motion.history.valid = plant.state.motion.history.shaken = false;
    end_blend(plant);
    plant.view.lead = plant.state.stepped_by = 0;
    if (plant.follow) carry_supports(plant);
    plant.input.pins_changed = true;
    apply_pins(plant);
    moved(plant);
}

void go_on_from_state(Plant& plant) {
    VecX x = cage_places(plant);
    follow_places(*plant.follow, plant.state.motion.x, x);
    plant.input.pins_are_own |= !stands_where_made(plant, x);
    plant.input.pin_target = x;
    carry_stumps(plant);
    go_on_anew(plant);
}

void set_state(Plant& plant, const double* positions, const double* velocities) {
    end_modal(plant);
    const Quat to_model = plant.rotation.conjugate();
    Motion& motion = plant.state.motion;
    VecX x, v;
    FROND_ASSERT(!plant.state.is_compressed);
    if (positions) x = cage_places(plant);
    if (velocities) v.setZero(3 * node_count_of(plant));
    for (int i = 0; i < node_count_of(plant); i++) {
        if (fragment_of_node(plant, size_t(i))) continue;  // it stays with its fragment
        if (positions) point(x, i) = plant.to_model(Vec3(positions + 3 * i));
        if (velocities) point(v, i) = to_model * Vec3(velocities + 3 * i);
    }
    if (positions) {
        plant.input.pins_are_own |= !stands_where_made(plant, x);
        plant.input.pin_target = x;
    }
    if (plant.follow) {
        if (positions) fit_chain(*plant.follow, *plant.model, x, motion.x);
        if (velocities) fit_velocities(*plant.follow, motion.x, v, motion.v);
        carry_stumps(plant);
    } else {
        if (positions) motion.x = x;
        if (velocities) motion.v = v;
    }
    go_on_anew(plant);
}

std::vector<double> plastic_of(const Plant& plant) {
    if (!plant.state.own_elements) return {};
    return mechanics(plant.which, plant.nodes->order).get_plastic(*plant.state.own_elements);
}

void set_plastic(Plant& plant, const std::vector<double>& values) {
    std::unique_ptr<Elements> own;
    if (!values.empty()) {
        const Mechanics& row = mechanics(plant.which, plant.nodes->order);
        own = row.copy(elements_of(*plant.system));
        row.set_plastic(*own, values);
    }
    if (plant.step.workspace) use_elements(*plant.step.workspace, own.get());
    plant.state.own_elements = std::move(own);
}

const Elements& elements_of(const Plant& plant) {
    return plant.state.own_elements ? *plant.state.own_elements : elements_of(*plant.system);
}

std::vector<double> capsule_strains(const Plant& plant) {
    std::vector<double> of_node, strains;
    mechanics(plant.which, plant.nodes->order).section_strains(elements_of(plant), plant.state.motion.x, of_node);
    for (const auto& [begin, end] : plant.model->capsules) strains.push_back(of_node[size_t(end)]);
    return strains;
}

int node_count_of(const Plant& plant) {
    return plant.nodes->count();
}

const VecX& cage_places(const Plant& plant) {
    const VecX& x = plant.state.motion.x;
    if (!plant.follow && !blends(plant) && plant.view.lead == 0) return x;
    if (plant.view.cage_stale) {
        if (plant.follow)
            follow_places(*plant.follow, x, plant.view.cage_x);
        else
            plant.view.cage_x = x;
        FROND_ASSERT(plant.view.cage_x.size() == 3 * node_count_of(plant));
        if (blends(plant)) add_offset(plant.state.blend->nodes, plant.view.cage_x);
        if (plant.view.lead > 0) plant.view.cage_x += plant.view.lead * cage_velocities(plant);
    }
    plant.view.cage_stale = false;
    return plant.view.cage_x;
}

Vec3 node_place(const Plant& plant, int node) {
    FROND_ASSERT(node >= 0 && node < node_count_of(plant));
    const Fragment* fragment = fragment_of_node(plant, size_t(node));
    return fragment ? fragment->place(point(fragment->cage_x, node)) : plant.to_world(point(cage_places(plant), node));
}

Vec3 node_velocity(const Plant& plant, const VecX& v, int node) {
    const Fragment* fragment = fragment_of_node(plant, size_t(node));
    return fragment ? fragment->velocity_at(node_place(plant, node)) : Vec3(plant.rotation * point(v, node));
}

VecX cage_velocities(const Plant& plant) {
    VecX velocities = plant.state.motion.v;
    if (plant.follow) follow_velocities(*plant.follow, plant.state.motion.x, plant.state.motion.v, velocities);
    if (blends(plant)) add_rate(plant.state.blend->nodes, velocities);
    return velocities;
}

void moved(Plant& plant) {
    plant.view.cage_stale = plant.view.surface_stale = true;
    update_chain(plant);
}

}  // namespace frond
