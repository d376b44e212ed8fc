// Organ heads. In: regions. Out: which are parts of flowers, ears and fruits.
// 1. A round tube that ends, much thicker than the tube that bears it, is swollen: an ear, a cob, a cucumber.
// 2. Sheets far smaller than the plant's leaves, some on one bearer, are its hairs: awns, silk, spikelets; so are husks
//    and sepals, small beside the fruit that bears them, spines of a solid, and crumbs of a damaged mesh. Where hairs
//    are larger together than their bearer, they are petals, and it is a flower.
// 3. Sheets that radiate from one place at the end of a stem, much shorter than it, are a flower's petals; so is one
//    round sheet that is borne in its middle, or a cup. What stands in the middle of a leaf is a flower, too.
#include "skeleton/organ_heads.hpp"

#include <algorithm>
#include <numeric>

#include "core/decompose.hpp"
#include "core/elementary.hpp"

namespace frond {

namespace {

constexpr double SWOLLEN = 1.5;        // least radius of an ear or a fruit over that of its bearer
constexpr double ROUND = 1.6;          // largest flatness of one
constexpr double OF_LEAF = 0.05;       // largest area of a hair over that of a typical leaf
constexpr double CRUMB = 0.002;        // largest area of what is no organ over that of a typical leaf
constexpr double OF_BEARER = 0.2;      // largest area of a husk over that of its fruit
constexpr double OF_SPINE = 0.01;      // largest area of a spine over that of its bearer
constexpr size_t FEWEST_HAIRS = 2;     // one small sheet by itself is a young leaf
constexpr size_t FEWEST_PETALS = 4;    // in a whorl
constexpr size_t MOST_PETALS = 200;    // on one stem; beyond that it is no plant but a meadow
constexpr double TALLEST = 3;          // higher plants end in leaves, as palms do [m]
constexpr double SHORT_PETAL = 0.4;    // largest length of a petal over that of its stem
constexpr double LONGEST_PETAL = 0.5;  // [m]
constexpr double TOGETHER = 0.2;       // largest gap between the feet of petals, over a petal's length
constexpr double AT_END = 0.6;         // share of a stem's height from which on its end begins
constexpr double SMALL_HEAD = 0.75;    // largest width of a flower that is one sheet, over the height of its foot
constexpr double IN_MIDDLE = 0.2;      // largest distance of its foot from its middle, over its width
constexpr double CUP_DEPTH = 0.45;     // least spread of a cup along its thinnest axis, over that along its widest

struct Seeker {
    const std::vector<Region>& regions;
    double foot, height;
    Heads heads = {};

