// Clues: what the names in a file and the shape of its triangles say about the kind of an organ.
#pragma once

#include "model/organ.hpp"

namespace frond {

struct NameClue {
    std::string kind;      // empty: the name says nothing
    bool species = false;  // only a word such as "tomato", which may mean the fruit or the whole plant
};

// What one name of a node or material says, whole words only, in the common languages of model files.
NameClue read_name(const std::string& name);
// "maize_blade", "wheat culm": grasses have stiffer stems and blades than herbs.
bool names_a_grass(const std::string& name);
// For each part its kind, or empty; node names go before material names.
std::vector<std::string> kinds_by_name(const Surface& surface);
// For each triangle whether it belongs to a sheet (a leaf, open or closed) rather than to a tube.
std::vector<char> find_sheets(const Topology& topology);

}  // namespace frond
