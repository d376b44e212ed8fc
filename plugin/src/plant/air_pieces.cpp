// In: a model's chain, sections and organs. Out: the areas of each capsule in the air, and its drag coefficient.
//
// Coefficients where the material gives none:
//   blades, flowers  finite flat plates: 1.10 + 0.02 (a + 1 / a), a length over width, at most an endless plate's 1.98
//                    (Hoerner 1965, "Fluid-dynamic drag", chapter 3)
//   fruits           spheres, by Reynolds number, see air_resistance.cpp
//   crowns           0.4: whole crowns in a wind tunnel, by their area in still air, have 0.2-0.6 in winds of 10-25 m/s
//                    (Mayhead 1973, Agric. Meteorol. 12, 123-130; Vollsinger et al. 2005, Can. J. For. Res. 35)
//   all others       cylinders, by Reynolds number
#include <algorithm>
#include <cmath>

#include "plant/air.hpp"

namespace frond {

namespace {

// Sizes of an organ, from all its capsules.
struct OrganSize {
    double length = 0;   // [m]
    double sheet = 0;    // width times length [m^2]
    double section = 0;  // largest cross-section, as an ellipse [m^2]
};

size_t organ_of(const Model& model, size_t node) {
    return size_t(std::max(model.chain.nodes[node].organ, 0));
}

std::vector<OrganSize> organ_sizes(const Model& model) {
    std::vector<OrganSize> sizes(model.organs.size());
    for (size_t i = 0; i < model.chain.nodes.size(); i++) {
        if (model.chain.nodes[i].parent < 0) continue;
        const Section& section = model.sections[i];
        OrganSize& size = sizes[organ_of(model, i)];
        size.length += section.length;
        size.sheet += section.width * section.length;
        size.section = std::max(size.section, PI / 4 * section.width * section.thickness);
    }
    return sizes;
}

AirShape shape_of(const Organ& organ) {
    if (is_sheet(organ)) return AirShape::SHEET;
    return organ.kind == "fruit" || organ.kind == "crown" ? AirShape::COMPACT : AirShape::ROUND;
}

double coefficient_of(const Organ& organ, const OrganSize& size) {
    constexpr double CROWN = 0.4, ENDLESS_PLATE = 1.98;  // sources above [-]
    if (organ.material.drag > 0) return organ.material.drag;
    if (organ.kind == "crown") return CROWN;
    if (!is_sheet(organ)) return 0;
    const double aspect = size.length * size.length / size.sheet;
    return std::min(1.10 + 0.02 * (aspect + 1 / aspect), ENDLESS_PLATE);
}

}  // namespace

AirPieces make_air_pieces(const Model& model) {
    const std::vector<OrganSize> sizes = organ_sizes(model);
    AirPieces pieces;
    for (size_t i = 0; i < model.chain.nodes.size(); i++) {
        const int parent = model.chain.nodes[i].parent;
        if (parent < 0) continue;
        const Organ& organ = model.organs[organ_of(model, i)];
        const OrganSize& size = sizes[organ_of(model, i)];
        const Section& section = model.sections[i];
        AirPiece piece;
        piece.node = int(i);
        piece.parent = parent;
        piece.shape = shape_of(organ);
        piece.coefficient = coefficient_of(organ, size);
        const double end = piece.shape == AirShape::COMPACT ? size.section * section.length / size.length : 0;
        const double seen = seen_share(organ);
        piece.area = seen * Vec3(end, section.width * section.length, section.thickness * section.length);
        piece.size = section.width;
        // An ellipse's perimeter is approximated by that of the circle of its root mean square diameter.
        const double rim =
            piece.shape == AirShape::SHEET
                ? 2 * section.width
                : PI * std::sqrt((section.width * section.width + section.thickness * section.thickness) / 2);
        piece.skin = seen * rim * section.length;
        piece.chord_along = size.length;
        piece.chord_across = section.width;
        piece.wide = (section.wide() - section.axis * section.axis.dot(section.wide())).normalized();
        piece.spread = spread_of(model, int(i), piece.wide);
        pieces.push_back(piece);
    }
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const AirPiece& a, const AirPiece& b) { return a.shape < b.shape; });
    return pieces;
}

}  // namespace frond
