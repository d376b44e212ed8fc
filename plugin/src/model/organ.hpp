// Organs: the parts of a plant that have a name, a kind and a material.
#pragma once

#include <string>

#include "frond/frond.h"
#include "model/topology.hpp"

namespace frond {

using Material = frond_material;

struct Organ {
    std::string name;  // "leaf_3"; unique in a model
    std::string kind;  // a row of the table in materials.cpp: "stem", "blade" ...
    Material material = {};
    bool material_given = false;  // given by the caller, not a preset
};

// Returns published values by kind; null if there is no such kind.
const Material* material_preset(const std::string& kind);
// Returns "stem, petiole, blade ...", for error texts.
std::string material_kinds();
// Fails with BAD_ARGUMENT, naming `who`, unless every number is finite and in range.
void check_material(const Material& material, const std::string& who);

// Identifies organs by node and material names, and by shape where the names say nothing (thin open sheets are blades,
// tubes are stems). Sets Part::organ and splits parts that hold several kinds: triangles are then reordered, in the
// surface and in the topology alike. `overrides` replace materials by organ name or kind, the last match wins; an
// override that matches no organ is an error that names the existing organs.
std::vector<Organ> find_organs(Surface& surface, Topology& topology, const frond_organ_material* overrides,
                               int override_count);

}  // namespace frond
