// Organ votes. In: regions, and the kinds that names mean. Out: organs.
// Each region collects votes, and the kind with most of them wins; no single one decides against all others:
//   its part is named after a kind                          3 for that kind, its material 2.5; 1 if all are named so
//   it is a sheet                                           2 for a blade
//   it is a flower by its place (organ_heads.cpp)           2 for a flower
//   it is a tube                                            2 for a stem, or a branch if the plant is higher than 3 m
//   it is a solid at a thin neck                            2 for a fruit, or 3 for a crown if it is large
//   it is a solid at the foot that bears leaves             3 for a root
//   it is a thin tube at whose end one leaf or few are      2.5 for a petiole
//   it is green                                             0.5 for a blade, 0.3 for a stem
//   it is dark and brown                                    1 for a branch, 2.5 less for a crown
//   it is bright and not green                              2 for a flower if a sheet, 1 for a fruit if a solid
//   its texture lets light through                          1 for a blade
// Then regions are joined to organs: see organ_join.cpp.
#include "skeleton/organ_votes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "core/elementary.hpp"
#include "skeleton/organ_clues.hpp"
#include "skeleton/organ_heads.hpp"
#include "skeleton/organ_join.hpp"
#include "skeleton/organ_look.hpp"
#include "skeleton/organ_regions.hpp"

