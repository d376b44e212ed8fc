// Organ names. In: names of nodes and materials as artists give them. Out: the kind of organ that they mean.
// A name is cut into words at everything that is not a letter, between letters and digits, and at camelCase; only whole
// words, their plurals and compounds whose last part is a long enough word count ("earth" is no ear, "system" no stem).
#include <algorithm>
#include <cstring>
#include <map>
#include <set>

#include "skeleton/organ_clues.hpp"

namespace frond {

using WordTable = std::map<std::string, const char*>;

// Returns the words that mean an organ, with plurals that do not end in s.
static const WordTable& organ_words() {
    static const struct {
        const char* kind;
        std::vector<const char*> words;
    } rows[] = {
        {"blade",
         {"leaf",    "lef",   "lvs",    "leaves",   "leafs",   "foliage",   "frond", "blade",  "needle",   "lamina",
          "leaflet", "husk",  "sheath", "bract",    "canopy",  "cotyledon", "grass", "blatt",  "blaetter", "blätter",
          "blatter", "nadel", "nadeln", "laub",     "feuille", "feuillage", "hoja",  "foglia", "foglie",   "folha",
          "folium",  "folia", "blad",   "bladeren", "yaprak",  "叶",        "葉",    "лист",   "листья"}},
        {"midrib", {"midrib", "rachis", "vein", "nervure", "blattrippe", "mittelrippe"}},
        {"petiole", {"petiole", "petiolule", "leafstalk", "leafstem", "blattstiel", "pétiole", "peciolo"}},
        {"stem",
         {"stem",    "stm",      "stalk", "cane", "culm",  "shoot", "haulm", "caulis", "vine",      "halm", "stengel",
          "stängel", "staengel", "stiel", "tige", "tallo", "gambo", "fusto", "caule",  "internode", "茎"}},
        {"branch", {"trunk",    "trnk",  "bark",  "wood",      "twig",   "branch", "bough",  "limb",  "log",
                    "branches", "twigs", "ast",   "aeste",     "äste",   "zweig",  "zweige", "stamm", "holz",
                    "rinde",    "borke", "tronc", "branche",   "écorce", "ecorce", "tronco", "rama",  "ramas",
                    "corteza",  "ramo",  "rami",  "corteccia", "galho",  "casca",  "stam",   "tak",   "takken",
                    "枝",       "干",    "幹",    "樹皮",      "树皮"}},
        {"peduncle",
         {"peduncle", "pedicel", "scape", "fruitstem", "flowerstem", "flowerstalk", "fruitstalk", "pédoncule", "tassel",
          "panicle"}},
        {"flower", {"flower", "flwr",    "petal", "silk",    "blossom", "bloom",  "bud",    "inflorescence", "stamen",
                    "pistil", "sepal",   "calyx", "corolla", "anther",  "stigma", "catkin", "blüte",         "bluete",
                    "blüten", "blueten", "blume", "blumen",  "fleur",   "pétale", "flor",   "flores",        "petalo",
                    "pétalo", "fiore",   "fiori", "bloem",   "bloemen", "花"}},
        {"fruit",
         {"fruit",  "frt",  "ear",     "cob",      "berry",  "berries",  "pod",     "nut",      "acorn",  "kernel",
          "grain",  "seed", "seedpod", "spikelet", "frucht", "fruechte", "früchte", "beere",    "beeren", "samen",
          "kolben", "ähre", "fruto",   "fruta",    "frutto", "frutti",   "vrucht",  "vruchten", "果"}},
        {"root",
         {"root", "rootball", "taproot", "rhizome", "tuber", "bulb", "wurzel", "wurzeln", "racine", "raiz", "raíz",
          "raices", "radice", "radici", "wortel", "wortels", "根"}},
        {"tendril", {"tendril", "ranke", "ranken", "vrille", "zarcillo", "viticcio", "cirrus"}},
        {"support", {"support", "stake",  "pot",     "flowerpot",  "plantpot", "planter", "trellis",    "soil",
                     "ground",  "dirt",   "earth",   "terrain",    "floor",    "vase",    "pole",       "post",
                     "fence",   "string", "twine",   "rope",       "wire",     "lattice", "bucket",     "tray",
                     "gravel",  "pebble", "rock",    "stone",      "sand",     "mulch",   "clay",       "container",
                     "stick",   "rod",    "ceramic", "terracotta", "concrete", "topf",    "blumentopf", "erde",
                     "boden",   "stab",   "spalier", "schnur",     "terre",    "tuteur",  "maceta",     "suelo",
                     "tierra",  "vaso",   "terra",   "terreno",    "bloempot", "grond",   "tie"}},
    };
    static const WordTable table = [] {
        WordTable made;
        for (const auto& row : rows)
            for (const char* word : row.words) made.emplace(word, row.kind);
        return made;
    }();
    return table;
}

// Returns the words that mean a fruit or a flower on a plant, or else the whole plant.
static const WordTable& species_words() {
    static const WordTable table = [] {
        WordTable made;
        for (const char* word :
             {"tomato",     "tomatoes",     "cucumber",  "corn",      "maize",      "apple",   "pear",     "plum",
              "cherry",     "cherries",     "orange",    "lemon",     "peach",      "banana",  "grape",    "melon",
              "watermelon", "pumpkin",      "squash",    "zucchini",  "pepper",     "chili",   "eggplant", "aubergine",
              "strawberry", "strawberries", "raspberry", "blueberry", "blackberry", "coconut", "mango",    "olive",
              "fig",        "tomate",       "tomaten",   "gurke",     "apfel",      "kirsche", "pomodoro", "pomme",
              "pepino",     "cone",         "bean",      "pea"})
            made.emplace(word, "fruit");
        for (const char* word : {"rose", "tulip", "sunflower", "daisy", "lily", "orchid", "poppy", "dandelion",
                                 "daffodil", "lotus", "hibiscus", "marigold", "cauliflower", "sonnenblume"})
            made.emplace(word, "flower");
        return made;
    }();
    return table;
}

// Returns whether a word belongs to the scene graph: beside it "root" is no root.
static bool is_scene_word(const std::string& word) {
    static const std::set<std::string> words = {"node",      "scene",     "model", "gltf",  "fbx",
                                                "sketchfab", "armature",  "bone",  "joint", "rig",
                                                "skeleton",  "transform", "null",  "empty", "world"};
    return words.count(word) > 0;
}

static std::vector<std::string> words_of(const std::string& name) {
    const auto is_upper = [](unsigned char c) { return c >= 'A' && c <= 'Z'; };
    const auto is_letter = [&](unsigned char c) { return is_upper(c) || (c >= 'a' && c <= 'z') || c >= 0x80; };
    std::vector<std::string> words;
    std::string word;
    for (size_t i = 0; i < name.size(); i++) {
        const auto c = static_cast<unsigned char>(name[i]);
        // A capital starts a word after a lower-case letter, and before one at the end of a run of capitals.
        const bool starts = is_upper(c) && i > 0 &&
                            (!is_upper(static_cast<unsigned char>(name[i - 1])) ||
                             (i + 1 < name.size() && name[i + 1] >= 'a' && name[i + 1] <= 'z'));
        if ((starts || !is_letter(c)) && !word.empty()) {
            words.push_back(word);
            word.clear();
        }
        if (is_letter(c)) word += is_upper(c) ? char(c - 'A' + 'a') : char(c);
    }
    if (!word.empty()) words.push_back(word);
    return words;
}

// Looks up a word in the table, as it is or in the plural.
static const char* look_up(const WordTable& table, const std::string& word) {
    const auto found = table.find(word);
    if (found != table.end()) return found->second;
    const size_t n = word.size();
    if (n > 3 && word[n - 1] == 's') {
        const auto one = table.find(word.substr(0, n - 1));
        if (one != table.end()) return one->second;
    }
    if (n > 4 && word.compare(n - 2, 2, "es") == 0) {
        const auto one = table.find(word.substr(0, n - 2));
        if (one != table.end()) return one->second;
    }
    return nullptr;
}

static bool ends_with(const std::string& word, const std::string& end) {
    return word.size() > end.size() && word.compare(word.size() - end.size(), end.size(), end) == 0;
}

// Looks up compounds ("mapleleaf", "leafmat"), and characters that are words by themselves.
static const char* look_up_compound(const std::string& word) {
    static const std::set<std::string> tails = {"mat",   "mats",   "material", "tex",     "texture", "mesh",
                                                "geo",   "group",  "grp",      "obj",     "card",    "cards",
                                                "plane", "planes", "set",      "cluster", "lod",     "shape"};
    const char* kind = nullptr;
    size_t longest = 0;
    for (const auto& [key, value] : organ_words()) {
        const bool character = key.size() == 3 && static_cast<unsigned char>(key[0]) >= 0xe3;
        bool hit = character && word.find(key) != std::string::npos;
        // Short words end too many others: "near" ends in ear, "system" in stem.
        if (!hit && key.size() >= 4 && key != "stem" && key != "post" && key != "sand" && key != "rock" &&
            key != "wire" && key != "flor" && key != "rama" && key != "tige" && key != "halm" && key != "rose")
            hit = ends_with(word, key) || (key.back() != 's' && ends_with(word, key + "s"));
        if (!hit && word.size() > key.size() && word.compare(0, key.size(), key) == 0)
            hit = tails.count(word.substr(key.size())) > 0;
        if (hit && key.size() > longest) {
            longest = key.size();
            kind = value;
        }
    }
    return kind;
}

// Returns the kind of a pair of words, or null: the stem of a leaf is a petiole, the stem of a flower or fruit a
// peduncle, the rib of a leaf its midrib.
static const char* kind_of_pair(const std::string& first, const std::string& second, const std::string& word) {
    if (second == "stem" && first == "blade") return word == "vine" || word == "shoot" ? nullptr : "petiole";
    if (second == "stem" && (first == "flower" || first == "fruit")) return "peduncle";
    if (first == "blade" && (word == "rib" || word == "ribs")) return "midrib";
    return nullptr;
}

NameClue read_name(const std::string& name) {
    const std::vector<std::string> words = words_of(name);
    std::string kind, last_word;
    bool scene = false, mixture = false;
    std::set<std::string> found;
    for (const std::string& word : words) {
        scene = scene || is_scene_word(word);
        mixture =
            mixture || word == "and" || word == "with" || word == "und" || word == "mit" || word == "y" || word == "et";
    }
    // Exact words first: the last one names the organ, those before it qualify it ("stem leaf" is a leaf).
    for (const std::string& word : words) {
        const char* hit = look_up(organ_words(), word);
        if (word == "rib" || word == "ribs") hit = kind == "blade" ? "midrib" : nullptr;
        if (!hit || (word == "root" && scene)) continue;
        found.insert(hit);
        const char* pair = kind_of_pair(kind, hit, word);
        kind = pair ? pair : hit;
    }
    if (mixture && found.size() > 1) return {};
    // The stem of a tree is its trunk.
    const auto is_tree = [](const std::string& word) { return word == "tree" || word == "baum"; };
    if (kind == "stem" && std::any_of(words.begin(), words.end(), is_tree)) kind = "branch";
    if (!kind.empty()) return {kind, false};
    for (const std::string& word : words)
        if (const char* hit = look_up(species_words(), word)) kind = hit;
    if (!kind.empty()) return {kind, true};
    for (const std::string& word : words)
        if (const char* hit = look_up_compound(word)) kind = hit;
    return {kind, false};
}

static bool has_word(const std::string& name, const std::set<std::string>& wanted) {
    const std::vector<std::string> words = words_of(name);
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
        return wanted.count(word) > 0 || (word.back() == 's' && wanted.count(word.substr(0, word.size() - 1)) > 0);
    });
}

