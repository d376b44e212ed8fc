// Organ finding. In: a surface with parts, its topology and the caller's materials. Out: organs with names, kinds and
// materials; every part belongs to one of them.
#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "core/error.hpp"
#include "model/organ_clues.hpp"

namespace frond {

constexpr double TREE_HEIGHT = 3;  // higher plants are held by wood [m]

// Returns whether a part has the border of a sheet, at least as long as itself; a tube is closed or ends in rings.
static bool has_border(const Topology& topology, const Part& part) {
    std::map<std::array<int, 2>, int> uses;
    Vec3 lower = Vec3::Constant(INFINITY), upper = -lower;
    for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++)
        for (size_t k = 0; k < 3; k++) {
            const int a = topology.triangles[size_t(t)][k], b = topology.triangles[size_t(t)][(k + 1) % 3];
            uses[{std::min(a, b), std::max(a, b)}]++;
            lower = lower.cwiseMin(topology.points[size_t(a)]);
            upper = upper.cwiseMax(topology.points[size_t(a)]);
        }
    double border = 0;
    for (const auto& [edge, count] : uses)
        if (count == 1) border += (topology.points[size_t(edge[1])] - topology.points[size_t(edge[0])]).norm();
    return border >= (upper - lower).norm();
}

// Finds twigs drawn as cards with leaves on them: parts named branches that are nearly all sheets, if other branches
// are not. Makes them blades.
static void find_cards(const Surface& surface, const Topology& topology, const std::vector<char>& sheets,
                       std::vector<std::string>& named) {
    constexpr double NEARLY_ALL = 0.9;
    std::vector<char> is_card(named.size(), 0);
    bool has_wood = false;
    for (size_t i = 0; i < named.size(); i++) {
        const Part& part = surface.parts[i];
        if (named[i] != "branch" || part.triangle_count == 0) continue;
        const auto first = sheets.begin() + part.first_triangle;
        is_card[i] = std::count(first, first + part.triangle_count, 1) >= NEARLY_ALL * part.triangle_count &&
                     has_border(topology, part);
        has_wood = has_wood || !is_card[i];
    }
    for (size_t i = 0; i < named.size(); i++)
        if (has_wood && is_card[i]) named[i] = "blade";
}

static bool is_green(const std::array<float, 4>& color) {
    return color[1] > 1.1f * color[0] && color[1] > 1.3f * color[2];
}

// Makes unnamed green parts of a plant with wood blades: they are foliage, however solid they were drawn.
static void find_foliage(const Surface& surface, std::vector<std::string>& named) {
    if (std::find(named.begin(), named.end(), "branch") == named.end()) return;
    for (size_t i = 0; i < named.size(); i++) {
        const Part& part = surface.parts[i];
        const bool has_color = part.texture < 0 && part.color != Part().color;
        if (named[i].empty() && has_color && is_green(part.color)) named[i] = "blade";
    }
}

// Returns a kind for every triangle: by the names of its part, else by colour and shape.
static std::vector<std::string> kinds_of_triangles(const Surface& surface, const Topology& topology) {
    std::vector<std::string> named = kinds_by_name(surface);
    std::vector<std::string> kinds(surface.triangles.size());
    const auto is_open = [](const std::string& kind) { return kind.empty() || kind == "branch"; };
    std::vector<char> sheets;
    if (std::any_of(named.begin(), named.end(), is_open)) {
        sheets = find_sheets(topology);
        find_cards(surface, topology, sheets, named);
        find_foliage(surface, named);
    }
    const bool is_bush = std::any_of(surface.parts.begin(), surface.parts.end(), [](const Part& part) {
        return names_a_bush(part.name) || names_a_bush(part.material);
    });
    const std::vector<char> crowns = find_crowns(topology, is_bush);
    const std::string tube = surface.height() > TREE_HEIGHT ? "branch" : "stem";
    for (size_t i = 0; i < surface.parts.size(); i++) {
        const Part& part = surface.parts[i];
        for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++)
            if (crowns[size_t(t)] && (named[i].empty() || named[i] == "blade"))
                kinds[size_t(t)] = "crown";
            else
                kinds[size_t(t)] = !named[i].empty() ? named[i] : sheets[size_t(t)] ? "blade" : tube;
    }
    return kinds;
}

template <typename T>
static void reorder(std::vector<T>& values, const std::vector<int>& order) {
    std::vector<T> moved(values.size());
    for (size_t i = 0; i < order.size(); i++) moved[i] = values[size_t(order[i])];
    values.swap(moved);
}

// Splits each part into runs of one kind, in the order in which the kinds first appear. Returns the kind of each new
// part.
static std::vector<std::string> split_parts(Surface& surface, Topology& topology,
                                            const std::vector<std::string>& kinds) {
    std::vector<int> order(surface.triangles.size());
    std::iota(order.begin(), order.end(), 0);
    std::vector<Part> parts;
    std::vector<std::string> part_kinds;
    bool moved = false;
    for (const Part& part : surface.parts) {
        const auto begin = order.begin() + part.first_triangle, end = begin + part.triangle_count;
        auto from = begin;
        do {
            const std::string kind = from == end ? "stem" : kinds[size_t(*from)];
            const auto to = std::stable_partition(from, end, [&](int t) { return kinds[size_t(t)] == kind; });
            moved = moved || to != end;
            parts.push_back(part);
            parts.back().first_triangle = int(from - order.begin());
            parts.back().triangle_count = int(to - from);
            part_kinds.push_back(kind);
            from = to;
        } while (from != end);
    }
    surface.parts = std::move(parts);
    if (!moved) return part_kinds;
    // The topology must list the same triangles in the same order.
    reorder(surface.triangles, order);
    reorder(topology.triangles, order);
    reorder(topology.triangle_component, order);
    reorder(topology.turned, order);
    std::vector<int> place(order.size());
    for (size_t i = 0; i < order.size(); i++) place[size_t(order[i])] = int(i);
    for (Joint& joint : topology.joints) {
        joint.triangle_a = place[size_t(joint.triangle_a)];
        joint.triangle_b = place[size_t(joint.triangle_b)];
    }
    return part_kinds;
}

