// In: a plant at rest. Out: the same in little memory, and back.
//
// Memory for steps is made anew from the model; positions are kept as differences from the modelled shape in single
// precision, or not at all if there are none.
#include "plant/plant.hpp"

#include "core/assert.hpp"

namespace frond {

namespace {

template <class T>
void drop(std::vector<T>& list) {
    std::vector<T>().swap(list);
}
void drop(VecX& numbers) {
    VecX().swap(numbers);
}

// Drops what all plants on the same foot share.
void drop_foot(Plant& plant) {
    const Foot& foot = *plant.foot;
    if (plant.pinned != foot.pinned || plant.anchor != foot.anchor || plant.pin_target != foot.pin_target) return;
    drop(plant.pinned);
    drop(plant.anchor);
    drop(plant.pin_target);
}

}  // namespace

void compress(Plant& plant, double tolerance, bool keep_surface) {
    if (plant.is_compressed || !plant.fragments.empty()) return;
    end_modal(plant);
    plant.blend_out = {};
    plant.lead = plant.stepped_by = 0;
    const VecX& modelled = elements_of(*plant.system).modelled;
    FROND_ASSERT(plant.motion.x.size() == modelled.size());
    const VecX moves = plant.motion.x - modelled;
    if (plant.own_elements || !(moves.lpNorm<Eigen::Infinity>() <= tolerance)) {
        plant.away.resize(size_t(moves.size()));
        for (size_t i = 0; i < plant.away.size(); i++) plant.away[i] = float(moves[Eigen::Index(i)]);
    }
    plant.is_compressed = true;
    plant.workspace = nullptr;
    plant.seat.leave();
    plant.motion = {};
    plant.trend = {};
    plant.loads = {};
    plant.blown.setZero();
    plant.air = nullptr;
    for (VecX* numbers : {&plant.x_good, &plant.v_good, &plant.contact_impulse, &plant.contact_correction,
                          &plant.user_force, &plant.chain_load, &plant.cage_x})
        drop(*numbers);
    plant.cage_stale = true;
    drop(plant.chain_positions);
    drop(plant.pin_springs);
    drop_foot(plant);
    if (keep_surface) return;
    drop(plant.surface_positions);
    drop(plant.surface_normals);
    if (plant.previous) drop(plant.previous->positions);
    plant.surface_stale = true;
}

void decompress(Plant& plant) {
    if (!plant.is_compressed) return;
    plant.is_compressed = false;
    plant.seat.take();
    Motion& motion = plant.motion;
    motion.x = motion.pin_target = elements_of(*plant.system).modelled;
    FROND_ASSERT(plant.away.empty() || plant.away.size() == size_t(motion.x.size()));
    for (size_t i = 0; i < plant.away.size(); i++) motion.x[Eigen::Index(i)] += double(plant.away[i]);
    drop(plant.away);
    motion.v = VecX::Zero(motion.x.size());
    motion.pinned.assign(size_t(motion.x.size() / 3), 0);
    if (plant.pinned.empty()) {
        plant.pinned = plant.foot->pinned;
        plant.anchor = plant.foot->anchor;
        plant.pin_target = plant.foot->pin_target;
    }
    plant.pins_changed = true;
    apply_pins(plant);
    update_chain(plant);
}

}  // namespace frond
