// A plant at rest in its place, with its root held.
#include <map>
#include <mutex>
#include <tuple>

#include "build/build.hpp"
#include "plant/plant.hpp"

namespace frond {

// What all plants of a model share, found again for as long as one of them lives.
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

static std::shared_ptr<const System> shared_system(const std::shared_ptr<const Model>& model, frond_mechanics which,
                                                   frond_mass mass) {
    static Shared<std::tuple<const Model*, frond_mechanics, frond_mass>, System> systems;
    return systems.find_or_make({model.get(), which, mass}, [&] {
        ensure_rest_shape(*model, which);
        return make_system(model, which, mass);
    });
}

// Keeps its model alive, so that another one at the same address is not taken for it.
struct FollowOfModel {
    std::shared_ptr<const Model> model;
    Follow follow;
};

static std::shared_ptr<const Follow> shared_follow(const std::shared_ptr<const Model>& model) {
    static Shared<const Model*, FollowOfModel> follows;
    const auto shared = follows.find_or_make(model.get(), [&] {
        return std::make_shared<const FollowOfModel>(FollowOfModel{model, make_follow(*model)});
    });
    return std::shared_ptr<const Follow>(shared, &shared->follow);
}

static void take_mechanics(Plant& plant, frond_mechanics which) {
    plant.which = which;
    plant.system = shared_system(plant.model, which, plant.mass);
    plant.workspace = make_workspace(plant.system);
    plant.follow = mechanics(which).moves_chain ? shared_follow(plant.model) : nullptr;
    const VecX& start = elements_of(*plant.system).modelled;
    plant.motion = {};
    plant.motion.x = plant.motion.pin_target = start;
    plant.motion.v = plant.loads.force = VecX::Zero(start.size());
    plant.motion.pinned.assign(size_t(start.size() / 3), 0);
    plant.pins_changed = plant.cage_stale = true;
}

// The chain nodes that hold pinned cage nodes: of those that the ground holds, the nearest one at the foot.
static void find_anchors(Plant& plant, double limit) {
    const std::vector<ChainNode>& nodes = plant.model->chain.nodes;
    plant.anchor.assign(plant.pinned.size(), 0);
    for (size_t n = 0; n < plant.pinned.size(); n++) {
        if (plant.follow) plant.anchor[n] = plant.follow->nearest[n];
        if (!plant.pinned[n]) continue;
        double least = INFINITY;
        for (size_t i = 0; i < nodes.size(); i++) {
            const double distance = (nodes[i].position - plant.model->cage.nodes[n]).norm();
            if ((nodes[i].parent >= 0 && nodes[i].position.y() >= limit) || distance >= least) continue;
            least = distance;
            plant.anchor[n] = int(i);
        }
    }
}

static void pin_below(const Model& model, double height, std::vector<uint8_t>& pinned) {
    const double limit = model.surface.lower().y() + height;
    for (size_t i = 0; i < model.cage.nodes.size(); i++) pinned[i] = model.cage.nodes[i].y() < limit;
}

std::unique_ptr<Plant> create_plant(std::shared_ptr<const Model> model, const frond_plant_def& def) {
    auto plant = std::make_unique<Plant>();
    const size_t node_count = model->cage.nodes.size();
    plant->model = std::move(model);
    plant->mass = def.mass;
    plant->settings.integrator = def.integrator;
    plant->settings.linear_solver = def.linear_solver;
    plant->settings.newton_iterations = def.newton_iterations;
    plant->settings.newton_tolerance = def.newton_tolerance;
    plant->settings.max_iterations = def.max_iterations;
    plant->settings.tolerance = def.tolerance;
    plant->settings.mass_damping = def.mass_damping;
    plant->settings.stiffness_damping = def.stiffness_damping;
    plant->settings.spectral_radius = def.spectral_radius;
    plant->effects = def.effects;
    plant->position = Vec3(def.position.x, def.position.y, def.position.z);
    plant->rotation = Quat(def.rotation.w, def.rotation.x, def.rotation.y, def.rotation.z).normalized();
    plant->user = def.user;
    plant->user_force = VecX::Zero(3 * Eigen::Index(node_count));

    // At rest as modelled, held by the ground.
    take_mechanics(*plant, def.mechanics);
    plant->pinned.assign(node_count, 0);
    if (def.root_height > 0)
        pin_below(*plant->model, def.root_height, plant->pinned);
    else if (def.root_height == 0)
        plant->pinned = plant->model->root;
    plant->stands_on_roots = def.root_height == 0;
    plant->pin_target = cage_places(*plant);
    find_anchors(*plant, def.root_height > 0 ? plant->model->surface.lower().y() + def.root_height : -INFINITY);
    apply_pins(*plant);
    moved(*plant);
    update_surface(*plant, FROND_ALL_EFFECTS);
    return plant;
}

void set_mechanics(Plant& plant, frond_mechanics which) {
    if (which == plant.which) return;
    const VecX places = cage_places(plant), velocities = cage_velocities(plant);
    take_mechanics(plant, which);
    if (plant.follow) {
        fit_chain(*plant.follow, *plant.model, places, plant.motion.x);
        fit_velocities(*plant.follow, plant.motion.x, velocities, plant.motion.v);
    } else {
        plant.motion.x = places;
        plant.motion.v = velocities;
    }
    apply_pins(plant);
    moved(plant);
}

}  // namespace frond