bool names_a_grass(const std::string& name) {
    return has_word(name, {"grass", "maize", "corn", "wheat", "barley", "rye", "oat", "rice", "millet", "sorghum",
                           "reed", "bamboo", "cane", "cereal", "culm", "mais", "weizen", "gras"});
}

bool names_a_cereal(const std::string& name) {
    return has_word(name, {"wheat", "barley", "rye", "oat", "rice", "cereal", "weizen"});
}

bool names_a_bush(const std::string& name) {
    return has_word(name, {"bush", "shrub", "hedge", "busch", "strauch", "hecke", "arbusto", "arbuste", "buisson"});
}

bool names_a_herb(const std::vector<std::string>& names) {
    static const std::set<std::string> trees = {"tree", "trunk", "bark", "wood", "log",   "palm", "twig",  "bush",
                                                "pine", "oak",   "baum", "ast",  "stamm", "holz", "arbre", "bamboo"};
    static const std::set<std::string> herbs = {"flower", "tulip",     "rose",     "daisy",     "lily",  "orchid",
                                                "poppy",  "sunflower", "daffodil", "dandelion", "blume", "fern",
                                                "herb",   "wheat",     "corn",     "maize",     "crop",  "tomato",
                                                "basil",  "monstera",  "pot",      "plantpot",  "potted"};
    const auto speak_of = [&](const std::set<std::string>& words) {
        return std::any_of(names.begin(), names.end(), [&](const std::string& name) { return has_word(name, words); });
    };
    return speak_of(herbs) && !speak_of(trees);
}

