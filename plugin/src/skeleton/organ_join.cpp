// Organ joining. In: regions and their kinds. Out: which regions are one organ.
// Tubes that grow out of each other, petals of one flower, the parts of one crown, hairs of one region, and leaves near
// each other where a plant has hundreds of them.
#include "skeleton/organ_join.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

namespace frond {

bool stands(const Region& region, double foot, double height) {
    return !region.same_mesh && region.box.min().y() < foot + 0.05 * height;
}

namespace {

// Returns whether a region belongs to the organ of what it grows out of.
bool belongs_to_parent(const Surface& surface, const std::vector<Region>& regions, const std::vector<FoundOrgan>& found,
                       size_t r, double foot, double height) {
    const Region& region = regions[r];
    if (region.parent < 0) return false;
    const size_t p = size_t(region.parent);
    if (found[r].kind != found[p].kind) return false;
    // Stems of two nodes of a file are two organs.
    const Part &own = surface.parts[size_t(region.part)], &other = surface.parts[size_t(regions[p].part)];
    if (own.name != other.name && found[r].kind != "flower") return false;
    const std::string& kind = found[r].kind;
    if (kind == "stem" || kind == "branch" || kind == "root" || kind == "peduncle") {
        // Stems that stand beside each other are tied at their feet.
        return !(stands(region, foot, height) && region.box.sizes().y() > 0.3 * height);
    }
    if (kind == "flower") return true;
    if (kind == "crown") return region.same_mesh;
    // A leaf whose midrib or base was told apart from it.
    return region.same_mesh && kind == "blade" && region.form != regions[p].form;
}

// Returns the tube that bears a region, by way of others; -1: none.
int stem_of(const std::vector<Region>& regions, int r) {
    for (r = regions[size_t(r)].parent; r >= 0 && regions[size_t(r)].form != Form::TUBE;) r = regions[size_t(r)].parent;
    return r;
}

// Joins the parts of a flower: those on one stem that are near each other, by their size.
void join_petals(const std::vector<Region>& regions, const std::vector<FoundOrgan>& found, UnionFind& sets) {
    constexpr double NEAR = 0.15;  // gap over the smaller one's size [-]
    constexpr size_t MOST = 2000;  // beyond that it is no plant with flowers but a meadow
    std::vector<int> petals;
    for (size_t r = 0; r < regions.size(); r++)
        if (found[r].kind == "flower") petals.push_back(int(r));
    if (petals.size() > MOST) return;
    for (size_t i = 0; i < petals.size(); i++)
        for (size_t k = 0; k < i; k++) {
            const Region &a = regions[size_t(petals[i])], &b = regions[size_t(petals[k])];
            const double size = std::min(a.box.diagonal().norm(), b.box.diagonal().norm());
            if (a.box.exteriorDistance(b.box) < NEAR * size &&
                stem_of(regions, petals[i]) == stem_of(regions, petals[k]))
                sets.join(petals[i], petals[k]);
        }
}

// Joins tubes of one mesh and part, between which foliage lies.
void join_stems(const std::vector<Region>& regions, const std::vector<FoundOrgan>& found, UnionFind& sets) {
    std::map<std::tuple<int, int, std::string>, int> first;
    for (size_t r = 0; r < regions.size(); r++) {
        if (regions[r].form != Form::TUBE || (found[r].kind != "stem" && found[r].kind != "branch")) continue;
        const auto [at, fresh] =
            first.emplace(std::make_tuple(regions[r].component, regions[r].part, found[r].kind), int(r));
        if (!fresh) sets.join(int(r), at->second);
    }
}

// Joins slivers of crowns to the crown of their mesh and part that is largest.
void join_crowns(const std::vector<Region>& regions, const std::vector<FoundOrgan>& found, UnionFind& sets) {
    constexpr double SLIVER_OF_CROWN = 0.1;  // area over that of the largest
    std::map<std::pair<int, int>, int> largest;
    for (size_t r = 0; r < regions.size(); r++) {
        if (found[r].kind != "crown") continue;
        int& best = largest.emplace(std::make_pair(regions[r].component, regions[r].part), int(r)).first->second;
        if (regions[r].area > regions[size_t(best)].area) best = int(r);
    }
    for (size_t r = 0; r < regions.size(); r++) {
        if (found[r].kind != "crown") continue;
        const int crown = largest.at({regions[r].component, regions[r].part});
        if (regions[r].area < SLIVER_OF_CROWN * regions[size_t(crown)].area) sets.join(int(r), crown);
    }
}

// Joins hairs: awns, silk and the like, sheets far smaller than the plant's leaves, that hang on the same region.
void join_hairs(const std::vector<Region>& regions, const std::vector<FoundOrgan>& found, UnionFind& sets) {
    constexpr double FAR_SMALLER = 0.05;  // area over that of the largest leaf
    double largest = 0;
    for (size_t r = 0; r < regions.size(); r++)
        if (found[r].kind == "blade") largest = std::max(largest, regions[r].area);
    std::map<std::pair<int, int>, int> first;  // by parent and part
    for (size_t r = 0; r < regions.size(); r++) {
        const bool is_hair = found[r].kind == "blade" && regions[r].parent >= 0 &&
                             regions[r].tubes + regions[r].sheets + regions[r].solids == 0;
        if (!is_hair || regions[r].area > FAR_SMALLER * largest) continue;
        const auto [at, fresh] = first.emplace(std::make_pair(regions[r].parent, regions[r].part), int(r));
        if (!fresh) sets.join(int(r), at->second);
    }
}

// Joins the leaves of crowns that have hundreds of them: those of one part that begin near each other are a cluster.
void join_clusters(const std::vector<Region>& regions, const std::vector<FoundOrgan>& found, double size,
                   UnionFind& sets) {
    constexpr int MOST_LEAVES = 120;  // that stay organs of their own
    constexpr double CLUSTER = 0.15;  // edge of a cluster, as a share of the plant's size
    std::vector<int> leaves;
    for (size_t r = 0; r < regions.size(); r++)
        if (found[r].kind == "blade" && sets.find(int(r)) == int(r)) leaves.push_back(int(r));
    if (int(leaves.size()) <= MOST_LEAVES) return;
    std::map<std::array<int, 4>, int> first;
    for (int r : leaves) {
        const Region& region = regions[size_t(r)];
        std::array<int, 4> cell = {region.part, 0, 0, 0};
        for (int k = 0; k < 3; k++) cell[size_t(k) + 1] = int(std::floor(region.begin[k] / (CLUSTER * size)));
        const auto [at, fresh] = first.emplace(cell, r);
        if (!fresh) sets.join(r, at->second);
    }
}

}  // namespace

UnionFind join_regions(const Surface& surface, const std::vector<Region>& regions,
                       const std::vector<FoundOrgan>& found) {
    UnionFind sets(regions.size());
    const double foot = surface.lower().y(), height = surface.height();
    for (size_t r = 0; r < regions.size(); r++)
        if (belongs_to_parent(surface, regions, found, r, foot, height)) sets.join(int(r), regions[r].parent);
    join_petals(regions, found, sets);
    join_crowns(regions, found, sets);
    join_stems(regions, found, sets);
    join_hairs(regions, found, sets);
    join_clusters(regions, found, surface.size(), sets);
    return sets;
}

}  // namespace frond
