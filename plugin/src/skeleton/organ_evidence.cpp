// Organ evidence. In: regions, and the kinds that names mean. Out: what each region bears and looks like.
#include "skeleton/organ_evidence.hpp"

#include <algorithm>

#include "core/elementary.hpp"
#include "skeleton/organ_clues.hpp"
#include "skeleton/organ_join.hpp"
#include "skeleton/organ_look.hpp"

namespace frond {

static constexpr double TREE_HEIGHT = 3;      // higher plants are held by wood [m]
static constexpr double CROWN_SHARE = 0.25;   // least size of a crown, as a share of the plant's
static constexpr double AT_FOOT = 0.1;        // share of the height up to which things stand on the ground
static constexpr double PETIOLE_THIN = 0.75;  // largest radius of a petiole, as a share of that of what it grows out of
static constexpr int FEW_LEAVES = 9;          // most leaves on a petiole

// Returns whether a region and all that it grows out of, down to the ground, are one mesh.
static bool reaches_ground(const Evidence& plant, size_t r) {
    while (plant.regions[r].same_mesh && plant.regions[r].parent >= 0) r = size_t(plant.regions[r].parent);
    return plant.regions[r].box.min().y() < plant.foot + AT_FOOT * plant.height;
}

static bool is_bare(const Evidence& plant, size_t r) {
    const Region& region = plant.regions[r];
    return region.form != Form::SOLID && stands(region, plant.foot, plant.height) && plant.borne[r] <= 1;
}
bool is_grass(const Evidence& plant, size_t r) {
    constexpr int TUFT = 5;  // bare stems on the ground that make a tuft
    const Region& region = plant.regions[r];
    return is_bare(plant, r) && region.form == Form::TUBE && plant.height < TREE_HEIGHT && plant.bare >= TUFT;
}

bool is_rooted_tuber(const Evidence& plant, size_t r) {
    constexpr double LOW = 0.3;  // largest height above the ground at which one begins, as a share of the plant's
    const Region& region = plant.regions[r];
    if (plant.height > TREE_HEIGHT || region.box.min().y() > plant.foot + LOW * plant.height || plant.crown[r] > 0.5)
        return false;
    if (region.form == Form::SOLID) return plant.growths[r] > 0 && reaches_ground(plant, r);
    // A tube that stands on its point, thick at its upper end, out of which thin ones grow.
    const double length = region.box.sizes().y();
    return region.form == Form::TUBE && region.parent < 0 && region.tubes + region.sheets > 0 &&
           region.begin_radius < 0.35 * region.radius() && length < 16 * region.radius() &&
           region.middle.y() > region.box.min().y() + 0.5 * length && length > 0.3 * plant.height;
}

bool is_point(const Evidence& plant, size_t r) {
    for (size_t k = 0; k < plant.regions.size() && plant.regions[r].parent < 0; k++)
        if (plant.regions[k].parent == int(r) && plant.regions[k].same_mesh && plant.regions[k].form == Form::SOLID)
            return plant.regions[r].tubes + plant.regions[r].sheets == 0 && is_rooted_tuber(plant, k);
    return false;
}

bool is_petiole(const Evidence& plant, size_t r) {
    const Region& region = plant.regions[r];
    if (region.form != Form::TUBE || plant.tube == "branch" || plant.others[r] > 0 || region.length > 0.6 * plant.size)
        return false;
    if (region.parent < 0 || stands(region, plant.foot, plant.height)) return plant.leaves[r] == 1;
    const Region& parent = plant.regions[size_t(region.parent)];
    // A leaf bears no stem, but stalks of other leaves that begin near it.
    if (parent.form == Form::SHEET && !region.same_mesh && !plant.bears[size_t(region.parent)])
        return plant.leaves[r] <= 1;
    return plant.leaves[r] > 0 && plant.leaves[r] <= FEW_LEAVES &&
           (parent.form == Form::SOLID || region.radius() < PETIOLE_THIN * parent.radius());
}

bool is_thick_leaf(const Evidence& plant, const Region& region) {
    constexpr double WIDER = 1.55, SMALL = 0.4;  // width over thickness, size over that of the plant [-]
    return region.form == Form::TUBE && region.parent >= 0 && !region.same_mesh && plant.height < TREE_HEIGHT &&
           region.tubes + region.sheets + region.solids == 0 && region.box.diagonal().norm() < SMALL * plant.size &&
           region.flatness() > WIDER;
}

bool surrounds_wood(const Evidence& plant, const Region& region) {
    // Least size over the largest, size over that of the plant, mean normal, and distance of the middle over the width
    // [-].
    constexpr double ROUND_ENOUGH = 0.25, LARGE_ENOUGH = 0.15, CLOSED = 0.5, AROUND = 0.2;
    const Vec3 size = region.box.sizes(), middle = region.box.center();
    return plant.has_wood && plant.named[size_t(region.part)] == "blade" &&
           size.minCoeff() > ROUND_ENOUGH * size.maxCoeff() &&
           hypot(middle.x() - region.begin.x(), middle.z() - region.begin.z()) <
               AROUND * std::max(size.x(), size.z()) &&
           size.norm() > LARGE_ENOUGH * plant.size && region.normal.norm() < CLOSED * region.area &&
           region.box.min().y() > plant.foot + AT_FOOT * plant.height;
}

bool surrounds_trunk(const Evidence& plant, size_t r) {
    // Distance from the trunk over the width, size over that of the plant, width over the larger width [-].
    constexpr double AROUND = 0.2, LARGE = 0.15, ROUND = 0.6;
    const Region& region = plant.regions[r];
    int trunk = region.parent;
    while (trunk >= 0 && plant.regions[size_t(trunk)].form != Form::TUBE) trunk = plant.regions[size_t(trunk)].parent;
    if (plant.height < TREE_HEIGHT || region.form != Form::SHEET || trunk < 0) return false;
    const Vec3 size = region.box.sizes(), away = region.box.center() - plant.regions[size_t(trunk)].box.center();
    const double width = std::max(size.x(), size.z());
    return hypot(away.x(), away.z()) < AROUND * width && std::min(size.x(), size.z()) > ROUND * width &&
           size.norm() > LARGE * plant.size;
}

bool bears_fruit(const Evidence& plant, const Region& region) {
    constexpr int SOME = 3;  // solids on one stem, which are fruits rather than its end
    return region.parent < 0 && region.solids >= SOME && region.tubes + region.sheets == 0 &&
           plant.height > CROWN_HEIGHT;
}

bool is_post(const Evidence& plant, const Region& region) {
    constexpr double UPRIGHT = 2.5, LOW = 0.2;  // height over width; height of its begin over the plant's [-]
    const Vec3 size = region.box.sizes();
    return region.box.min().y() < plant.foot + AT_FOOT * plant.height &&
           region.begin.y() < plant.foot + LOW * plant.height && size.y() > UPRIGHT * std::max(size.x(), size.z());
}

bool is_arm(const Evidence& plant, const Region& region) {
    constexpr double LONG = 2.5, THINNER = 0.8;  // length over thickness, radius over that of its parent [-]
    if (region.parent < 0 || region.same_mesh) return false;
    const Region& parent = plant.regions[size_t(region.parent)];
    return parent.form != Form::SHEET && region.length > 2 * LONG * region.radius() &&
           region.radius() < THINNER * parent.radius();
}

bool is_crown(const Evidence& plant, const Region& region) {
    constexpr double WIDE = 0.2;  // least width over the plant's height
    const Vec3 size = region.box.sizes();
    return size.norm() > CROWN_SHARE * plant.size && plant.height > CROWN_HEIGHT &&
           std::max(size.x(), size.z()) > WIDE * plant.height;
}

static std::vector<double> share_of_crowns(const Regions& cut, const std::vector<char>& crowns) {
    std::vector<double> in(cut.regions.size(), 0.0), all(in);
    for (size_t t = 0; t < crowns.size(); t++) {
        all[size_t(cut.region_of[t])] += 1;
        if (crowns[t]) in[size_t(cut.region_of[t])] += 1;
    }
    for (size_t r = 0; r < in.size(); r++) in[r] = all[r] > 0 ? in[r] / all[r] : 0;
    return in;
}

// Returns the weight of each part's name. If all parts have the same name, that is the plant's, such as a leaf's on all
// of a bean.
static std::vector<double> weigh_names(const Surface& surface, const std::vector<std::string>& named) {
    constexpr double NODE = 3, MATERIAL = 2.5, SAME = 1;  // votes, as those of organ_votes.cpp
    const bool differ =
        std::any_of(named.begin(), named.end(), [&](const std::string& one) { return one != named[0]; });
    std::vector<double> weights;
    for (size_t i = 0; i < named.size(); i++)
        weights.push_back(!differ ? SAME : read_name(surface.parts[i].name).kind == named[i] ? NODE : MATERIAL);
    return weights;
}

// Counts what each region bears.
static void count_leaves(Evidence& plant) {
    plant.leaves.assign(plant.regions.size(), 0);
    plant.others.assign(plant.regions.size(), 0);
    plant.borne.assign(plant.regions.size(), 0);
    plant.growths.assign(plant.regions.size(), 0);
    for (size_t r = plant.regions.size(); r-- > 0;) {
        const Region& region = plant.regions[r];
        const bool is_head = plant.heads.flower[r] || plant.heads.swollen[r] || region.form == Form::SOLID;
        if (plant.heads.hair_of[r] >= 0) continue;
        if (region.form == Form::SHEET && !is_head && !plant.bears[r]) plant.leaves[r]++;
        if (region.parent < 0) continue;
        plant.growths[size_t(region.parent)] += region.form != Form::SOLID;
        plant.borne[size_t(region.parent)] += !stands(region, plant.foot, plant.height);
        if (stands(region, plant.foot, plant.height)) continue;
        // Veins are no stems.
        const bool is_vein =
            region.form == Form::TUBE && region.radius() < 0.8 * plant.regions[size_t(region.parent)].radius();
        if (is_head || (region.form == Form::TUBE && plant.leaves[r] == 0 && !is_vein))
            plant.others[size_t(region.parent)]++;
        plant.leaves[size_t(region.parent)] += plant.leaves[r];
        plant.others[size_t(region.parent)] += plant.others[r];
    }
}

// Returns whether a sheet of a mesh is a patch of colour on the stem that it is a part of.
static bool is_patch(const Region& patch, const Region& stem) {
    if (patch.form != Form::SHEET || stem.form != Form::TUBE || !patch.same_mesh || patch.part == stem.part)
        return false;
    const Vec3 margin = Vec3::Constant(0.2 * stem.radius());
    return Eigen::AlignedBox3d(stem.box.min() - margin, stem.box.max() + margin).contains(patch.box);
}

// Finds sheets that bear tubes and solids of their mesh, larger than themselves, and patches: pieces of stems.
static void find_bearing(Evidence& plant) {
    std::vector<double> solid(plant.regions.size(), 0.0);  // area of what grows out of it and is no sheet
    plant.bears.assign(plant.regions.size(), 0);
    for (size_t r = plant.regions.size(); r-- > 0;) {
        const Region& region = plant.regions[r];
        plant.bears[r] = (region.form == Form::SHEET && solid[r] > region.area) ||
                         (region.parent >= 0 && is_patch(region, plant.regions[size_t(region.parent)]));
        if (region.same_mesh && region.parent >= 0)
            solid[size_t(region.parent)] += solid[r] + (region.form == Form::SHEET ? 0 : region.area);
    }
}

// Bright parts are flowers or fruit only beside more of something else, else the plant has the colour of its season.
static void find_opacities(const Regions& cut, Evidence& plant) {
    std::vector<OpacitySum> sums(cut.regions.size());
    for (const Part& part : plant.surface.parts)
        for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++)
            if (const int region = cut.region_of[size_t(t)]; region >= 0)
                sums[size_t(region)].add(plant.surface, part, plant.surface.triangles[size_t(t)]);
    for (const OpacitySum& sum : sums) plant.opacity.push_back(sum.mean());
}

