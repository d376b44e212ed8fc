#include "plant/touch.hpp"

namespace frond {

// Both chain nodes' tets together; of quadratic ones, which have too many nodes for that, those of the nearer node.
static Grip ends_grip(const Plant& plant, int begin, int end, double along) {
    if (plant.nodes->order == 2) return chain_grip(plant, along < 0.5 ? begin : end);
    const Grip first = chain_grip(plant, begin), second = chain_grip(plant, end);
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
    if (!plant.follow) return ends_grip(plant, begin, end, along);
    Grip grip;
    grip.count = begin == end ? 1 : 2;
    grip.node = {2 * begin, 2 * end};
    grip.weight = {begin == end ? 1 : 1 - along, along};
    return grip;
}

Grip cage_grip(const ContactSide& side) {
    Grip grip;
    grip.count = side.node_count;
    for (size_t i = 0; i < size_t(side.node_count); i++) {
        grip.node[i] = side.nodes[i];
        grip.weight[i] = side.weights[i];
    }
    return grip;
}

bool make_touch(const Plant& plant, const Grip& grip, PlantTouch& touch) {
    if (!plant.is_sound) return false;
    touch.grip = grip;
    touch.velocity = plant.rotation * grip_velocity(grip, plant.x_good, plant.motion.v);
    return true;
}

bool find_answer(Plant& plant, PlantTouch& touch) {
    const Mat3 to_model = plant.rotation.conjugate().toRotationMatrix();
    const GripDerivative derivative = derivative_at(touch.grip, plant.x_good);
    std::vector<NodeBlock> pushes;
    for (size_t k = 0; k < size_t(derivative.count); k++)
        pushes.push_back({derivative.node[k], derivative.by[k].transpose() * to_model});
    return make_answer(*plant.workspace, plant.settings, pushes, touch.answer);
}

static void add_impulse(const Plant& plant, const PlantTouch& touch, const Vec3& impulse, VecX& sum) {
    if (sum.size() == 0) sum = VecX::Zero(plant.motion.v.size());
    add_grip_force(touch.grip, plant.x_good, plant.rotation.conjugate() * impulse, sum);
}

void take_impulse(Plant& plant, const PlantTouch& touch, const Vec3& impulse) {
    add_impulse(plant, touch, impulse, plant.contact_impulse);
}

void take_shift(Plant& plant, const PlantTouch& touch, const Vec3& impulse) {
    add_impulse(plant, touch, impulse, plant.contact_shift);
}

}  // namespace frond
