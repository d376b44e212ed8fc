// Names organs after the links of a URDF file.
#include <map>
#include <set>

#include "core/error.hpp"
#include "io/urdf_pieces.hpp"
#include "skeleton/organ_clues.hpp"

namespace frond {

// Returns whether a name is a kind of organ. "grass_stem" and the like are only materials of stems.
static bool is_kind(const std::string& name) {
    return material_preset(name) && kind_of_preset(name) == name;
}

static void check(const UrdfLink& link) {
    if (!link.organ.empty() && !is_kind(link.organ))
        fail(FROND_RESULT_BAD_ARGUMENT,
             "link \"%.64s\": there is no organ \"%.64s\"; there are %s (grass_* and cereal_* as materials only)",
             link.name.c_str(), link.organ.c_str(), material_kinds().c_str());
    if (!link.organ_material.empty() && !material_preset(link.organ_material))
        fail(FROND_RESULT_BAD_ARGUMENT, "link \"%.64s\": there is no material \"%.64s\"; there are %s",
             link.name.c_str(), link.organ_material.c_str(), material_kinds().c_str());
}

static std::string kind_of(const UrdfLink& link, const std::string& material, const std::string& otherwise) {
    if (!link.organ.empty()) return link.organ;
    for (const std::string& name : {link.name, material}) {
        const NameClue clue = read_name(name);
        if (!clue.kind.empty() && !clue.species) return clue.kind;
    }
    return otherwise;
}

static const Material& material_of(const UrdfLink& link, const std::string& material, const std::string& kind) {
    if (!link.organ_material.empty()) return *material_preset(link.organ_material);
    return preset_by_names(kind, link.name, material);
}

void name_organs(const UrdfTree& tree, const std::vector<int>& link_of_part, Surface& surface,
                 std::vector<Organ>& organs) {
    for (const UrdfLink& link : tree.links) check(link);
    std::set<std::string> taken;
    for (size_t p = 0; p < surface.parts.size(); ++p) {
        const UrdfLink& link = tree.links[size_t(link_of_part[p])];
        const Part& part = surface.parts[p];
        Organ& organ = organs[size_t(part.organ)];
        organ.kind = kind_of(link, part.material, organ.kind);
        organ.why.clear();
        organ.certainty = 1;
        organ.material = material_of(link, part.material, organ.kind);
        std::string name = link.name;
        for (int i = 2; !taken.insert(name).second; ++i) name = link.name + "_" + std::to_string(i);
        organ.name = name;
    }
}

void merge_organs(const UrdfTree& tree, const std::vector<int>& link_of_part, Surface& surface, Chain& chain,
                  std::vector<Organ>& organs) {
    std::vector<Organ> merged;
    std::map<std::string, int> number_of;
    std::vector<int> number(organs.size(), 0);
    for (size_t p = 0; p < surface.parts.size(); ++p) {
        Part& part = surface.parts[p];
        const std::string& given = tree.links[size_t(link_of_part[p])].organ_name;
        Organ& organ = organs[size_t(part.organ)];
        const std::string name = given.empty() ? organ.name : given;
        const auto [known, is_new] = number_of.emplace(name, int(merged.size()));
        if (is_new) {
            merged.push_back(organ);
            merged.back().name = name;
        }
        number[size_t(part.organ)] = known->second;
        part.organ = known->second;
    }
    for (ChainNode& node : chain.nodes)
        if (node.organ >= 0) node.organ = number[size_t(node.organ)];
    organs = std::move(merged);
}

}  // namespace frond