static void find_bright_parts(Evidence& plant) {
    std::vector<double> area(plant.surface.parts.size(), 0.0);
    double bright = 0, all = 0;
    for (const Region& region : plant.regions) {
        const Part& part = plant.surface.parts[size_t(region.part)];
        area[size_t(region.part)] += region.area;
        all += region.area;
        if (part.texture < 0 && part.color != Part().color && is_bright(part.color)) bright += region.area;
    }
    plant.bright.assign(area.size(), bright < 0.8 * all ? 1 : 0);
}

Evidence gather_evidence(const Surface& surface, const Regions& cut, const std::vector<std::string>& named,
                         const std::vector<char>& crowns) {
    const double height = surface.height();
    Evidence plant{surface,
                   cut.regions,
                   named,
                   surface.lower().y(),
                   height,
                   surface.size(),
                   height > TREE_HEIGHT ? "branch" : "stem"};
    plant.has_wood = std::find(named.begin(), named.end(), "branch") != named.end();
    find_bearing(plant);
    plant.heads = find_heads(cut.regions, plant.foot, height);
    count_leaves(plant);
    for (size_t r = 0; r < cut.regions.size(); r++) plant.bare += is_bare(plant, r);
    plant.trust = weigh_names(surface, named);
    plant.crown = share_of_crowns(cut, crowns);
    find_bright_parts(plant);
    find_opacities(cut, plant);
    return plant;
}

}  // namespace frond