// Makes one organ per part, with the part's own name if no other part has it, else its kind and a number that is still
// free.
static std::vector<Organ> name_organs(Surface& surface, const std::vector<std::string>& kinds) {
    std::multiset<std::string> given;
    for (const Part& part : surface.parts) given.insert(part.name);
    std::set<std::string> taken(given.begin(), given.end());
    std::vector<Organ> organs;
    std::vector<std::pair<std::string, int>> counters;
    for (size_t i = 0; i < surface.parts.size(); i++) {
        Part& part = surface.parts[i];
        std::string name = part.name;
        if (name.empty() || given.count(name) > 1) {
            auto counter = std::find_if(counters.begin(), counters.end(), [&](auto& c) { return c.first == kinds[i]; });
            if (counter == counters.end()) counter = counters.insert(counters.end(), {kinds[i], 0});
            do name = kinds[i] + "_" + std::to_string(++counter->second);
            while (!taken.insert(name).second);
        }
        part.organ = int(organs.size());
        const bool grass = names_a_grass(part.name) || names_a_grass(part.material);
        const Material* grass_material = grass ? material_preset("grass_" + kinds[i]) : nullptr;
        organs.push_back({name, kinds[i], grass_material ? *grass_material : *material_preset(kinds[i])});
    }
    return organs;
}

// Returns "stem (stem), leaf_1 (blade) ... and 12 more".
static std::string list_organs(const std::vector<Organ>& organs) {
    std::string text;
    for (size_t i = 0; i < organs.size(); i++) {
        if (i == 30) return text + " and " + std::to_string(organs.size() - i) + " more";
        text += (i ? ", " : "") + organs[i].name + " (" + organs[i].kind + ")";
    }
    return text;
}

void override_materials(std::vector<Organ>& organs, const frond_organ_material* overrides, int count) {
    if (count < 0 || (count > 0 && !overrides))
        fail(FROND_RESULT_BAD_ARGUMENT, "organ_count is %d but organs is %s; give an array of that many", count,
             overrides ? "an array" : "null");
    for (int i = 0; i < count; i++) {
        const frond_organ_material& wanted = overrides[i];
        if (!wanted.organ || !*wanted.organ)
            fail(FROND_RESULT_BAD_ARGUMENT, "organs[%d].organ is empty; give the name or the kind of an organ", i);
        check_material(wanted.material, wanted.organ);
        bool matched = false;
        for (Organ& organ : organs) {
            if (organ.name != wanted.organ && organ.kind != wanted.organ) continue;
            organ.material = wanted.material;
            organ.material_given = true;
            matched = true;
        }
        if (!matched)
            fail(FROND_RESULT_BAD_ARGUMENT, "no organ has the name or kind \"%s\"; this model has: %s", wanted.organ,
                 list_organs(organs).c_str());
    }
}

// Returns the colour of a kind of organ (linear).
static std::array<float, 4> color_of_kind(const std::string& kind) {
    static const struct {
        const char* kind;
        std::array<float, 4> color;
    } rows[] = {
        {"branch", {0.14f, 0.09f, 0.05f, 1}},  {"root", {0.20f, 0.13f, 0.07f, 1}},
        {"support", {0.32f, 0.12f, 0.06f, 1}}, {"flower", {0.75f, 0.32f, 0.42f, 1}},
        {"fruit", {0.50f, 0.11f, 0.03f, 1}},   {"stem", {0.15f, 0.24f, 0.06f, 1}},
        {"petiole", {0.15f, 0.24f, 0.06f, 1}},
    };
    for (const auto& row : rows)
        if (kind == row.kind) return row.color;
    return {0.12f, 0.24f, 0.05f, 1};
}

// Returns whether a file has no colours: all parts are grey, black or white, without texture or vertex colours.
static bool is_colorless(const Surface& surface) {
    constexpr float GREY = 0.02f;
    if (!surface.colors.empty()) return false;
    return std::all_of(surface.parts.begin(), surface.parts.end(), [](const Part& part) {
        const auto& c = part.color;
        const float spread = std::max({c[0], c[1], c[2]}) - std::min({c[0], c[1], c[2]});
        return part.texture < 0 && (part.color == Part().color || spread < GREY);
    });
}

// Colours parts that have no colour in the file by their kind of organ.
static void color_by_kind(Surface& surface, const std::vector<Organ>& organs) {
    const bool is_open = is_colorless(surface);
    for (Part& part : surface.parts)
        if (part.texture < 0 && (is_open || part.color == Part().color))
            part.color = color_of_kind(organs[size_t(part.organ)].kind);
}

std::vector<Organ> find_organs(Surface& surface, Topology& topology, const frond_organ_material* overrides,
                               int override_count) {
    if (surface.triangles.empty() || topology.triangles.size() != surface.triangles.size())
        fail(FROND_RESULT_BAD_GEOMETRY, "the model has no triangles; give at least one with area");
    if (surface.parts.empty()) {
        surface.parts.emplace_back();
        surface.parts.back().triangle_count = int(surface.triangles.size());
    }
    const std::vector<std::string> kinds = split_parts(surface, topology, kinds_of_triangles(surface, topology));
    std::vector<Organ> organs = name_organs(surface, kinds);
    override_materials(organs, overrides, override_count);
    color_by_kind(surface, organs);
    return organs;
}

}  // namespace frond
