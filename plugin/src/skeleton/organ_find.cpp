// Organ finding. In: a surface with parts, its topology and the caller's materials. Out: organs with names, kinds and
// materials; every part belongs to one of them.
#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "core/error.hpp"
#include "skeleton/organ_clues.hpp"
#include "skeleton/organ_votes.hpp"

namespace frond {

using EdgeEnds = std::array<int, 2>;

static EdgeEnds edge_of(const Triangle& corners, size_t k) {
    const auto [a, b] = std::minmax(corners[k], corners[(k + 1) % 3]);
    return {a, b};
}

static std::map<EdgeEnds, int> count_edges(const Topology& topology) {
    std::map<EdgeEnds, int> uses;
    for (const Triangle& corners : topology.triangles)
        for (size_t k = 0; k < 3; k++) uses[edge_of(corners, k)]++;
    return uses;
}

// Returns whether a part has the border of a sheet, at least as long as itself; a tube is closed or ends in rings, and
// a face between others has its neighbours all around.
static bool has_border(const Topology& topology, const std::map<EdgeEnds, int>& uses, const Part& part) {
    Vec3 lower = Vec3::Constant(INFINITY), upper = -lower;
    double border = 0;
    for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++)
        for (size_t k = 0; k < 3; k++) {
            const EdgeEnds edge = edge_of(topology.triangles[size_t(t)], k);
            const Vec3 &a = topology.points[size_t(edge[0])], &b = topology.points[size_t(edge[1])];
            if (uses.at(edge) == 1) border += (b - a).norm();
            lower = lower.cwiseMin(a).cwiseMin(b);
            upper = upper.cwiseMax(a).cwiseMax(b);
        }
    return border >= (upper - lower).norm();
}

// Finds twigs drawn as cards with leaves on them: parts named branches that are nearly all sheets, if other branches
// are not. Makes them blades.
void find_cards(const Surface& surface, const Topology& topology, const std::vector<char>& sheets,
                std::vector<std::string>& named) {
    constexpr double NEARLY_ALL = 0.9;  // share of a part's triangles [-]
    std::vector<char> is_card(named.size(), 0);
    bool has_wood = false;
    if (std::find(named.begin(), named.end(), "branch") == named.end()) return;
    const std::map<EdgeEnds, int> uses = count_edges(topology);
    for (size_t i = 0; i < named.size(); i++) {
        const Part& part = surface.parts[i];
        if (named[i] != "branch" || part.triangle_count == 0) continue;
        const auto first = sheets.begin() + part.first_triangle;
        is_card[i] = std::count(first, first + part.triangle_count, 1) >= NEARLY_ALL * part.triangle_count &&
                     has_border(topology, uses, part);
        has_wood = has_wood || !is_card[i];
    }
    for (size_t i = 0; i < named.size(); i++)
        if (has_wood && is_card[i]) named[i] = "blade";
}

// Returns which parts are one organ each: those whose own node is named after one organ.
static std::vector<char> find_whole_parts(const Surface& surface, const std::vector<std::string>& named) {
    std::multiset<std::string> given;
    for (const Part& part : surface.parts) given.insert(part.name);
    std::vector<char> whole(surface.parts.size(), 0);
    for (size_t i = 0; i < whole.size(); i++) {
        const Part& part = surface.parts[i];
        const NameClue clue = read_name(part.name);
        // Branches may be cards with leaves on them.
        whole[i] = part.triangle_count == 0 || (!named[i].empty() && named[i] != "branch" && clue.kind == named[i] &&
                                                !clue.species && given.count(part.name) == 1 && !names_many(part.name));
    }
    return whole;
}

