// Organs: the parts of a plant that have a name, a kind and a material.
#pragma once

#include <string>

#include "frond/frond.h"
#include "skeleton/topology.hpp"

namespace frond {

using Material = frond_material;

struct Organ {
    std::string name;  // "leaf_3"; unique in a model
    std::string kind;  // a row of the table in materials.cpp: "stem", "blade" ...
    Material material = {};
    bool young_given = false, midrib_given = false;  // by the caller, who knows better than margins and hidden ribs
    std::string why = {};                            // what speaks for its kind
    double certainty = 1;  // 0: another kind is as likely, 1: nothing speaks for another one [-]
    double opacity = 1;    // share of its surface that textures do not cut out [-]
};

// Returns published values by kind; null if there is no such kind.
const Material* material_preset(const std::string& kind);
// Returns the kind that a preset is for: "stem" for "grass_stem", which is a material of stems only.
std::string kind_of_preset(const std::string& preset);
// Returns a kind's preset, that of a family of plants where names of the part or of its material tell one.
const Material& preset_by_names(const std::string& kind, const std::string& name, const std::string& material);
// Returns the preset that an organ's material is, of a family or of its kind; its kind's where it is none.
std::string preset_of(const Organ& organ);
// Returns "stem, petiole, blade ...", for error texts.
std::string material_kinds();
// Fails with BAD_ARGUMENT, naming `who`, unless every number is finite and in range.
void check_material(const Material& material, const std::string& who);

// Returns whether an organ is a sheet: a blade or a flower.
bool is_sheet(const Organ& organ);
// Returns the largest thickness of an organ that is all tissue [m]. Artists draw leaves thicker than they are: what is
// drawn between two faces farther apart holds air. What is no sheet fills what is drawn.
double solid_thickness(const Organ& organ);

// Finds organs: a part whose node is named after one is that organ; others are cut into sheets, tubes and solids, which
// votes of shape, place, name, material, colour and texture tell to be leaves, stems, fruits ... (organ_votes.cpp).
// Sets Part::organ and splits parts that hold several organs: triangles are then reordered, in the surface and in the
// topology alike. Parts of several materials may share an organ.
std::vector<Organ> find_organs(Surface& surface, Topology& topology);

}  // namespace frond
