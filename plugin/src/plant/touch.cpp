#include "plant/touch.hpp"

#include "core/assert.hpp"

namespace frond {

// Attaches a point to the tets of both chain nodes; with quadratic tets, which have too many nodes, to the nearer
// node's.
static Attachment ends_attachment(const Plant& plant, int begin, int end, double along) {
    if (plant.nodes->order == 2) return chain_attachment(plant, along < 0.5 ? begin : end);
    const Attachment first = chain_attachment(plant, begin), second = chain_attachment(plant, end);
    Attachment attachment;
    const auto add = [&](const Attachment& one, double share) {
        for (size_t k = 0; k < size_t(one.count); k++) {
            attachment.node[size_t(attachment.count)] = one.node[k];
            attachment.weight[size_t(attachment.count++)] = share * one.weight[k];
        }
    };
    add(first, 1 - along);
    add(second, along);
    return attachment;
}

Attachment capsule_attachment(const Plant& plant, int capsule, double along) {
    FROND_ASSERT(capsule >= 0 && size_t(capsule) < plant.model->capsules.size());
    FROND_ASSERT(along >= 0 && along <= 1);
    const auto& [begin, end] = plant.model->capsules[size_t(capsule)];
    if (!plant.follow) return ends_attachment(plant, begin, end, along);
    Attachment attachment;
    attachment.count = begin == end ? 1 : 2;
    attachment.node = {2 * begin, 2 * end};
    attachment.weight = {begin == end ? 1 : 1 - along, along};
    return attachment;
}

Attachment cage_attachment(const ContactSide& side) {
    Attachment attachment;
    attachment.count = side.node_count;
    for (size_t i = 0; i < size_t(side.node_count); i++) {
        attachment.node[i] = side.nodes[i];
        attachment.weight[i] = side.weights[i];
    }
    return attachment;
}

bool make_touch(const Plant& plant, const Attachment& attachment, PlantTouch& touch) {
    if (!plant.step.is_sound) return false;
    touch.attachment = attachment;
    touch.velocity = velocity_of_touch(plant, touch, plant.state.motion.v);
    return true;
}

Vec3 way_of_touch(const Plant& plant, const PlantTouch& touch) {
    return plant.rotation * (attachment_place(touch.attachment, plant.state.motion.x) -
                             attachment_place(touch.attachment, plant.step.x_good));
}

VecX velocities_ahead(Plant& plant) {
    FROND_ASSERT(plant.step.workspace);
    const VecX& now = plant.state.motion.v;
    VecX change;
    if (plant.step.v_good.size() != now.size() ||
        !go_on_changing(*plant.step.workspace, plant.input.settings, now - plant.step.v_good, change))
        return now;
    return now + change;
}

Vec3 velocity_of_touch(const Plant& plant, const PlantTouch& touch, const VecX& velocities) {
    return plant.rotation * attachment_velocity(touch.attachment, plant.step.x_good, velocities);
}

bool find_compliance(Plant& plant, const Attachment& attachment, NodeCompliance& compliance) {
    FROND_ASSERT(plant.step.workspace);
    const Mat3 to_model = plant.rotation.conjugate().toRotationMatrix();
    const AttachmentDerivative derivative = derivative_at(attachment, plant.step.x_good);
    std::vector<NodeBlock> pushes;
    for (size_t k = 0; k < size_t(derivative.count); k++)
        pushes.push_back({derivative.node[k], derivative.by[k].transpose() * to_model});
    return make_compliance(*plant.step.workspace, plant.input.settings, pushes, compliance);
}

void add_impulse(const Plant& plant, const PlantTouch& touch, const Vec3& impulse, VecX& sum) {
    FROND_ASSERT(impulse.allFinite());
    if (sum.size() == 0) sum = VecX::Zero(plant.state.motion.v.size());
    add_attachment_force(touch.attachment, plant.step.x_good, plant.rotation.conjugate() * impulse, sum);
}

}  // namespace frond
