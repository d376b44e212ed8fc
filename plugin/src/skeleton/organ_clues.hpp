// Clues to the kind of an organ, from the names in a file and the shape of its triangles.
#pragma once

#include "skeleton/organ.hpp"

namespace frond {

struct NameClue {
    std::string kind;      // empty: the name says nothing
    bool species = false;  // only a word such as "tomato", which may mean the fruit or the whole plant
};

// Interprets one name of a node or material, whole words only, in the common languages of model files.
NameClue read_name(const std::string& name);
// Return whether a name means a grass ("maize_blade", "wheat culm"), whose stems and blades are stiffer than those of
// herbs, or a small cereal, whose stems are hollow.
bool names_a_grass(const std::string& name);
bool names_a_cereal(const std::string& name);
// Returns whether a name means a bush ("BushBerries"): a round solid that stands on the ground may then be foliage.
bool names_a_bush(const std::string& name);
// Returns whether names mean a herb or a pot plant, and none a tree: it grows to some metres at most.
bool names_a_herb(const std::vector<std::string>& names);
// Returns whether a name means many organs at once ("leaves", "foliage", "twigs").
bool names_many(const std::string& name);
// Returns the kind of each part, or an empty text; node names take precedence over material names.
std::vector<std::string> kinds_by_name(const Surface& surface);
constexpr double CROWN_HEIGHT = 0.4;  // lower plants that are not named bushes have no crown [m]
// Returns for each triangle whether it belongs to foliage that is drawn as one solid: held up by something else in a
// plant of CROWN_HEIGHT or more or, with `on_ground`, also standing on the ground, in one of any height.
std::vector<char> find_crowns(const Surface& surface, const Topology& topology, bool on_ground);

// Makes parts named branches blades if they are cards beside real branches; `sheets` says which triangles are of
// sheets.
void find_cards(const Surface& surface, const Topology& topology, const std::vector<char>& sheets,
                std::vector<std::string>& named);
// Returns "stem (stem), leaf_1 (blade) ... and 12 more", for error texts.
std::string list_organs(const std::vector<Organ>& organs);

}  // namespace frond