// Finds words that all names have and that would make all parts pots, fruits or flowers: "FlowerPot6" is the whole
// plant.
static std::set<std::string> find_common_words(const std::vector<std::string>& names) {
    std::set<std::string> common;
    for (size_t i = 0; i < names.size(); i++) {
        const std::vector<std::string> words = words_of(names[i]);
        const std::set<std::string> own(words.begin(), words.end());
        std::set<std::string> kept;
        for (const std::string& word : i == 0 ? own : common) {
            const char* kind = look_up(organ_words(), word);
            const bool is_whole =
                kind && (!strcmp(kind, "support") || !strcmp(kind, "fruit") || !strcmp(kind, "flower"));
            if (is_whole && own.count(word)) kept.insert(word);
        }
        common = kept;
    }
    return common;
}

static std::string without(const std::string& name, const std::set<std::string>& left_out) {
    if (left_out.empty()) return name;
    std::string out;
    for (const std::string& word : words_of(name))
        if (!left_out.count(word)) out += (out.empty() ? "" : "_") + word;
    return out;
}

// Returns whether a material is named after a colour. With `with_species`, so are those named like a fruit or flower.
static bool is_color_name(const std::string& name, bool with_species) {
    static const std::set<std::string> shades = {"light", "dark", "pale", "bright", "deep", "medium"};
    static const std::set<std::string> colors = {"green", "yellow", "brown",  "red",     "blue",
                                                 "cyan",  "white",  "black",  "pink",    "purple",
                                                 "grey",  "gray",   "violet", "magenta", "beige"};
    bool has_color = false;
    for (const std::string& word : words_of(name)) {
        const bool is_color = colors.count(word) || (with_species && look_up(species_words(), word));
        if (!is_color && !shades.count(word)) return false;
        has_color = has_color || is_color;
    }
    return has_color;
}

