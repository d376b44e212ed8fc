// Organ votes. In: regions, and the kinds that names mean. Out: organs.
// Each region collects votes, and the kind with most of them wins; no single one decides against all others:
//   its part is named after a kind                          3 for that kind, its material 2.5; 1 if all are named so
//   it is a sheet                                           2 for a blade
//   it is a flower by its place (organ_heads.cpp)           2 for a flower
//   it is a tube                                            2 for a stem, or a branch if the plant is higher than 3 m
//   it is a solid at a thin neck                            2 for a fruit, or 3 for a crown if it is large
//   it is a tube much thicker than what bears it            2 for a fruit, or a crown if it is large
//   it is a solid at the foot that bears leaves             3 for a root
//   it is a thin tube at whose end one leaf or few are      2.5 for a petiole
//   it is green                                             0.5 for a blade, 0.3 for a stem
//   it is dark and brown                                    1 for a branch, 2.5 less for a crown
//   it is bright and not green                              2 for a flower if a sheet, 1 for a fruit if a solid
//   its texture lets light through                          1 for a blade
// Then regions are joined to organs: see organ_join.cpp.
#include "skeleton/organ_votes.hpp"

#include <algorithm>
#include <cstdio>
#include <map>

#include "skeleton/organ_clues.hpp"
#include "skeleton/organ_evidence.hpp"
#include "skeleton/organ_join.hpp"
#include "skeleton/organ_look.hpp"

