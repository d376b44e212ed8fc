// A leaf that a file shows as a bare sheet is carried by a midrib in life. Plants make it as thick as its load asks, so
// that it bends about equally along its length; it is thickest at the base, where many drawn leaves are narrowest. So
// where an organ of a chosen material could by far not carry itself, a round rib of that thickness is put into its
// sections: of a midrib's tissue, and never thicker than a share of the leaf's width at its widest. Twigs, which many
// trees draw as part of their trunk, and stalks of flowers, drawn to a point, are thinner than what hangs on them asks:
// they get tissue in the same way.
#include "calibration/hidden_ribs.hpp"

#include <algorithm>
#include <array>

#include "calibration/weigh.hpp"
#include "core/elementary.hpp"

namespace frond {

Turns find_turns(const Model& model) {
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    const Weights weights = weigh(model, hang_tets(model));
    Turns turns{std::vector<double>(nodes.size(), 0.0), std::vector<double>(model.organs.size(), 0.0)};
    for (int axis = 0; axis < 3; axis++) {
        const Vec3 load = GRAVITY * Vec3::Unit(axis);
        std::vector<Vec3> force(nodes.size()), moment(nodes.size());
        for (size_t i = 0; i < nodes.size(); i++) {
            force[i] = weights.mass[i] * load;
            moment[i] = weights.moment[i].cross(load);
        }
        std::vector<double> curvature(nodes.size(), 0.0), turn(nodes.size(), 0.0);
        for (size_t i = nodes.size(); i-- > 0;) {
            if (nodes[i].parent < 0) continue;
            const size_t parent = size_t(nodes[i].parent);
            const Section& section = model.sections[i];
            const Vec3 middle = 0.5 * (nodes[i].position + nodes[parent].position);
            force[parent] += force[i];
            moment[parent] += moment[i];
            // What hangs is not turned over by a push: its weight brings it back.
            const Vec3 M = moment[i] - middle.cross(force[i]);
            if (axis != 1 && M.dot(Vec3::UnitY().cross(load)) < 0) continue;
            curvature[i] = frond::hypot(M.dot(section.wide()) / section.bending_thin(),
                                        M.dot(section.thin) / section.bending_wide());
            turns.moment[i] = std::max(turns.moment[i], M.norm());
        }
        for (size_t i = 0; i < nodes.size(); i++) {
            if (nodes[i].parent < 0) continue;
            const size_t parent = size_t(nodes[i].parent), organ = size_t(nodes[i].organ);
            turn[i] =
                model.sections[i].length * curvature[i] + (nodes[parent].organ == nodes[i].organ ? turn[parent] : 0.0);
            turns.organ[organ] = std::max(turns.organ[organ], turn[i]);
        }
    }
    return turns;
}

namespace {

// Leaves have midribs, stalks go on within fruits and to the tips of tassels, and wood in twigs; petals are stiff by
// the pressure of their water.
bool hides_a_rib(const Organ& organ) {
    constexpr std::array KINDS = {"blade", "fruit", "branch", "peduncle"};
    const bool may_hide = std::find(KINDS.begin(), KINDS.end(), organ.kind) != KINDS.end();
    return may_hide && !organ.young_given && !organ.midrib_given;
}

// Organs whose ribs may be thickened, with the sizes that limit them.
struct Bearer {
    bool may_grow = false;
    double widest = 0, begin = INFINITY, end = 0;  // [m]; the last two along the chain from the root
};

std::vector<Bearer> list_bearers(const Model& model, const std::vector<double>& load) {
    std::vector<Bearer> bearers(model.organs.size());
    for (size_t o = 0; o < bearers.size(); o++)
        bearers[o].may_grow = load[o] > 0 && hides_a_rib(model.organs[o]) &&
                              std::count(model.chain.rib_of.begin(), model.chain.rib_of.end(), int(o)) == 0;
    for (size_t i = 0; i < model.chain.nodes.size(); i++) {
        const ChainNode& node = model.chain.nodes[i];
        if (node.parent < 0 || node.organ < 0) continue;
        Bearer& bearer = bearers[size_t(node.organ)];
        bearer.widest = std::max(bearer.widest, model.sections[i].width);
        bearer.begin = std::min(bearer.begin, node.distance - model.sections[i].length);
        bearer.end = std::max(bearer.end, node.distance);
    }
    return bearers;
}

}  // namespace

bool grow_hidden_ribs(Model& model, const std::vector<double>& load, double turn) {
    constexpr double MOST = 0.2;  // diameter of a rib over the width of its leaf: petioles of narrow leaves are thicker
    const Turns turns = find_turns(model);
    const std::vector<Bearer> bearers = list_bearers(model, load);
    bool grown = false;
    for (size_t i = 0; i < model.chain.nodes.size(); i++) {
        const ChainNode& node = model.chain.nodes[i];
        if (node.parent < 0 || node.organ < 0) continue;
        const Bearer& bearer = bearers[size_t(node.organ)];
        if (!bearer.may_grow) continue;
        grown = true;
        Section& section = model.sections[i];
        const Material& rib = *material_preset("midrib");
        const double young = std::max(rib.young, section.young);
        const double most = young * PI * frond::pow(MOST * bearer.widest, 4) / 64;
        const double moment = load[size_t(node.organ)] * turns.moment[i];
        const double bending = std::min(moment * (bearer.end - bearer.begin) / turn, most);
        section.inertia_thin = std::max(section.inertia_thin, bending / section.young);
        section.inertia_wide = std::max(section.inertia_wide, section.inertia_thin);
        section.torsion = std::max(section.torsion, bending / rib.twist_to_bend / section.shear);
    }
    return grown;
}

}  // namespace frond