// Returns whether materials are named after colours: "Orange" beside "Green" and "Wood" is one, and so is
// "LightOrange".
static bool has_palette(const Surface& surface) {
    return std::any_of(surface.parts.begin(), surface.parts.end(), [](const Part& part) {
        return is_color_name(part.material, false) ||
               (words_of(part.material).size() > 1 && is_color_name(part.material, true));
    });
}

bool names_many(const std::string& name) {
    static const std::set<std::string> words = {
        "leaves",   "leafs",   "lvs",     "foliage", "canopy", "grass",     "branches", "berries", "husks",    "laub",
        "blaetter", "blätter", "blatter", "nadeln",  "hojas",  "feuillage", "foglie",   "folia",   "bladeren", "zweige",
        "aeste",    "äste",    "blumen",  "bluete",  "blüten", "blueten",   "frutti",   "beeren"};
    for (const std::string& word : words_of(name)) {
        if (words.count(word)) return true;
        // A plural of an organ's name.
        if (word.size() > 3 && word.back() == 's' && !organ_words().count(word) && look_up(organ_words(), word))
            return true;
    }
    return false;
}

std::vector<std::string> kinds_by_name(const Surface& surface) {
    const size_t count = surface.parts.size();
    std::vector<std::string> kinds(count);
    std::vector<NameClue> names(count), materials(count);
    std::vector<std::string> all_names, all_materials;
    for (const Part& part : surface.parts) {
        all_names.push_back(part.name);
        all_materials.push_back(part.material);
    }
    const std::set<std::string> distinct(all_materials.begin(), all_materials.end());
    std::set<std::string> whole_names, whole_materials;
    if (count > 1) whole_names = find_common_words(all_names);
    if (distinct.size() > 1) whole_materials = find_common_words(all_materials);
    const bool palette = has_palette(surface);
    // A species that every part is named after is the whole plant, not its fruit.
    size_t species = 0, roots = 0;
    for (size_t i = 0; i < count; i++) {
        names[i] = read_name(without(all_names[i], whole_names));
        if (!palette || !is_color_name(all_materials[i], true))
            materials[i] = read_name(without(all_materials[i], whole_materials));
        species += names[i].species;
        roots += names[i].kind == "root";
    }
    for (size_t i = 0; i < count; i++) {
        // If every mesh is named "root", that is the top of a scene graph; a lone "flower", by its node or material,
        // includes its stem and leaves.
        if (names[i].kind == "root" && roots == count) names[i] = {};
        for (NameClue* clue : {&names[i], &materials[i]})
            if (count == 1 && clue->kind == "flower" && !clue->species) *clue = {};
        for (const NameClue* clue : {&names[i], &materials[i]})
            if (kinds[i].empty() && !clue->species) kinds[i] = clue->kind;
        const bool whole_plant = count == 1 || species == count;
        for (const NameClue* clue : {&names[i], &materials[i]})
            if (kinds[i].empty() && clue->species && !whole_plant) {
                // "tomato plant" is not a tomato.
                bool plant = false;
                for (const std::string& word :
                     words_of(clue == &names[i] ? surface.parts[i].name : surface.parts[i].material))
                    plant = plant || word == "plant" || word == "tree" || word == "bush" || word == "crop" ||
                            word == "field" || word == "pflanze" || word == "baum" || word == "palm";
                if (!plant) kinds[i] = clue->kind;
            }
    }
    return kinds;
}

}  // namespace frond