namespace frond {

namespace {

// Makes unnamed green parts of a plant with wood blades: they are foliage, however solid they were drawn.
void find_foliage(const Surface& surface, std::vector<std::string>& named) {
    if (std::find(named.begin(), named.end(), "branch") == named.end()) return;
    for (size_t i = 0; i < named.size(); i++) {
        const Part& part = surface.parts[i];
        const bool has_color = part.texture < 0 && part.color != Part().color;
        if (named[i].empty() && has_color && is_green(part.color)) named[i] = "blade";
    }
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

void vote_by_shape(const Evidence& plant, size_t r, Ballot& ballot) {
    const Region& region = plant.regions[r];
    const Vec3 size = region.box.sizes();
    if (is_rooted_tuber(plant, r) || is_point(plant, r))
        ballot.add("root", 3, sized("solid at the foot that bears leaves,", size.maxCoeff(), size.minCoeff()));
    else if (plant.crown[r] > 0.5 && !(region.form == Form::TUBE && region.solids > 0))
        ballot.add("crown", 3, sized("large round solid,", size.maxCoeff(), size.minCoeff()));
    else if (surrounds_wood(plant, region) || surrounds_trunk(plant, r))
        ballot.add("crown", 3, sized("foliage around wood,", size.maxCoeff(), size.minCoeff()));
    else if (plant.heads.flower[r])
        ballot.add("flower", 2, sized("flower at a stem's end,", size.maxCoeff(), size.minCoeff()));
    else if (plant.heads.swollen[r])
        ballot.add(is_crown(plant, region) ? "crown" : "fruit", 2,
                   sized("thicker than what bears it,", region.length, 2 * region.radius()));
    else if (region.form == Form::SHEET && !plant.bears[r])
        ballot.add("blade", 2, sized("sheet", region.length, region.length > 0 ? region.area / region.length : 0));
    else if (is_grass(plant, r))
        ballot.add("blade", 2, sized("one of many alike on the ground,", region.length, 2 * region.radius()));
    else if (is_petiole(plant, r))
        ballot.add("petiole", 2.5, sized("thin tube with a leaf at its end,", region.length, 2 * region.radius()));
    else if (is_thick_leaf(plant, region))
        ballot.add("blade", 2, sized("flat tube that bears nothing,", region.length, 2 * region.radius()));
    else if (region.form == Form::TUBE || plant.bears[r])
        ballot.add(plant.tube, 2, sized("tube", region.length, 2 * region.radius()));
    else if (bears_fruit(plant, region))
        ballot.add("crown", 3, sized("solid that bears others,", size.maxCoeff(), size.minCoeff()));
    else if (region.parent < 0 || is_post(plant, region) || is_arm(plant, region))
        ballot.add(plant.tube, 2, sized("solid that stands by itself,", size.maxCoeff(), size.minCoeff()));
    else if (is_crown(plant, region))
        ballot.add("crown", 3, sized("large solid at a thin neck,", size.maxCoeff(), size.minCoeff()));
    else
        ballot.add("fruit", 2, sized("solid at a thin neck,", size.maxCoeff(), size.minCoeff()));
}

void vote_by_look(const Evidence& plant, size_t r, Ballot& ballot) {
    const Region& region = plant.regions[r];
    const Part& part = plant.surface.parts[size_t(region.part)];
    if (part.texture >= 0) {
        constexpr double CUT_OUT = 0.9;  // largest opacity of what a picture cuts out [-]
        if (plant.opacity[r] < CUT_OUT) {
            char why[60];
            std::snprintf(why, sizeof why, "texture cuts out %.0f %%", 100 * (1 - plant.opacity[r]));
            ballot.add("blade", 1, why);
        }
        return;
    }
    if (part.color == Part().color) return;
    if (is_green(part.color)) {
        ballot.add("blade", 0.5, "green");
        ballot.add("stem", 0.3, "");
    } else if (is_brown(part.color)) {
        ballot.add("branch", 1, "brown");
        if (ballot.votes.count("crown")) ballot.add("crown", -2.5, "");
    } else if (region.form == Form::TUBE && region.solids > 0) {
        return;  // the stalk of a fruit has its colour
    } else if (is_bright(part.color) && plant.leaves[r] <= (region.form == Form::SHEET) &&
               plant.bright[size_t(region.part)] > 0) {
        if (region.form != Form::SOLID)
            ballot.add("flower", 2.5, "bright");
        else
            ballot.add("fruit", 1, "bright");
    }
}

FoundOrgan vote(const Evidence& plant, size_t r) {
    Ballot ballot;
    vote_by_shape(plant, r, ballot);
    const std::string& kind = plant.named[size_t(plant.regions[r].part)];
    // A solid crown is foliage, whatever it is called.
    const bool foliage = kind == "blade" && ballot.votes.count("crown");
    if (!kind.empty())
        ballot.add(foliage ? "crown" : kind, plant.trust[size_t(plant.regions[r].part)], "named " + kind);
    vote_by_look(plant, r, ballot);
    return ballot.result();
}

// Makes sheets crowns that are of one mesh and part with a much larger one: edges and torn pieces of it, no leaves.
void give_edges_to_crowns(const std::vector<Region>& regions, std::vector<FoundOrgan>& found) {
    constexpr double LARGER = 4;                   // area over area [-]
    std::map<std::pair<int, int>, size_t> crowns;  // the largest of each mesh and part
    for (size_t r = 0; r < regions.size(); r++) {
        if (found[r].kind != "crown") continue;
        size_t& crown = crowns.emplace(std::make_pair(regions[r].component, regions[r].part), r).first->second;
        if (regions[r].area > regions[crown].area) crown = r;
    }
    for (size_t r = 0; r < regions.size(); r++) {
        const auto crown = crowns.find({regions[r].component, regions[r].part});
        if (crown == crowns.end() || found[r].kind != "blade" || regions[r].form != Form::SHEET) continue;
        if (regions[crown->second].area > LARGER * regions[r].area) found[r] = found[crown->second];
    }
}

// Makes petioles whose sheet turned out to be a flower its stem.
void give_stems_to_flowers(const Evidence& plant, std::vector<FoundOrgan>& found) {
    std::vector<char> bears_leaf(found.size(), 0), bears_flower(found.size(), 0);
    for (size_t r = found.size(); r-- > 0;) {
        const int parent = plant.regions[r].parent;
        if (parent < 0) continue;
        bears_leaf[size_t(parent)] |= bears_leaf[r] || found[r].kind == "blade";
        bears_flower[size_t(parent)] |= bears_flower[r] || found[r].kind == "flower";
    }
    for (size_t r = 0; r < found.size(); r++)
        if (found[r].kind == "petiole" && bears_flower[r] && !bears_leaf[r]) {
            found[r].kind = plant.tube;
            found[r].why += "; bears a flower";
        }
}

}  // namespace

FoundOrgans vote_on_organs(const Surface& surface, const Topology& topology, std::vector<std::string> named,
                           const std::vector<char>& crowns) {
    const Regions cut = find_regions(surface, topology);
    std::vector<char> sheets(surface.triangles.size());
    for (size_t t = 0; t < sheets.size(); t++) sheets[t] = cut.regions[size_t(cut.region_of[t])].form == Form::SHEET;
    find_cards(surface, topology, sheets, named);
    find_foliage(surface, named);
    const Evidence plant = gather_evidence(surface, cut, named, crowns);
    std::vector<FoundOrgan> found;
    for (size_t r = 0; r < cut.regions.size(); r++) {
        // What bears a hair comes before it.
        const int bearer = plant.heads.hair_of[r];
        const bool is_hair = bearer >= 0 && named[size_t(cut.regions[r].part)].empty();
        found.push_back(is_hair ? found[size_t(bearer)] : vote(plant, r));
    }
    give_edges_to_crowns(cut.regions, found);
    give_stems_to_flowers(plant, found);

    UnionFind sets = join_regions(surface, cut.regions, found);
    for (size_t r = 0; r < cut.regions.size(); r++)
        if (const int bearer = plant.heads.hair_of[r]; bearer >= 0 && found[r].kind == found[size_t(bearer)].kind)
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