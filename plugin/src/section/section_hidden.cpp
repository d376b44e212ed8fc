// Sections of what a mesh does not show: wood within crowns, and the soil that holds roots.
#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"
#include "section/section_parts.hpp"

namespace frond {

// Wood goes on within a crown: it carries the crown as the branch below does, and thins towards the crown's end.
void carry_crowns(const Chain& chain, const std::vector<Organ>& organs, std::vector<Section>& sections) {
    constexpr double AT_END = 0.3;  // radius of the wood there, over that where it enters the crown
    const auto is_crown = [&](const ChainNode& node) {
        return node.organ >= 0 && organs[size_t(node.organ)].kind == "crown" && !organs[size_t(node.organ)].young_given;
    };
    std::vector<double> farthest(organs.size(), 0.0), bending(chain.nodes.size(), 0.0), begin(bending);
    for (const ChainNode& node : chain.nodes)
        if (is_crown(node)) farthest[size_t(node.organ)] = std::max(farthest[size_t(node.organ)], node.distance);
    for (size_t i = 0; i < chain.nodes.size(); i++) {
        const ChainNode& node = chain.nodes[i];
        if (!is_crown(node) || node.parent < 0) continue;
        const size_t parent = size_t(node.parent);
        const bool goes_on = is_crown(chain.nodes[parent]);
        bending[i] = goes_on ? bending[parent] : sections[parent].bending_thin();
        begin[i] = goes_on ? begin[parent] : chain.nodes[parent].distance;
        if (chain.nodes[parent].parent < 0) bending[i] = 0;
        const double way = farthest[size_t(node.organ)] - begin[i];
        const double share = way > 0 ? std::clamp((node.distance - begin[i]) / way, 0.0, 1.0) : 1;
        const double wood = bending[i] * frond::pow(1 - (1 - AT_END) * share, 4);
        Section& section = sections[i];
        section.inertia_thin = std::max(section.inertia_thin, wood / section.young);
        section.inertia_wide = std::max(section.inertia_wide, wood / section.young);
        section.torsion = std::max(section.torsion, wood / material_preset("branch")->twist_to_bend / section.shear);
        // EA of a round rod by its EI; the foliage around it weighs what it did.
        const double area = 2 * std::sqrt(PI * material_preset("branch")->young * wood) / section.young;
        if (area <= section.area) continue;
        section.density *= section.area / area;
        section.area = area;
    }
}

// A swollen root stands in the soil, which holds the thin part below its widest place as that would.
void hold_roots(const Chain& chain, const std::vector<Organ>& organs, std::vector<Section>& sections) {
    std::vector<size_t> widest(organs.size(), 0);
    const auto is_root = [&](size_t i) {
        const ChainNode& node = chain.nodes[i];
        return node.parent >= 0 && node.organ >= 0 && organs[size_t(node.organ)].kind == "root";
    };
    for (size_t i = 0; i < sections.size(); i++) {
        if (!is_root(i)) continue;
        size_t& most = widest[size_t(chain.nodes[i].organ)];
        if (!is_root(most) || sections[i].inertia_thin > sections[most].inertia_thin) most = i;
    }
    for (size_t most : widest) {
        if (!is_root(most)) continue;
        size_t i = most;
        while (chain.nodes[i].parent >= 0) i = size_t(chain.nodes[i].parent);
        if (chain.nodes[i].organ != chain.nodes[most].organ) continue;
        for (i = most; is_root(i); i = size_t(chain.nodes[i].parent)) {
            sections[i].inertia_thin = sections[most].inertia_thin;
            sections[i].inertia_wide = sections[most].inertia_wide;
            sections[i].torsion = sections[most].torsion;
        }
    }
}

}  // namespace frond
