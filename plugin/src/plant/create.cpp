// A plant at rest in its place, with its root held.
#include <map>
#include <mutex>
#include <tuple>

#include "plant/plant.hpp"

namespace frond {

// One System for all plants of a model, a mechanics and a mass, for as long as one of them lives.
static std::shared_ptr<const System> shared_system(const std::shared_ptr<const Model>& model, frond_mechanics which,
                                                   frond_mass mass) {
    static std::mutex mutex;
    static std::map<std::tuple<const Model*, frond_mechanics, frond_mass>, std::weak_ptr<const System>> systems;
    std::lock_guard<std::mutex> lock(mutex);
    for (auto entry = systems.begin(); entry != systems.end();)
        entry = entry->second.expired() ? systems.erase(entry) : std::next(entry);
    auto& known = systems[{model.get(), which, mass}];
    std::shared_ptr<const System> system = known.lock();
    if (!system) known = system = make_system(model, which, mass);
    return system;
}

static void pin_below(const Model& model, double height, std::vector<uint8_t>& pinned) {
    const double limit = model.surface.lower().y() + height;
    for (size_t i = 0; i < model.cage.nodes.size(); i++) pinned[i] = model.cage.nodes[i].y() < limit;
}

std::unique_ptr<Plant> create_plant(std::shared_ptr<const Model> model, const frond_plant_def& def) {
    auto plant = std::make_unique<Plant>();
    const int node_count = int(model->cage.nodes.size());
    plant->system = shared_system(model, def.mechanics, def.mass);
    plant->workspace = make_workspace(plant->system);
    plant->settings.mechanics = def.mechanics;
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

    // At rest as modelled.
    Motion& motion = plant->motion;
    motion.x.resize(3 * node_count);
    for (int i = 0; i < node_count; i++) point(motion.x, i) = model->cage.nodes[size_t(i)];
    motion.v = VecX::Zero(3 * node_count);
    motion.pin_target = motion.x;
    motion.pinned.assign(size_t(node_count), 0);
    if (def.root_height > 0)
        pin_below(*model, def.root_height, motion.pinned);
    else if (def.root_height == 0)
        motion.pinned = model->root;

    plant->user_force = VecX::Zero(3 * node_count);
    plant->loads.force = VecX::Zero(3 * node_count);
    plant->model = std::move(model);
    update_chain(*plant);
    update_surface(*plant, FROND_ALL_EFFECTS);
    return plant;
}

}  // namespace frond