// Finds the organs of the parts: whole ones, and those that shape and other clues tell apart in the rest.
static FoundOrgans find_in_parts(const Surface& surface, const Topology& topology) {
    const std::vector<std::string> named = kinds_by_name(surface);
    const std::vector<char> whole = find_whole_parts(surface, named);
    const bool is_bush = std::any_of(surface.parts.begin(), surface.parts.end(), [](const Part& part) {
        return names_a_bush(part.name) || names_a_bush(part.material);
    });
    const std::vector<char> crowns = find_crowns(surface, topology, is_bush);
    FoundOrgans found;
    if (std::find(whole.begin(), whole.end(), 0) == whole.end())
        found.organ_of.assign(surface.triangles.size(), -1);
    else
        found = vote_on_organs(surface, topology, named, crowns);
    for (size_t i = 0; i < whole.size(); i++) {
        if (!whole[i]) continue;
        const Part& part = surface.parts[i];
        // What is called a leaf, but is a ball, is foliage; so it may be in a part of several meshes.
        std::map<std::string, int> organ_of_kind;
        for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++) {
            const std::string kind = crowns[size_t(t)] && named[i] == "blade" ? "crown" : named[i];
            const auto [at, fresh] = organ_of_kind.emplace(kind, int(found.organs.size()));
            if (fresh) found.organs.push_back({kind, "its node is named " + named[i], 1});
            found.organ_of[size_t(t)] = at->second;
        }
    }
    return found;
}

