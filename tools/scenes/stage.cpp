// The stage: world, models and plants of a running scene, and where their files are.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "scenes/scene.hpp"

namespace frond::tools {

Stage::Stage(const Settings& given) : settings(given) {
    if (settings.threads > 1) {
        team = std::make_unique<Team>(settings.threads);
        settings.world.parallel_for = Team::parallel_for;
        settings.world.parallel_user = team.get();
    }
    must(frond_world_create(&settings.world, &world));
    const frond_vec3& wind = settings.wind.velocity;
    if (wind.x == 0 && wind.y == 0 && wind.z == 0) return;
    const frond_result blown = frond_world_set_wind(world, &settings.wind);
    if (blown != FROND_OK) frond_world_destroy(world);
    must(blown);
}

Stage::~Stage() {
    frond_world_destroy(world);
    for (frond_model model : models) frond_model_destroy(model);
}

// Returns materials by organ name: the model's, with the fields that were set for the organ or its kind, of which the
// last one wins, and Young's modulus times the requested factor.
static std::map<std::string, frond_material> changed_materials(frond_model model, const Settings& settings) {
    const std::vector<Settings::OrganOverride>& overrides = settings.organs;
    frond_model_info info;
    must(frond_model_get_info(model, &info));
    std::map<std::string, frond_material> materials;
    std::vector<char> used(overrides.size(), 0);
    std::string names;
    for (int i = 0; i < info.organ_count; i++) {
        frond_organ organ;
        must(frond_model_get_organ(model, i, &organ));
        names += std::string(i ? ", " : "") + organ.name;
        if (settings.stiffness != 1) materials.emplace(organ.name, organ.material);
        for (size_t k = 0; k < overrides.size(); k++) {
            if (overrides[k].organ != organ.name && overrides[k].organ != organ.kind) continue;
            materials.emplace(organ.name, organ.material).first->second.*overrides[k].field = overrides[k].value;
            used[k] = 1;
        }
    }
    for (size_t k = 0; k < overrides.size(); k++)
        if (!used[k]) throw SceneError("no organ is called \"" + overrides[k].organ + "\"; there are " + names);
    for (auto& [organ, material] : materials) material.young *= settings.stiffness;
    return materials;
}

frond_model Stage::load(const std::string& path) {
    frond_model model = {};
    must(frond_model_load(path.c_str(), &settings.model, &model));
    if (!settings.organs.empty() || settings.stiffness != 1) {
        // The organs' kinds are known now; load the model again with their materials.
        std::map<std::string, frond_material> materials;
        try {
            materials = changed_materials(model, settings);
        } catch (...) {
            frond_model_destroy(model);
            throw;
        }
        frond_model_destroy(model);
        std::vector<frond_organ_material> list;
        for (const auto& [organ, material] : materials) list.push_back({organ.c_str(), material});
        frond_model_def def = settings.model;
        def.organs = list.data();
        def.organ_count = int(list.size());
        must(frond_model_load(path.c_str(), &def, &model));
    }
    return keep(model);
}

frond_model Stage::keep(frond_model model) {
    models.push_back(model);
    return model;
}

frond_plant Stage::plant(frond_model model, frond_vec3 position, double turn) {
    frond_plant_def def = settings.plant;
    def.position = position;
    if (turn != 0) def.rotation = {0, std::sin(turn / 2), 0, std::cos(turn / 2)};
    frond_plant plant = {};
    must(frond_plant_create(world, model, &def, &plant));
    frond_model_info info;
    must(frond_model_get_info(model, &info));
    const auto grow = [&](double& low, double& high, double a, double b) {
        low = plants.empty() ? a : std::min(low, a);
        high = plants.empty() ? b : std::max(high, b);
    };
    // Box around the turned box.
    const double c = std::cos(turn), s = std::sin(turn);
    const double middle_x = (info.lower.x + info.upper.x) / 2, half_x = (info.upper.x - info.lower.x) / 2;
    const double middle_z = (info.lower.z + info.upper.z) / 2, half_z = (info.upper.z - info.lower.z) / 2;
    const double x = position.x + c * middle_x + s * middle_z, z = position.z - s * middle_x + c * middle_z;
    const double wide = std::abs(c) * half_x + std::abs(s) * half_z, deep = std::abs(s) * half_x + std::abs(c) * half_z;
    grow(lower.x, upper.x, x - wide, x + wide);
    grow(lower.y, upper.y, position.y + info.lower.y, position.y + info.upper.y);
    grow(lower.z, upper.z, z - deep, z + deep);
    plants.push_back(plant);
    places.push_back(position);
    plant_models.push_back(model);
    return plant;
}

bool Stage::sees(size_t plant) const {
    constexpr double BESIDE = 6;  // [m]
    const frond_vec3 &p = places[plant], &a = view_lower, &b = view_upper;
    return !has_view || (p.x > a.x - BESIDE && p.x < b.x + BESIDE && p.z > a.z - BESIDE && p.z < b.z + BESIDE);
}

frond_rigid Stage::rigid(const frond_rigid_def& def) {
    frond_rigid rigid = {};
    must(frond_rigid_create(world, &def, &rigid));
    rigid_defs.push_back(def);
    rigids.push_back(rigid);
    return rigid;
}

std::string model_path(const std::string& name) {
    std::vector<std::string> folders;
    if (const char* folder = std::getenv("FROND_MODELS")) folders.push_back(folder);
    std::error_code none;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
    folders.push_back((program.parent_path() / FROND_MODELS_FROM_PROGRAM).string());
#ifdef FROND_MODELS_BUILD_PATH
    folders.push_back(FROND_MODELS_BUILD_PATH);
#endif
    for (const std::string& folder : folders) {
        const std::filesystem::path path = std::filesystem::path(folder) / name;
        if (std::filesystem::exists(path)) return path.string();
    }
    throw SceneError(name + " is not where models are; set FROND_MODELS to the folder models/ of Frond");
}

}  // namespace frond::tools
