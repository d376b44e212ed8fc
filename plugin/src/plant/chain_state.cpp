// In: a plant whose mechanics move the chain. Out: the motion of its chain nodes and the forces in its sections, or the
// plant in a given state.
#include "plant/chain_state.hpp"

#include "mechanics/rod_elements.hpp"
#include "mechanics/rotation.hpp"

namespace frond {

std::vector<ChainNodeState> chain_state(const Plant& plant) {
    std::vector<ChainNodeState> states(plant.model->chain.nodes.size());
    const Motion& motion = plant.state.motion;
    for (size_t i = 0; i < states.size(); i++) {
        const int place = 2 * int(i), turn = place + 1;
        const Vec3 vector = point(motion.x, turn);
        ChainNodeState& state = states[i];
        state.place = plant.to_world(point(motion.x, place));
        state.rotation = plant.rotation * Quat(rotation_of<double>(vector));
        state.velocity = plant.rotation * point(motion.v, place);
        state.spin = plant.rotation * (rate_matrix<double>(vector) * point(motion.v, turn));
    }
    return states;
}

void set_chain_state(Plant& plant, const std::vector<ChainNodeState>& states) {
    end_modal(plant);
    const Quat to_model = plant.rotation.conjugate();
    Motion& motion = plant.state.motion;
    for (size_t i = 0; i < states.size(); i++) {
        if (fragment_of_chain_node(plant, i)) continue;  // it stays with its fragment
        const int place = 2 * int(i), turn = place + 1;
        const ChainNodeState& state = states[i];
        const Vec3 vector = rotation_vector<double>((to_model * state.rotation).toRotationMatrix());
        point(motion.x, place) = plant.to_model(state.place);
        point(motion.x, turn) = vector;
        point(motion.v, place) = to_model * state.velocity;
        point(motion.v, turn) = inverse_rate_matrix<double>(vector) * (to_model * state.spin);
    }
    go_on_from_state(plant);
}

std::vector<SectionForce> section_forces(const Plant& plant) {
    const RodElements& elements = as_rods(elements_of(plant));
    const std::vector<RodSectionForce> of_segment = rod_section_forces(elements, plant.state.motion.x);
    std::vector<int> segment_of(plant.model->chain.nodes.size(), -1);
    for (size_t s = 0; s < of_segment.size(); s++)
        if (!elements.segments[s].closes_loop) segment_of[size_t(elements.segments[s].b)] = int(s);
    std::vector<SectionForce> forces;
    for (const auto& [begin, end] : plant.model->capsules) {
        SectionForce force = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
        const int s = segment_of[size_t(end)];
        if (s >= 0) {
            const RodSectionForce& found = of_segment[size_t(s)];
            force = {plant.rotation * found.axis, plant.rotation * found.thin, plant.rotation * found.force,
                     plant.rotation * found.moment};
        }
        forces.push_back(force);
    }
    return forces;
}

}  // namespace frond
