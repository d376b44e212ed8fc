// Clues: what the names in a file and the shape of its triangles say about the kind of an organ.
#pragma once

#include "model/organ.hpp"

namespace frond {

struct NameClue {
    std::string kind;      // empty: the name says nothing
    bool species = false;  // only a word such as "tomato", which may mean the fruit or the whole plant
};

// The meaning of one name of a node or material, whole words only, in the common languages of model files.
NameClue read_name(const std::string& name);
// "maize_blade", "wheat culm": grasses have stiffer stems and blades than herbs.
bool names_a_grass(const std::string& name);
// "BushBerries": a round solid that stands on the ground may be foliage.
bool names_a_bush(const std::string& name);
// Tells whether names speak of a herb or a pot plant, and none of a tree: it grows to some metres at most.
bool names_a_herb(const std::vector<std::string>& names);
// For each part its kind, or empty; node names go before material names.
std::vector<std::string> kinds_by_name(const Surface& surface);
// For each triangle whether it belongs to a sheet (a leaf, open or closed) rather than to a tube.
std::vector<char> find_sheets(const Topology& topology);
// For each triangle whether it belongs to foliage that is drawn as one solid: held up by something else, or also on the
// ground where that may be.
std::vector<char> find_crowns(const Topology& topology, bool on_ground);

// The part of find_organs() that replaces materials by the caller's.
void override_materials(std::vector<Organ>& organs, const frond_organ_material* overrides, int count);

}  // namespace frond
