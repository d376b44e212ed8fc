// Materials that plants of some families have instead of their kind's: "grass_stem" instead of "stem".
#include <algorithm>
#include <iterator>

#include "skeleton/organ_clues.hpp"
#include "skeleton/organ_correct.hpp"

namespace frond {

namespace {

struct Family {
    std::string prefix;
    bool (*is_named)(const std::string& name);
};
// The narrower ones first.
const Family FAMILIES[] = {{"cereal_", names_a_cereal}, {"grass_", names_a_grass}};

bool are_equal(const Material& a, const Material& b) {
    return std::all_of(std::begin(MATERIAL_FIELDS), std::end(MATERIAL_FIELDS),
                       [&](const MaterialField& field) { return a.*field.field == b.*field.field; });
}

}  // namespace

std::string kind_of_preset(const std::string& preset) {
    for (const Family& family : FAMILIES)
        if (preset.compare(0, family.prefix.size(), family.prefix) == 0) return preset.substr(family.prefix.size());
    return preset;
}

const Material& preset_by_names(const std::string& kind, const std::string& name, const std::string& material) {
    for (const Family& family : FAMILIES)
        if (family.is_named(name) || family.is_named(material))
            if (const Material* own = material_preset(family.prefix + kind)) return *own;
    return *material_preset(kind);
}

std::string preset_of(const Organ& organ) {
    for (const Family& family : FAMILIES) {
        const Material* own = material_preset(family.prefix + organ.kind);
        if (own && are_equal(*own, organ.material)) return family.prefix + organ.kind;
    }
    return organ.kind;
}

}  // namespace frond
