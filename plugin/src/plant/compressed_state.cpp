// In: a plant at rest. Out: the same in little memory, and back.
//
// Memory for steps is made anew from the model; positions are kept as differences from the modelled shape in single
// precision, or not at all if there are none.
#include "core/assert.hpp"
#include "plant/pins.hpp"

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
    const Foot& foot = *plant.input.foot;
    if (plant.input.pinned != foot.pinned || plant.input.anchor != foot.anchor ||
        plant.input.pin_target != foot.pin_target)
        return;
    drop(plant.input.pinned);
    drop(plant.input.anchor);
    drop(plant.input.pin_target);
}

}  // namespace

void compress(Plant& plant, double tolerance, bool keep_surface) {
    if (plant.state.is_compressed || !plant.state.fragments.empty()) return;
    end_modal(plant);
    plant.state.blend = nullptr;
    plant.view.lead = plant.state.stepped_by = 0;
    const VecX& modelled = elements_of(*plant.system).modelled;
    FROND_ASSERT(plant.state.motion.x.size() == modelled.size());
    const VecX moves = plant.state.motion.x - modelled;
    if (plant.state.own_elements || !(moves.lpNorm<Eigen::Infinity>() <= tolerance)) {
        plant.state.away.resize(size_t(moves.size()));
        for (size_t i = 0; i < plant.state.away.size(); i++) plant.state.away[i] = float(moves[Eigen::Index(i)]);
    }
    plant.state.is_compressed = true;
    plant.step.workspace = nullptr;
    plant.seat.leave();
    plant.state.motion = {};
    plant.state.trend = {};
    plant.step.loads = nullptr;
    plant.step.push = nullptr;
    plant.state.blown.setZero();
    plant.state.air = nullptr;
    plant.input.forces = nullptr;
    for (VecX* numbers : {&plant.step.x_good, &plant.step.v_good, &plant.view.cage_x}) drop(*numbers);
    plant.view.cage_stale = true;
    drop(plant.view.chain_positions);
    drop(plant.input.pin_springs);
    drop_foot(plant);
    if (keep_surface) return;
    drop(plant.view.surface_positions);
    drop(plant.view.surface_normals);
    if (plant.view.previous) drop(plant.view.previous->positions);
    plant.view.surface_stale = true;
}

void decompress(Plant& plant) {
    if (!plant.state.is_compressed) return;
    plant.state.is_compressed = false;
    plant.seat.take();
    plant.step.loads = std::make_unique<Loads>();
    Motion& motion = plant.state.motion;
    motion.x = motion.pin_target = elements_of(*plant.system).modelled;
    FROND_ASSERT(plant.state.away.empty() || plant.state.away.size() == size_t(motion.x.size()));
    for (size_t i = 0; i < plant.state.away.size(); i++) motion.x[Eigen::Index(i)] += double(plant.state.away[i]);
    drop(plant.state.away);
    motion.v = VecX::Zero(motion.x.size());
    motion.pinned.assign(size_t(motion.x.size() / 3), 0);
    if (plant.input.pinned.empty()) static_cast<Pins&>(plant.input) = *plant.input.foot;
    plant.input.pins_changed = true;
    apply_pins(plant);
    update_chain(plant);
}

}  // namespace frond
