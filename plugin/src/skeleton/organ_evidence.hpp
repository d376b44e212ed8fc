// Evidence: what is known of the regions of a plant before votes on them are counted.
#pragma once

#include "skeleton/organ_heads.hpp"

namespace frond {

struct Evidence {
    const Surface& surface;
    const std::vector<Region>& regions;
    const std::vector<std::string>& named;
    double foot, height, size;
    std::string tube;                  // kind of tubes
    bool has_wood = false;             // a part is named after wood
    int bare = 0;                      // number of meshes on the ground that bear nothing
    std::vector<double> bright = {};   // by part
    std::vector<double> trust = {};    // by part, weight of its name
    std::vector<double> opacity = {};  // by region, share of its area that textures do not cut out
    std::vector<double> crown = {};    // by region, share of its triangles that belong to round solids
    std::vector<int> leaves = {};      // by region, sheets that grow out of it and what it bears
    std::vector<int> borne = {};       // by region, those that grow out of it and do not stand beside it
    std::vector<int> growths = {};     // by region, tubes and sheets that grow out of it and are no hairs
    std::vector<int> others = {};      // by region, solids and tubes that bear no leaf likewise
    std::vector<char> bears = {};      // by region, whether it is a sheet but a piece of a stem
    Heads heads = {};
};

// `named` are the kinds that the parts' names mean; `crowns` says which triangles belong to round solids.
Evidence gather_evidence(const Surface& surface, const Regions& cut, const std::vector<std::string>& named,
                         const std::vector<char>& crowns);

// Returns whether a tube is a blade of grass: it stands among others that bear nothing, too.
bool is_grass(const Evidence& plant, size_t r);
// Returns whether a region is a swollen root, or the point of one.
bool is_rooted_tuber(const Evidence& plant, size_t r);
bool is_point(const Evidence& plant, size_t r);
bool is_petiole(const Evidence& plant, size_t r);
// Returns whether a tube is a small leaf drawn thick: flat, and nothing grows out of it.
bool is_thick_leaf(const Evidence& plant, const Region& region);
// Returns whether a region is foliage around wood: of a part named after leaves, closed, wide and large.
bool surrounds_wood(const Evidence& plant, const Region& region);
// Returns whether a sheet of a tree lies around its trunk, as wide one way as the other: a tier of a fir.
bool surrounds_trunk(const Evidence& plant, size_t r);
// Returns whether a solid is a bush with fruits on it.
bool bears_fruit(const Evidence& plant, const Region& region);
// Returns whether a solid stands upright on the ground: the trunk of a cactus.
bool is_post(const Evidence& plant, const Region& region);
// Returns whether a solid is a long piece thinner than the stem that it grows out of: the arm of a cactus.
bool is_arm(const Evidence& plant, const Region& region);
// Returns whether a solid is large enough for a crown.
bool is_crown(const Evidence& plant, const Region& region);

}  // namespace frond
