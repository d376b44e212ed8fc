#include "plant/touch.hpp"

namespace frond {

// Both chain nodes' tets together; of quadratic ones, which have too many nodes for that, those of the nearer node.
static Grip cage_grip(const Plant& plant, int begin, int end, double along) {
    const Embedding& embedding = plant.model->chain_embedding;
    const auto place = [&](int node) {
        return place_in_tet(*plant.nodes, plant.model->cage.tets, embedding.tet[size_t(node)],
                            embedding.weights[size_t(node)]);
    };
    if (plant.nodes->order == 2) return tet_grip(place(along < 0.5 ? begin : end));
    const Grip first = tet_grip(place(begin)), second = tet_grip(place(end));
    Grip grip;
    const auto add = [&](const Grip& one, double share) {
        for (size_t k = 0; k < size_t(one.count); k++) {
            grip.node[size_t(grip.count)] = one.node[k];
            grip.weight[size_t(grip.count++)] = share * one.weight[k];
        }
    };
    add(first, 1 - along);
    add(second, along);
    return grip;
}

Grip capsule_grip(const Plant& plant, int capsule, double along) {
    const auto& [begin, end] = plant.model->capsules[size_t(capsule)];
    if (!plant.follow) return cage_grip(plant, begin, end, along);
    Grip grip;
    grip.count = begin == end ? 1 : 2;
    grip.node = {2 * begin, 2 * end};
    grip.weight = {begin == end ? 1 : 1 - along, along};
    return grip;
}

bool make_touch(Plant& plant, const Grip& grip, PlantTouch& touch) {
    if (!plant.is_sound) return false;
    touch.grip = grip;
    const Mat3 to_model = plant.rotation.conjugate().toRotationMatrix();
    VecX impulse(plant.motion.v.size());
    for (int axis = 0; axis < 3; axis++) {
        impulse.setZero();
        add_grip_force(grip, plant.x_good, to_model.col(axis), impulse);
        VecX& answer = touch.answers[size_t(axis)];
        if (!respond(*plant.workspace, plant.settings, impulse, answer)) return false;
    }
    touch.velocity = plant.rotation * grip_velocity(grip, plant.x_good, plant.motion.v);
    return true;
}

Mat3 answer_at(const Plant& plant, const Grip& grip, const PlantTouch& touch) {
    const Mat3 to_world = plant.rotation.toRotationMatrix();
    Mat3 block;
    for (int axis = 0; axis < 3; axis++)
        block.col(axis) = to_world * grip_velocity(grip, plant.x_good, touch.answers[size_t(axis)]);
    return block;
}

void take_impulse(Plant& plant, const PlantTouch& touch, const Vec3& impulse) {
    if (plant.contact_impulse.size() == 0) plant.contact_impulse = VecX::Zero(plant.motion.v.size());
    add_grip_force(touch.grip, plant.x_good, plant.rotation.conjugate() * impulse, plant.contact_impulse);
}

}  // namespace frond
