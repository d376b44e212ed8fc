// Writes what was found in a plant file as corrections that change nothing, to be edited.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "frond/frond_expert.h"
#include "write_corrections.hpp"

namespace frond::tools {
namespace {

// Returns by organ the organ that it grows out of; -1: the ground.
std::vector<int> find_parents(frond_model model, const frond_model_info& info) {
    frond_chain_view chain;
    must(frond_model_get_chain(model, &chain));
    std::vector<int32_t> capsule_organs(size_t(info.capsule_count));
    must(frond_model_get_capsule_organs(model, capsule_organs.data(), info.capsule_count));
    // Capsules end at nodes with a parent, in their order; of a model of one node, at that.
    std::vector<int> organ(size_t(chain.node_count), -1);
    size_t capsule = 0;
    for (int i = 0; i < chain.node_count; i++)
        if (chain.parents[i] >= 0 && capsule < capsule_organs.size()) organ[size_t(i)] = capsule_organs[capsule++];
    std::vector<int> parents(size_t(info.organ_count), -2);
    std::vector<double> way(size_t(chain.node_count), 0.0), nearest(parents.size(), INFINITY);
    for (int i = 0; i < chain.node_count; i++) {
        const int parent = chain.parents[i], own = organ[size_t(i)];
        if (parent < 0) continue;
        const double *a = chain.nodes + 3 * size_t(parent), *b = chain.nodes + 3 * size_t(i);
        way[size_t(i)] = way[size_t(parent)] + std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
        const bool on_root = chain.parents[parent] < 0;
        if (own < 0 || (!on_root && organ[size_t(parent)] == own) || way[size_t(i)] >= nearest[size_t(own)]) continue;
        nearest[size_t(own)] = way[size_t(i)];
        parents[size_t(own)] = on_root ? -1 : organ[size_t(parent)];
    }
    return parents;
}

}  // namespace

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
    const std::vector<int> parents = find_parents(model, info);
    for (size_t i = 0; i < organs.size(); i++) {
        auto& one = out["organs"][organs[i].name];
        one["kind"] = organs[i].kind;
        if (parents[i] >= 0) one["parent"] = organs[size_t(parents[i])].name;
        if (parents[i] == -1) one["root"] = true;
        one["leave_out"] = false;
        one["certainty"] = std::round(100 * organs[i].certainty) / 100;
        one["why"] = organs[i].why;
    }
    std::ofstream stream(path, std::ios::binary);
    stream << out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
    stream.close();
    if (!stream) throw SceneError(path + " cannot be written");
    return path;
}

}  // namespace frond::tools
