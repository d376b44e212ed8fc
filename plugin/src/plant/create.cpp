// Creation of a plant at rest in its place, with its root held, and changes of its mechanics.
#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>

#include "calibration/calibration.hpp"
#include "calibration/sway_frequency.hpp"
#include "core/assert.hpp"
#include "core/convert.hpp"
#include "plant/pins.hpp"
#include "plant/seen.hpp"
#include "plant/settings.hpp"
#include "plant/touch.hpp"

namespace frond {

// Values that all plants of a model share, found again for as long as one of them lives.
template <class Key, class Value>
struct Shared {
    std::mutex mutex;
    std::map<Key, std::weak_ptr<const Value>> known;
    template <class Make>
    std::shared_ptr<const Value> find_or_make(const Key& key, Make&& make) {
        std::lock_guard<std::mutex> lock(mutex);
        for (auto entry = known.begin(); entry != known.end();)
            entry = entry->second.expired() ? known.erase(entry) : std::next(entry);
        std::weak_ptr<const Value>& place = known[key];
        std::shared_ptr<const Value> value = place.lock();
        if (!value) place = value = make();
        return value;
    }
};

// Data that all plants of one model and mechanics share.
struct SharedSystem {
    std::shared_ptr<const System> system;
    double full_damping;  // see full_damping(); 0 if no organ has a damping ratio [s]
    double sway;          // frequency of the slowest mode; 0: none [Hz]
    std::shared_ptr<WorkspacePool> pool;
};

static std::shared_ptr<const SharedSystem> shared_system(const std::shared_ptr<const Model>& model,
                                                         frond_mechanics which, frond_mass mass, int order) {
    static Shared<std::tuple<const Model*, frond_mechanics, frond_mass, int>, SharedSystem> systems;
    return systems.find_or_make({model.get(), which, mass, order}, [&] {
        ensure_rest_shape(*model, which, order);
        SharedSystem shared = {make_system(model, which, mass, order), 0, sway_frequency(model),
                               std::make_shared<WorkspacePool>()};
        const std::vector<Organ>& organs = model->organs;
        if (std::any_of(organs.begin(), organs.end(), [](const Organ& o) { return o.material.damping_ratio > 0; }))
            shared.full_damping = full_damping(*shared.system, which, order);
        return std::make_shared<const SharedSystem>(std::move(shared));
    });
}

// A value made from a model, which it keeps alive so that no other model at the same address is taken for it.
template <class Value>
struct OfModel {
    std::shared_ptr<const Model> model;
    Value value;
};
// Returns the one value of a model and order of its elements.
template <class Value, class Make>
static std::shared_ptr<const Value> shared_of(const std::shared_ptr<const Model>& model, int order, Make&& make) {
    static Shared<std::pair<const Model*, int>, OfModel<Value>> values;
    const auto shared = values.find_or_make({model.get(), order}, [&] {
        return std::make_shared<const OfModel<Value>>(OfModel<Value>{model, make()});
    });
    return std::shared_ptr<const Value>(shared, &shared->value);
}

std::shared_ptr<const Sheath> sheath_of(const Plant& plant) {
    return shared_of<Sheath>(plant.model, 1, [&] { return make_sheath(*plant.model); });
}

std::shared_ptr<const SheathInCage> sheath_in_cage_of(const Plant& plant) {
    constexpr int CAGE_ITSELF = 0;  // among orders
    if (!touches_by_sheath(plant))
        return shared_of<SheathInCage>(plant.model, CAGE_ITSELF, [&] { return cage_as_sheath(*plant.model); });
    return shared_of<SheathInCage>(plant.model, plant.nodes->order,
                                   [&] { return make_sheath_in_cage(*plant.model, *plant.nodes); });
}

std::shared_ptr<const AirPieces> air_pieces_of(const Plant& plant) {
    return shared_of<AirPieces>(plant.model, plant.nodes->order, [&] { return make_air_pieces(*plant.model); });
}

std::shared_ptr<const ModalBasis> modal_basis_of(const Plant& plant) {
    return shared_of<ModalBasis>(plant.model, 1, [&] {
        const auto rods = shared_system(plant.model, FROND_MECHANICS_ROD, FROND_MASS_LUMPED, 1);
        return make_modal_basis(*rods->system, *air_pieces_of(plant));
    });
}

static std::shared_ptr<const Follow> shared_follow(const Plant& plant) {
    const CageNodes& nodes = *plant.nodes;
    return shared_of<Follow>(plant.model, nodes.order,
                             [&] { return make_follow(*plant.model, nodes, nodes.modelled); });
}

const std::shared_ptr<const Marks>& marks_of(const Plant& plant) {
    FROND_ASSERT(!plant.follow);
    if (!plant.view.marks)
        plant.view.marks = shared_of<Marks>(plant.model, plant.nodes->order,
                                            [&] { return make_marks(*plant.model, shared_follow(plant)); });
    return plant.view.marks;
}

// Returns null if the cage needs no fibres.
static std::shared_ptr<const Fibres> shared_fibres(const Plant& plant) {
    const CageNodes& nodes = *plant.nodes;
    const auto fibres =
        shared_of<Fibres>(plant.model, nodes.order, [&] { return make_fibres(*plant.model, nodes, nodes.modelled); });
    return fibres->list.empty() ? nullptr : fibres;
}

static CageNodes make_nodes(const Cage& cage, int order) {
    CageNodes nodes = {make_tet_nodes(int(cage.nodes.size()), cage.tets, order), {}};
    nodes.modelled = node_places(nodes, [&](int i) { return cage.nodes[size_t(i)]; });
    return nodes;
}

void take_mechanics(Plant& plant, frond_mechanics which) {
    plant.which = which;
    const CageNodes& nodes = *plant.nodes;
    const std::shared_ptr<const SharedSystem> shared = shared_system(plant.model, which, plant.input.mass, nodes.order);
    // Workspaces in the pool keep their system alive, so the system must not keep the pool.
    plant.step.workspace = nullptr;
    plant.system = shared->system;
    plant.seat.leave();
    plant.seat.pool = std::shared_ptr<WorkspacePool>(shared, shared->pool.get());
    plant.seat.take();
    plant.input.settings.full_damping = plant.input.material_damping * shared->full_damping;
    plant.sway = shared->sway;
    plant.state.own_elements = nullptr;
    plant.follow = nullptr;
    plant.state.modal = nullptr;
    end_blend(plant);
    plant.view.lead = plant.state.stepped_by = 0;
    plant.fibres = nullptr;
    plant.state.fibre_give.clear();
    plant.state.stretched = 0;
    if (!mechanics(which).moves_chain && mechanics(which).turns) plant.fibres = shared_fibres(plant);
    if (mechanics(which).moves_chain) plant.follow = shared_follow(plant);
    const VecX& start = elements_of(*plant.system).modelled;
    plant.state.motion = {};
    plant.state.motion.x = plant.state.motion.pin_target = start;
    plant.state.motion.v = VecX::Zero(start.size());
    *plant.step.loads = {};
    plant.state.blown.setZero();
    plant.state.motion.pinned.assign(size_t(start.size() / 3), 0);
    plant.input.pins_changed = plant.view.cage_stale = true;
    plant.state.substeps = 1;
    FROND_ASSERT(start.size() == 3 * elements_of(*plant.system).node_count);
    FROND_ASSERT(!plant.follow || plant.follow->attachments.size() == size_t(nodes.count()));
}

// Finds the cage nodes that the ground holds; a node between two corners is held if both are.
static std::vector<uint8_t> find_held(const Plant& plant, double root_height) {
    const Model& model = *plant.model;
    std::vector<uint8_t> held(model.cage.nodes.size(), 0);
    const double limit = model.surface.lower().y() + root_height;
    if (root_height > 0)
        for (size_t i = 0; i < held.size(); i++) held[i] = model.cage.nodes[i].y() < limit;
    else if (root_height == 0)
        held = model.root;
    return with_middles(*plant.nodes, held);
}

// Finds the chain nodes that hold pinned cage nodes: for each the nearest one that the ground holds.
static std::vector<int> find_anchors(const Plant& plant, const std::vector<uint8_t>& pinned, double limit) {
    const std::vector<ChainNode>& nodes = plant.model->chain.nodes;
    std::vector<int> anchor(pinned.size(), 0);
    for (size_t n = 0; n < pinned.size(); n++) {
        if (plant.follow) anchor[n] = plant.follow->nearest[n];
        if (!pinned[n]) continue;
        double least = INFINITY;
        for (size_t i = 0; i < nodes.size(); i++) {
            const double distance = (nodes[i].position - point(plant.nodes->modelled, int(n))).norm();
            if ((nodes[i].parent >= 0 && nodes[i].position.y() >= limit) || distance >= least) continue;
            least = distance;
            anchor[n] = int(i);
        }
    }
    return anchor;
}

static std::shared_ptr<const Foot> foot_of(const Plant& plant, double root_height) {
    static Shared<std::tuple<const Model*, int, bool, double>, OfModel<Foot>> feet;
    const auto shared =
        feet.find_or_make({plant.model.get(), plant.nodes->order, bool(plant.follow), root_height}, [&] {
            Foot foot;
            foot.root_height = root_height;
            foot.pinned = find_held(plant, root_height);
            foot.pin_target = cage_places(plant);
            const double limit = root_height > 0 ? plant.model->surface.lower().y() + root_height : -INFINITY;
            foot.anchor = find_anchors(plant, foot.pinned, limit);
            return std::make_shared<const OfModel<Foot>>(OfModel<Foot>{plant.model, std::move(foot)});
        });
    return std::shared_ptr<const Foot>(shared, &shared->value);
}

std::unique_ptr<Plant> create_plant(std::shared_ptr<const Model> model, const frond_plant_def& def) {
    auto plant = std::make_unique<Plant>();
    plant->model = std::move(model);
    plant->size = float(plant->model->surface.size());
    plant->nodes = shared_of<CageNodes>(plant->model, def.element_order,
                                        [&] { return make_nodes(plant->model->cage, def.element_order); });
    each_setting(def, plant->input, [](const auto& given, auto& kept) { kept = given; });
    plant->input.effects = def.effects;
    plant->input.collision = plant->model->has_own_tets ? FROND_COLLISION_CAGE : def.collision;
    plant->position = to_vec(def.position);
    plant->rotation = to_quat(def.rotation).normalized();
    plant->input.user = def.user;

    // At rest as modelled, held by the ground.
    take_mechanics(*plant, def.mechanics);
    plant->input.foot = foot_of(*plant, def.root_height);
    static_cast<Pins&>(plant->input) = *plant->input.foot;
    plant->input.stands_on_roots = def.root_height == 0;
    FROND_ASSERT(plant->size > 0);
    FROND_ASSERT(std::abs(plant->rotation.norm() - 1) < 1e-9);
    FROND_ASSERT(plant->input.pinned.size() == size_t(node_count_of(*plant)) &&
                 plant->input.anchor.size() == plant->input.pinned.size());
    FROND_ASSERT(plant->input.pin_target.size() == 3 * node_count_of(*plant));
    apply_pins(*plant);
    moved(*plant);
    return plant;
}

frond_plant_def def_of(const Plant& plant) {
    frond_plant_def def = {};
    def.cookie = FROND_DEF_COOKIE('P');
    def.position = from_vec(plant.position);
    def.rotation = from_quat(plant.rotation);
    def.mechanics = plant.which;
    def.element_order = plant.nodes->order;
    each_setting(def, plant.input, [](auto& given, const auto& kept) { given = kept; });
    def.root_height = plant.input.foot->root_height;
    def.effects = plant.input.effects;
    def.collision = plant.input.collision;
    def.user = plant.input.user;
    return def;
}

void set_mechanics(Plant& plant, frond_mechanics which, bool smoothly) {
    if (which == plant.which) return;
    end_modal(plant);
    const bool by_modes = smoothly && sways_on_its_roots(plant);
    const Seen seen = smoothly ? seen_of(plant) : Seen();
    const bool blended = smoothly && blends(plant);
    // What an earlier change left to blend out is no part of the shape; taken for one, it would never end.
    if (smoothly) end_blend(plant);
    const Seen own = blended ? seen_of(plant) : seen;
    const VecX places = cage_places(plant), rates = cage_velocities(plant);
    if (by_modes && plant.follow) keep_only_modes(plant);
    VecX smooth = cage_places(plant);
    const VecX smooth_rate = cage_velocities(plant);
    place_pinned_as_held(plant, smooth);
    const StoredEnergy held = stored_energy(plant);
    const bool pins_moved = miss_of_pins(plant) > PINS_STAND * double(plant.size);
    // Plastic states carry over between mechanics of tets, and between those of the chain.
    const bool keeps = mechanics(which).moves_chain == mechanics(plant.which).moves_chain;
    const std::vector<double> plastic = keeps ? plastic_of(plant) : std::vector<double>();
    const Vec3 gravity = plant.step.loads->gravity;
    take_mechanics(plant, which);
    plant.step.loads->gravity = gravity;
    Motion& motion = plant.state.motion;
    if (!plant.follow) {
        motion.x = smooth;
        motion.v = smooth_rate;
    } else if (smoothly) {
        motion.x = own.chain;
        motion.v = chain_rate(own);
    } else {
        fit_chain(*plant.follow, *plant.model, places, motion.x);
        fit_velocities(*plant.follow, motion.x, rates, motion.v);
    }
    if (by_modes && plant.follow) keep_only_modes(plant);
    leave_fragments(plant);
    set_plastic(plant, plastic);
    relax(plant, held, pins_moved);
    apply_pins(plant);
    moved(plant);
    if (smoothly) blend_from(plant, seen);
}

}  // namespace frond