    const Region& region(int r) const { return regions[size_t(r)]; }
    bool is_sheet(int r) const { return region(r).form == Form::SHEET; }
    bool ends(int r) const { return region(r).tubes + region(r).solids == 0; }
    bool on_ground(int r) const { return region(r).parent < 0; }
    // Returns whether a region is of a mesh that stands on the ground.
    bool is_stem(int r) const {
        constexpr double AT_FOOT = 0.05;  // share of the plant's height
        while (region(r).same_mesh && region(r).parent >= 0) r = region(r).parent;
        return on_ground(r) || region(r).box.min().y() < foot + AT_FOOT * height;
    }
};

// Returns the area of a typical leaf: half of the area of all sheets is in larger ones.
double typical_leaf(const std::vector<Region>& regions) {
    std::vector<double> areas;
    for (const Region& region : regions)
        if (region.form == Form::SHEET) areas.push_back(region.area);
    std::sort(areas.begin(), areas.end(), std::greater<double>());
    double left = 0.5 * std::accumulate(areas.begin(), areas.end(), 0.0);
    for (double area : areas)
        if ((left -= area) <= 0) return area;
    return 0;
}

double longest_side(const Region& region) {
    return region.box.sizes().maxCoeff();
}

bool is_borne_in_middle(const Region& region) {
    return (region.begin - region.middle).norm() < IN_MIDDLE * longest_side(region);
}

void find_swollen(Seeker& seeker) {
    std::vector<double> largest_borne(seeker.regions.size(), 0.0);
    for (const Region& region : seeker.regions)
        if (region.parent >= 0)
            largest_borne[size_t(region.parent)] = std::max(largest_borne[size_t(region.parent)], region.area);
    for (size_t r = 0; r < seeker.regions.size(); r++) {
        const Region& region = seeker.regions[r];
        if (region.form != Form::TUBE || region.parent < 0 || region.same_mesh || !seeker.ends(int(r))) continue;
        const Region& bearer = seeker.region(region.parent);
        seeker.heads.swollen[r] = bearer.form == Form::TUBE && region.radius() > SWOLLEN * bearer.radius() &&
                                  (region.flatness() < ROUND || is_borne_in_middle(region)) &&
                                  largest_borne[r] < OF_BEARER * region.area;
    }
}

// Returns whether a region is a tube much smaller than the solid that it stands on, and bears nothing.
bool is_spine(const Seeker& seeker, int r) {
    const Region& region = seeker.region(r);
    const Region& bearer = seeker.region(region.parent);
    return region.form == Form::TUBE && !region.same_mesh && seeker.ends(r) && region.sheets == 0 &&
           bearer.form == Form::SOLID && region.area < OF_SPINE * bearer.area;
}

// Finds sheets that are hairs of what bears them, by way of other ones.
void find_hairs(Seeker& seeker) {
    const double leaf = typical_leaf(seeker.regions);
    std::vector<std::vector<int>> hairs(seeker.regions.size());
    std::vector<char> fruit(seeker.regions.size());
    for (size_t r = 0; r < fruit.size(); r++)
        fruit[r] = seeker.heads.swollen[r] || seeker.regions[r].form == Form::SOLID;
    for (size_t r = 0; r < seeker.regions.size(); r++) {
        int bearer = seeker.regions[r].parent;
        if (bearer >= 0 && is_spine(seeker, int(r))) hairs[size_t(bearer)].push_back(int(r));
        if (!seeker.is_sheet(int(r)) || !seeker.ends(int(r))) continue;
        if (bearer >= 0 && seeker.regions[r].area < CRUMB * leaf) {
            seeker.heads.hair_of[r] = bearer;
            continue;
        }
        while (bearer >= 0 && seeker.is_sheet(bearer)) bearer = seeker.region(bearer).parent;
        if (bearer < 0 || seeker.on_ground(bearer)) continue;
        const double area = seeker.regions[r].area;
        if (fruit[size_t(bearer)] && area < OF_BEARER * seeker.region(bearer).area)
            seeker.heads.hair_of[r] = bearer;
        else if (area < OF_LEAF * leaf)
            hairs[size_t(bearer)].push_back(int(r));
    }
    for (size_t bearer = 0; bearer < hairs.size(); bearer++)
        if (hairs[bearer].size() >= FEWEST_HAIRS)
            for (int hair : hairs[bearer]) seeker.heads.hair_of[size_t(hair)] = int(bearer);
    std::vector<double> together(hairs.size(), 0.0);
    for (size_t r = 0; r < hairs.size(); r++)
        if (const int bearer = seeker.heads.hair_of[r]; bearer >= 0) together[size_t(bearer)] += seeker.regions[r].area;
    for (size_t r = 0; r < hairs.size(); r++) {
        const int head = seeker.heads.hair_of[r] >= 0 ? seeker.heads.hair_of[r] : int(r);
        if (seeker.height < TALLEST && together[size_t(head)] > seeker.region(head).area) seeker.heads.flower[r] = 1;
    }
}

// Marks a whorl of sheets at the end of a stem, and the solids in its middle.
void mark_whorl(Seeker& seeker, int stem, const std::vector<int>& borne) {
    const Region& bearer = seeker.region(stem);
    const double end = bearer.box.min().y() + AT_END * bearer.box.sizes().y();
    std::vector<int> whorl;
    for (int one : borne) {
        const Region& petal = seeker.region(one);
        if (!seeker.is_sheet(one) || petal.begin.y() < end ||
            longest_side(petal) > std::min(LONGEST_PETAL, SHORT_PETAL * bearer.length))
            continue;
        std::vector<int> near;
        for (int other : borne)
            if (seeker.ends(other) &&
                (seeker.region(other).begin - petal.begin).norm() < TOGETHER * longest_side(petal))
                near.push_back(other);
        if (near.size() > whorl.size()) whorl = near;
    }
    const auto petals = std::count_if(whorl.begin(), whorl.end(), [&](int r) { return seeker.is_sheet(r); });
    // Leaves stand in whorls along all of a stem.
    const auto sheets = std::count_if(borne.begin(), borne.end(), [&](int r) { return seeker.is_sheet(r); });
    if (size_t(petals) < FEWEST_PETALS || 2 * petals <= sheets) return;
    for (int r : whorl)
        if (seeker.region(r).form != Form::TUBE) seeker.heads.flower[size_t(r)] = 1;
}

// Returns whether a sheet at the end of a stem is a flower by itself.
bool is_flower(const Seeker& seeker, int r) {
    const Region& region = seeker.region(r);
    if (!seeker.is_sheet(r) || region.parent < 0 || !seeker.ends(r) || region.sheets > 0) return false;
    const Region& bearer = seeker.region(region.parent);
    const double width = longest_side(region), end = bearer.box.min().y() + AT_END * bearer.box.sizes().y();
    if (bearer.form != Form::TUBE || !seeker.is_stem(region.parent) || region.begin.y() < end ||
        width > SMALL_HEAD * (region.begin.y() - seeker.foot) || !(region.area > 0))
        return false;
    const Vec3 centre = region.sum / region.area;
    const Vec3 spread = symmetric_values(Mat3(region.square / region.area - centre * centre.transpose()));
    const bool is_round = spread[1] > 0.5 * spread[2], is_cup = spread[0] > squared(CUP_DEPTH) * spread[2];
    return is_cup || (is_round && is_borne_in_middle(region));
}

// Marks what stands on a sheet in its middle, much smaller than it: the flower of a water lily.
void mark_on_leaf(Seeker& seeker, int leaf, const std::vector<int>& borne) {
    const Vec3 middle = seeker.region(leaf).box.center();
    const double width = longest_side(seeker.region(leaf));
    std::vector<int> parts;
    for (int r : borne) {
        const Region& region = seeker.region(r);
        if (region.same_mesh || region.area > OF_LEAF * seeker.region(leaf).area) continue;
        if ((region.begin - middle).norm() < IN_MIDDLE * width) parts.push_back(r);
    }
    if (parts.size() < FEWEST_PETALS) return;
    for (int r : parts) seeker.heads.flower[size_t(r)] = 1;
    for (size_t r = 0; r < seeker.regions.size(); r++)
        if (const int bearer = seeker.regions[r].parent; seeker.regions[r].same_mesh && bearer >= 0 && bearer != leaf)
            seeker.heads.flower[r] = seeker.heads.flower[r] || seeker.heads.flower[size_t(bearer)];
}

void find_flowers(Seeker& seeker) {
    std::vector<std::vector<int>> borne(seeker.regions.size());
    for (size_t r = 0; r < borne.size(); r++)
        if (const int bearer = seeker.regions[r].parent; bearer >= 0 && seeker.heads.hair_of[r] < 0)
            borne[size_t(bearer)].push_back(int(r));
    for (size_t r = 0; r < borne.size(); r++) {
        if (seeker.heads.hair_of[r] < 0 && is_flower(seeker, int(r))) seeker.heads.flower[r] = 1;
        if (seeker.is_sheet(int(r))) mark_on_leaf(seeker, int(r), borne[r]);
        if (seeker.regions[r].form == Form::TUBE && borne[r].size() >= FEWEST_PETALS && borne[r].size() <= MOST_PETALS)
            mark_whorl(seeker, int(r), borne[r]);
    }
}

}  // namespace

Heads find_heads(const std::vector<Region>& regions, double foot, double height) {
    const size_t count = regions.size();
    Seeker seeker{
        regions, foot, height, {std::vector<int>(count, -1), std::vector<char>(count), std::vector<char>(count)}};
    find_swollen(seeker);
    find_hairs(seeker);
    if (height < TALLEST) find_flowers(seeker);
    return seeker.heads;
}

}  // namespace frond