// Returns the first triangle with the corners of each: leaves are often drawn with two faces in one place, and some
// exporters write each triangle both ways round.
static std::vector<int> find_twins(const Topology& topology) {
    std::vector<std::pair<Triangle, int>> sorted;
    for (Triangle corners : topology.triangles) {
        std::sort(corners.begin(), corners.end());
        sorted.push_back({corners, int(sorted.size())});
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<int> twin(sorted.size());
    for (size_t i = 0; i < sorted.size(); i++) {
        const bool is_new = i == 0 || sorted[i - 1].first != sorted[i].first;
        twin[size_t(sorted[i].second)] = is_new ? sorted[i].second : twin[size_t(sorted[i - 1].second)];
    }
    return twin;
}

// Finds the organs of the triangles that have no twin before them; the twins are of the same ones.
static FoundOrgans find_in_singles(const Surface& surface, const Topology& topology) {
    const std::vector<int> twin = find_twins(topology);
    bool has_twins = false;
    for (size_t t = 0; t < twin.size(); t++) has_twins |= twin[t] != int(t);
    if (!has_twins) return find_in_parts(surface, topology);
    std::vector<int> number(twin.size(), -1);  // among the singles
    Surface single = surface;
    single.triangles.clear();
    for (Part& part : single.parts) {
        const int begin = part.first_triangle, end = begin + part.triangle_count;
        part.first_triangle = int(single.triangles.size());
        for (int t = begin; t < end; t++) {
            if (twin[size_t(t)] != t) continue;
            number[size_t(t)] = int(single.triangles.size());
            single.triangles.push_back(surface.triangles[size_t(t)]);
        }
        part.triangle_count = int(single.triangles.size()) - part.first_triangle;
    }
    FoundOrgans found = find_in_parts(single, make_topology(single));
    std::vector<int> organ_of;
    for (int t : twin) organ_of.push_back(found.organ_of[size_t(number[size_t(t)])]);
    found.organ_of = std::move(organ_of);
    return found;
}

template <typename T>
static void reorder(std::vector<T>& values, const std::vector<int>& order) {
    std::vector<T> moved(values.size());
    for (size_t i = 0; i < order.size(); i++) moved[i] = values[size_t(order[i])];
    values.swap(moved);
}

// Splits each part into runs of one organ, in the order in which they first appear. Sets Part::organ by found.organs.
static void split_parts(Surface& surface, Topology& topology, const std::vector<int>& organ_of) {
    std::vector<int> order(surface.triangles.size());
    std::iota(order.begin(), order.end(), 0);
    std::vector<Part> parts;
    for (const Part& part : surface.parts) {
        const auto begin = order.begin() + part.first_triangle, end = begin + part.triangle_count;
        // The organs of a part in the order in which they appear in it.
        std::map<int, int> rank;
        for (auto at = begin; at != end; ++at) rank.emplace(organ_of[size_t(*at)], int(rank.size()));
        std::stable_sort(begin, end,
                         [&](int a, int b) { return rank.at(organ_of[size_t(a)]) < rank.at(organ_of[size_t(b)]); });
        auto from = begin;
        do {
            const int organ = from == end ? -1 : organ_of[size_t(*from)];
            const auto to = std::find_if(from, end, [&](int t) { return organ_of[size_t(t)] != organ; });
            parts.push_back(part);
            parts.back().first_triangle = int(from - order.begin());
            parts.back().triangle_count = int(to - from);
            parts.back().organ = organ;
            from = to;
        } while (from != end);
    }
    surface.parts = std::move(parts);
    if (std::is_sorted(order.begin(), order.end())) return;
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
}

// Makes the organs, numbered in the order of their first parts. Each has its part's own name if no other part has it,
// else its kind and a number that is still free.
static std::vector<Organ> name_organs(Surface& surface, const std::vector<FoundOrgan>& found) {
    std::multiset<std::string> given;
    for (const Part& part : surface.parts) given.insert(part.name);
    std::set<std::string> taken(given.begin(), given.end());
    std::vector<Organ> organs;
    std::map<std::string, int> counters;
    std::map<int, int> number;
    for (Part& part : surface.parts) {
        const auto [at, fresh] = number.emplace(part.organ, int(organs.size()));
        // A part without triangles is an organ of its own.
        const FoundOrgan one = part.organ < 0 ? FoundOrgan{"stem", "", 1} : found[size_t(part.organ)];
        const bool is_new = fresh || part.organ < 0;
        part.organ = is_new ? int(organs.size()) : at->second;
        if (!is_new) continue;
        std::string name = part.name;
        if (name.empty() || given.count(name) > 1) {
            do name = one.kind + "_" + std::to_string(++counters[one.kind]);
            while (!taken.insert(name).second);
        }
        organs.push_back({name, one.kind, preset_by_names(one.kind, part.name, part.material)});
        organs.back().why = one.why;
        organs.back().certainty = one.certainty;
    }
    return organs;
}

std::string list_organs(const std::vector<Organ>& organs) {
    std::string text;
    for (size_t i = 0; i < organs.size(); i++) {
        if (i == 30) return text + " and " + std::to_string(organs.size() - i) + " more";
        text += (i ? ", " : "") + organs[i].name + " (" + organs[i].kind + ")";
    }
    return text;
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
    constexpr float GREY = 0.02f;  // difference of channels, of 1, up to which a colour is none
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

static void measure_opacity(const Surface& surface, std::vector<Organ>& organs) {
    constexpr double LEAST = 0.02;  // leaves of which less is seen are a mistake of the exporter [-]
    std::vector<OpacitySum> sums(organs.size());
    for (const Part& part : surface.parts)
        for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++)
            sums[size_t(part.organ)].add(surface, part, surface.triangles[size_t(t)]);
    for (size_t o = 0; o < organs.size(); o++) {
        const double seen = sums[o].mean();
        organs[o].opacity = seen < LEAST ? 1 : seen;
    }
}

std::vector<Organ> find_organs(Surface& surface, Topology& topology) {
    if (surface.triangles.empty() || topology.triangles.size() != surface.triangles.size())
        fail(FROND_RESULT_BAD_GEOMETRY, "the model has no triangles; give at least one with area");
    if (surface.parts.empty()) {
        surface.parts.emplace_back();
        surface.parts.back().triangle_count = int(surface.triangles.size());
    }
    const FoundOrgans found = find_in_singles(surface, topology);
    split_parts(surface, topology, found.organ_of);
    std::vector<Organ> organs = name_organs(surface, found.organs);
    color_by_kind(surface, organs);
    measure_opacity(surface, organs);
    return organs;
}

}  // namespace frond
