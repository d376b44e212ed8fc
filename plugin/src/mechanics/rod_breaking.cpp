// In: rods and their nodes' positions and rotations. Out: the strain of each capsule's outermost fibre, and rods
// without those of a part that broke off. Strains by tension and by bending add up at the fibre; twist does not count.
#include <algorithm>

#include "mechanics/rod_elements.hpp"
#include "mechanics/rows.hpp"
#include "mechanics/sections.hpp"

namespace frond {

void rod_section_strains(const Elements& body, const VecX& x, std::vector<double>& out) {
    const RodElements& elements = as_rods(body);
    const std::vector<RodStrain> strains = rod_strains(elements, x);
    out.assign(elements.mass.size(), 0);
    for (size_t s = 0; s < strains.size(); ++s) {
        double& most = out[size_t(elements.section[s])];
        most = std::max(most, fibre_strain(elements.segments[s], strains[s]).sum());
    }
}

// The mass of a segment's second node goes with it, and its first node keeps its own.
std::unique_ptr<Elements> without_rods(const Elements& body, const std::vector<uint8_t>& gone) {
    auto own = std::make_unique<RodElements>(as_rods(body));
    const auto is_gone = [&](size_t s) {
        const RodSegment& rod = as_rods(body).segments[s];
        return gone[size_t(rod.b)] || (rod.closes_loop && gone[size_t(rod.a)]);
    };
    for (const int node : own->section) {
        if (!gone[size_t(node)]) continue;
        own->mass[size_t(node)] = 0;
        own->inertia[size_t(node)].setZero();
    }
    keep_others(own->damping_ratio, is_gone);
    keep_others(own->yields, is_gone);
    keep_others(own->segments, is_gone);
    keep_others(own->hardening, is_gone);
    keep_others(own->section, is_gone);
    find_roots(*own);
    return own;
}

}  // namespace frond