namespace frond {

namespace {

constexpr double TREE_HEIGHT = 3;      // higher plants are held by wood [m]
constexpr double CROWN_HEIGHT = 0.4;   // lower plants have no crown [m]
constexpr double CROWN_SHARE = 0.25;   // least size of a crown, as a share of the plant's
constexpr double AT_FOOT = 0.1;        // share of the height up to which things stand on the ground
constexpr double PETIOLE_THIN = 0.75;  // largest radius of a petiole, as a share of that of what it grows out of
constexpr int FEW_LEAVES = 9;          // most leaves on a petiole

// Makes unnamed green parts of a plant with wood blades: they are foliage, however solid they were drawn.
void find_foliage(const Surface& surface, std::vector<std::string>& named) {
    if (std::find(named.begin(), named.end(), "branch") == named.end()) return;
    for (size_t i = 0; i < named.size(); i++) {
        const Part& part = surface.parts[i];
        const bool has_color = part.texture < 0 && part.color != Part().color;
        if (named[i].empty() && has_color && is_green(part.color)) named[i] = "blade";
    }
}

std::vector<double> share_of_crowns(const Regions& cut, const std::vector<char>& crowns) {
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
std::vector<double> weigh_names(const Surface& surface, const std::vector<std::string>& named) {
    constexpr double NODE = 3, MATERIAL = 2.5, SAME = 1;
    const bool differ =
        std::any_of(named.begin(), named.end(), [&](const std::string& one) { return one != named[0]; });
    std::vector<double> weights;
    for (size_t i = 0; i < named.size(); i++)
        weights.push_back(!differ ? SAME : read_name(surface.parts[i].name).kind == named[i] ? NODE : MATERIAL);
    return weights;
}

struct Ballot {
    std::map<std::string, double> votes;
    std::string why;
    void add(const std::string& kind, double weight, const std::string& reason) {
        votes[kind] += weight;
        if (!reason.empty()) why += (why.empty() ? "" : "; ") + reason;
    }
    FoundOrgan result() const {
        std::string best;
        double first = 0, second = 0;
        for (const auto& [kind, weight] : votes) {
            if (weight > first) {
                second = first;
                first = weight;
                best = kind;
            } else {
                second = std::max(second, weight);
            }
        }
        return {best, why, first > 0 ? (first - second) / first : 0};
    }
};

std::string sized(const char* text, double a, double b) {
    char line[100];
    std::snprintf(line, sizeof line, "%s of %.3g by %.3g m", text, a, b);
    return line;
}

struct Voter {
    const Surface& surface;
    const std::vector<Region>& regions;
    const std::vector<std::string>& named;
    double foot, height, size;
    std::string tube;                 // kind of tubes
    bool has_wood = false;            // a part is named after wood
    int bare = 0;                     // number of meshes on the ground that bear nothing
    std::vector<double> bright = {};  // by part
    std::vector<double> trust = {};   // by part, weight of its name
    std::vector<double> crown = {};   // by region, share of its triangles that belong to round solids
    std::vector<int> leaves = {};     // by region, sheets that grow out of it and what it bears
    std::vector<int> borne = {};      // by region, those that grow out of it and do not stand beside it
    std::vector<int> others = {};     // by region, solids and tubes that bear no leaf likewise
    std::vector<char> bears = {};     // by region, whether it is a sheet that bears what no leaf does
    Heads heads = {};
};

// Returns whether a region and all that it grows out of, down to the ground, are one mesh.
bool reaches_ground(const Voter& voter, size_t r) {
    while (voter.regions[r].same_mesh && voter.regions[r].parent >= 0) r = size_t(voter.regions[r].parent);
    return voter.regions[r].box.min().y() < voter.foot + AT_FOOT * voter.height;
}

// Returns whether a tube is a blade of grass: it stands among others that bear nothing, too.
bool is_bare(const Voter& voter, size_t r) {
    const Region& region = voter.regions[r];
    return region.form != Form::SOLID && stands(region, voter.foot, voter.height) && voter.borne[r] <= 1;
}
bool is_grass(const Voter& voter, size_t r) {
    constexpr int TUFT = 5;
    const Region& region = voter.regions[r];
    return is_bare(voter, r) && region.form == Form::TUBE && voter.height < TREE_HEIGHT && voter.bare >= TUFT;
}

bool is_rooted_tuber(const Voter& voter, size_t r) {
    constexpr double LOW = 0.3;  // largest height above the ground at which one begins, as a share of the plant's
    const Region& region = voter.regions[r];
    if (voter.height > TREE_HEIGHT || region.box.min().y() > voter.foot + LOW * voter.height || voter.crown[r] > 0.5)
        return false;
    if (region.form == Form::SOLID) return region.tubes + region.sheets > 0 && reaches_ground(voter, r);
    // A tube that stands on its point, thick at its upper end, out of which thin ones grow.
    const double length = region.box.sizes().y();
    return region.form == Form::TUBE && region.parent < 0 && region.tubes + region.sheets > 0 &&
           region.begin_radius < 0.35 * region.radius() && length < 16 * region.radius() &&
           region.middle.y() > region.box.min().y() + 0.5 * length && length > 0.3 * voter.height;
}

// Returns whether a tube is the point of a tuber.
bool is_point(const Voter& voter, size_t r) {
    for (size_t k = 0; k < voter.regions.size() && voter.regions[r].parent < 0; k++)
        if (voter.regions[k].parent == int(r) && voter.regions[k].same_mesh && voter.regions[k].form == Form::SOLID)
            return voter.regions[r].tubes + voter.regions[r].sheets == 0 && is_rooted_tuber(voter, k);
    return false;
}

bool is_petiole(const Voter& voter, size_t r) {
    const Region& region = voter.regions[r];
    if (region.form != Form::TUBE || voter.tube == "branch" || voter.others[r] > 0 || region.length > 0.6 * voter.size)
        return false;
    if (region.parent < 0 || stands(region, voter.foot, voter.height)) return voter.leaves[r] == 1;
    const Region& parent = voter.regions[size_t(region.parent)];
    // A leaf bears no stem, but stalks of other leaves that begin near it.
    if (parent.form == Form::SHEET && !region.same_mesh && !voter.bears[size_t(region.parent)])
        return voter.leaves[r] <= 1;
    return voter.leaves[r] > 0 && voter.leaves[r] <= FEW_LEAVES &&
           (parent.form == Form::SOLID || region.radius() < PETIOLE_THIN * parent.radius());
}

// Returns whether a tube is a small leaf drawn thick: flat, and nothing grows out of it.
bool is_thick_leaf(const Voter& voter, const Region& region) {
    constexpr double WIDER = 1.55, SMALL = 0.4;
    return region.form == Form::TUBE && region.parent >= 0 && !region.same_mesh && voter.height < TREE_HEIGHT &&
           region.tubes + region.sheets + region.solids == 0 && region.box.diagonal().norm() < SMALL * voter.size &&
           region.flatness() > WIDER;
}

// Returns whether a region is foliage around wood: of a part named after leaves, closed, wide and large.
bool surrounds_wood(const Voter& voter, const Region& region) {
    constexpr double ROUND_ENOUGH = 0.25, LARGE_ENOUGH = 0.15, CLOSED = 0.5, AROUND = 0.2;
    const Vec3 size = region.box.sizes(), middle = region.box.center();
    return voter.has_wood && voter.named[size_t(region.part)] == "blade" &&
           size.minCoeff() > ROUND_ENOUGH * size.maxCoeff() &&
           hypot(middle.x() - region.begin.x(), middle.z() - region.begin.z()) <
               AROUND * std::max(size.x(), size.z()) &&
           size.norm() > LARGE_ENOUGH * voter.size && region.normal.norm() < CLOSED * region.area &&
           region.box.min().y() > voter.foot + AT_FOOT * voter.height;
}

// Returns whether a sheet of a tree lies around its trunk, as wide one way as the other: a tier of a fir.
bool surrounds_trunk(const Voter& voter, size_t r) {
    constexpr double AROUND = 0.2, LARGE = 0.15, ROUND = 0.6;
    const Region& region = voter.regions[r];
    int trunk = region.parent;
    while (trunk >= 0 && voter.regions[size_t(trunk)].form != Form::TUBE) trunk = voter.regions[size_t(trunk)].parent;
    if (voter.height < TREE_HEIGHT || region.form != Form::SHEET || trunk < 0) return false;
    const Vec3 size = region.box.sizes(), away = region.box.center() - voter.regions[size_t(trunk)].box.center();
    const double width = std::max(size.x(), size.z());
    return hypot(away.x(), away.z()) < AROUND * width && std::min(size.x(), size.z()) > ROUND * width &&
           size.norm() > LARGE * voter.size;
}

// Returns whether a solid is a bush with fruits on it.
bool bears_fruit(const Voter& voter, const Region& region) {
    constexpr int SOME = 3;
    return region.parent < 0 && region.solids >= SOME && region.tubes + region.sheets == 0 &&
           voter.height > CROWN_HEIGHT;
}

// Returns whether a solid stands upright on the ground: the trunk of a cactus.
bool is_post(const Voter& voter, const Region& region) {
    constexpr double UPRIGHT = 1.5, LOW = 0.2;
    const Vec3 size = region.box.sizes();
    return region.begin.y() < voter.foot + AT_FOOT * voter.height && size.y() > UPRIGHT * std::max(size.x(), size.z());
}

// Returns whether a solid is a long piece thinner than the stem that it grows out of: the arm of a cactus.
bool is_arm(const Voter& voter, const Region& region) {
    constexpr double LONG = 2.5, THINNER = 0.8;
    if (region.parent < 0 || region.same_mesh) return false;
    const Region& parent = voter.regions[size_t(region.parent)];
    return parent.form != Form::SHEET && region.length > 2 * LONG * region.radius() &&
           region.radius() < THINNER * parent.radius();
}

bool is_crown(const Voter& voter, const Region& region) {
    constexpr double WIDE = 0.2;  // least width over the plant's height
    const Vec3 size = region.box.sizes();
    return size.norm() > CROWN_SHARE * voter.size && voter.height > CROWN_HEIGHT &&
           std::max(size.x(), size.z()) > WIDE * voter.height;
}

void vote_by_shape(const Voter& voter, size_t r, Ballot& ballot) {
    const Region& region = voter.regions[r];
    const Vec3 size = region.box.sizes();
    if (is_rooted_tuber(voter, r) || is_point(voter, r))
        ballot.add("root", 3, sized("solid at the foot that bears leaves,", size.maxCoeff(), size.minCoeff()));
    else if (voter.crown[r] > 0.5 && voter.height > CROWN_HEIGHT && !(region.form == Form::TUBE && region.solids > 0))
        ballot.add("crown", 3, sized("large round solid,", size.maxCoeff(), size.minCoeff()));
    else if (surrounds_wood(voter, region) || surrounds_trunk(voter, r))
        ballot.add("crown", 3, sized("foliage around wood,", size.maxCoeff(), size.minCoeff()));
    else if (voter.heads.flower[r])
        ballot.add("flower", 2, sized("flower at a stem's end,", size.maxCoeff(), size.minCoeff()));
    else if (voter.heads.swollen[r])
        ballot.add(is_crown(voter, region) ? "crown" : "fruit", 2,
                   sized("thicker than what bears it,", region.length, 2 * region.radius()));
    else if (region.form == Form::SHEET && !voter.bears[r])
        ballot.add("blade", 2, sized("sheet", region.length, region.length > 0 ? region.area / region.length : 0));
    else if (is_grass(voter, r))
        ballot.add("blade", 2, sized("one of many alike on the ground,", region.length, 2 * region.radius()));
    else if (is_petiole(voter, r))
        ballot.add("petiole", 2.5, sized("thin tube with a leaf at its end,", region.length, 2 * region.radius()));
    else if (is_thick_leaf(voter, region))
        ballot.add("blade", 2, sized("flat tube that bears nothing,", region.length, 2 * region.radius()));
    else if (region.form == Form::TUBE || voter.bears[r])
        ballot.add(voter.tube, 2, sized("tube", region.length, 2 * region.radius()));
    else if (bears_fruit(voter, region))
        ballot.add("crown", 3, sized("solid that bears others,", size.maxCoeff(), size.minCoeff()));
    else if (region.parent < 0 || is_post(voter, region) || is_arm(voter, region))
        ballot.add(voter.tube, 2, sized("solid that stands by itself,", size.maxCoeff(), size.minCoeff()));
    else if (is_crown(voter, region))
        ballot.add("crown", 3, sized("large solid at a thin neck,", size.maxCoeff(), size.minCoeff()));
    else
        ballot.add("fruit", 2, sized("solid at a thin neck,", size.maxCoeff(), size.minCoeff()));
}

void vote_by_look(const Voter& voter, size_t r, Ballot& ballot) {
    const Region& region = voter.regions[r];
    const Part& part = voter.surface.parts[size_t(region.part)];
    if (part.texture >= 0) {
        if (has_alpha(voter.surface.textures[size_t(part.texture)])) ballot.add("blade", 1, "texture with alpha");
        return;
    }
    if (part.color == Part().color) return;
    if (is_green(part.color)) {
        ballot.add("blade", 0.5, "green");
        ballot.add("stem", 0.3, "");
    } else if (is_brown(part.color)) {
        ballot.add("branch", 1, "brown");
        if (ballot.votes.count("crown")) ballot.add("crown", -2.5, "");
    } else if (is_bright(part.color) && voter.leaves[r] <= (region.form == Form::SHEET) &&
               voter.bright[size_t(region.part)] > 0) {
        if (region.form != Form::SOLID)
            ballot.add("flower", 2.5, "bright");
        else
            ballot.add("fruit", 1, "bright");
    }
}

FoundOrgan vote(const Voter& voter, size_t r) {
    Ballot ballot;
    vote_by_shape(voter, r, ballot);
    const std::string& kind = voter.named[size_t(voter.regions[r].part)];
    // A solid crown is foliage, whatever it is called.
    const bool foliage = kind == "blade" && ballot.votes.count("crown");
    if (!kind.empty())
        ballot.add(foliage ? "crown" : kind, voter.trust[size_t(voter.regions[r].part)], "named " + kind);
    vote_by_look(voter, r, ballot);
    return ballot.result();
}

// Counts what each region bears.
void count_leaves(Voter& voter) {
    voter.leaves.assign(voter.regions.size(), 0);
    voter.others.assign(voter.regions.size(), 0);
    voter.borne.assign(voter.regions.size(), 0);
    for (size_t r = voter.regions.size(); r-- > 0;) {
        const Region& region = voter.regions[r];
        const bool is_head = voter.heads.flower[r] || voter.heads.swollen[r] || region.form == Form::SOLID;
        if (voter.heads.hair_of[r] >= 0) continue;
        if (region.form == Form::SHEET && !is_head && !voter.bears[r]) voter.leaves[r]++;
        if (region.parent < 0) continue;
        voter.borne[size_t(region.parent)] += !stands(region, voter.foot, voter.height);
        if (stands(region, voter.foot, voter.height)) continue;
        // Veins are no stems.
        const bool is_vein =
            region.form == Form::TUBE && region.radius() < 0.8 * voter.regions[size_t(region.parent)].radius();
        if (is_head || (region.form == Form::TUBE && voter.leaves[r] == 0 && !is_vein))
            voter.others[size_t(region.parent)]++;
        voter.leaves[size_t(region.parent)] += voter.leaves[r];
        voter.others[size_t(region.parent)] += voter.others[r];
    }
}

// Finds sheets that bear tubes and solids of their mesh, larger than themselves: coarse or flared pieces of stems.
void find_bearing(Voter& voter) {
    std::vector<double> solid(voter.regions.size(), 0.0);  // area of what grows out of it and is no sheet
    voter.bears.assign(voter.regions.size(), 0);
    for (size_t r = voter.regions.size(); r-- > 0;) {
        const Region& region = voter.regions[r];
        voter.bears[r] = region.form == Form::SHEET && solid[r] > region.area;
        if (region.same_mesh && region.parent >= 0)
            solid[size_t(region.parent)] += solid[r] + (region.form == Form::SHEET ? 0 : region.area);
    }
}

// Bright parts are flowers or fruit only beside more of something else, else the plant has the colour of its season.
void find_bright_parts(Voter& voter) {
    std::vector<double> area(voter.surface.parts.size(), 0.0);
    double bright = 0, all = 0;
    for (const Region& region : voter.regions) {
        const Part& part = voter.surface.parts[size_t(region.part)];
        area[size_t(region.part)] += region.area;
        all += region.area;
        if (part.texture < 0 && part.color != Part().color && is_bright(part.color)) bright += region.area;
    }
    voter.bright.assign(area.size(), bright < 0.8 * all ? 1 : 0);
}

}  // namespace

FoundOrgans vote_on_organs(const Surface& surface, const Topology& topology, std::vector<std::string> named,
                           const std::vector<char>& crowns) {
    const Regions cut = find_regions(surface, topology);
    std::vector<char> sheets(surface.triangles.size());
    for (size_t t = 0; t < sheets.size(); t++) sheets[t] = cut.regions[size_t(cut.region_of[t])].form == Form::SHEET;
    find_cards(surface, topology, sheets, named);
    find_foliage(surface, named);
    const double height = surface.height();
    Voter voter{surface,
                cut.regions,
                named,
                surface.lower().y(),
                height,
                surface.size(),
                height > TREE_HEIGHT ? "branch" : "stem"};
    voter.has_wood = std::find(named.begin(), named.end(), "branch") != named.end();
    find_bearing(voter);
    voter.heads = find_heads(cut.regions, voter.foot, height);
    count_leaves(voter);
    for (size_t r = 0; r < cut.regions.size(); r++) voter.bare += is_bare(voter, r);
    voter.trust = weigh_names(surface, named);
    voter.crown = share_of_crowns(cut, crowns);
    find_bright_parts(voter);
    std::vector<FoundOrgan> found;
    for (size_t r = 0; r < cut.regions.size(); r++) {
        // What bears a hair comes before it.
        const int bearer = voter.heads.hair_of[r];
        const bool is_hair = bearer >= 0 && named[size_t(cut.regions[r].part)].empty();
        const Region& region = cut.regions[r];
        // The edge of a crown is no leaf.
        const bool is_edge = region.form == Form::SHEET && region.same_mesh && region.parent >= 0 &&
                             found[size_t(region.parent)].kind == "crown" &&
                             cut.regions[size_t(region.parent)].part == region.part;
        found.push_back(is_hair ? found[size_t(bearer)] : is_edge ? found[size_t(region.parent)] : vote(voter, r));
    }

    UnionFind sets = join_regions(surface, cut.regions, found);
    for (size_t r = 0; r < cut.regions.size(); r++)
        if (const int bearer = voter.heads.hair_of[r]; bearer >= 0 && found[r].kind == found[size_t(bearer)].kind)
            sets.join(int(r), bearer);
    FoundOrgans out;
    std::vector<int> number(cut.regions.size(), -1);
    std::vector<double> largest;
    for (size_t r = 0; r < cut.regions.size(); r++) {
        int& organ = number[size_t(sets.find(int(r)))];
        if (organ < 0) {
            organ = int(out.organs.size());
            out.organs.push_back(found[r]);
            largest.push_back(cut.regions[r].area);
        } else if (cut.regions[r].area > largest[size_t(organ)]) {
            // The largest region speaks for the organ.
            out.organs[size_t(organ)] = found[r];
            largest[size_t(organ)] = cut.regions[r].area;
        }
    }
    for (int r : cut.region_of) out.organ_of.push_back(number[size_t(sets.find(r))]);
    return out;
}

}  // namespace frond
