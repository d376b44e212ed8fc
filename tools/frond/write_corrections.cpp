// Writes what was found in a plant file as corrections that change nothing, to be edited.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "write_corrections.hpp"

namespace frond::tools {

std::string write_corrections(frond_model model, const std::string& file) {
    const std::string path = std::filesystem::path(file).replace_extension(".frond.json").string();
    if (std::filesystem::exists(path))
        throw SceneError(path + " is there already, and may hold somebody's corrections; move it away first");
    frond_model_info info;
    must(frond_model_get_info(model, &info));
    nlohmann::ordered_json out;
    out["unit"] = info.scale;
    out["up"] = {info.up.x, info.up.y, info.up.z};
    std::vector<frond_organ> organs(size_t(info.organ_count));
    for (int i = 0; i < info.organ_count; i++) must(frond_model_get_organ(model, i, &organs[size_t(i)]));
    for (const frond_organ& organ : organs) {
        auto& one = out["organs"][organ.name];
        one["kind"] = organ.kind;
        if (organ.parent >= 0) one["parent"] = organs[size_t(organ.parent)].name;
        // An organ within another one's capsules grows out of nothing, and does not stand on the ground.
        if (organ.parent < 0 && organ.capsule_count > 0) one["root"] = true;
        one["leave_out"] = false;
        one["certainty"] = std::round(100 * organ.certainty) / 100;
        one["why"] = organ.why;
    }
    std::ofstream stream(path, std::ios::binary);
    stream << out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
    stream.close();
    if (!stream) throw SceneError(path + " cannot be written");
    return path;
}

}  // namespace frond::tools
