// In: a model's sections. Out: which of its capsules are flat, with their widths and thicknesses.
#include <cmath>

#include "model/model.hpp"
#include "plant/flat.hpp"

namespace frond {

TetSpread spread_of(const Model& model, int node, const Vec3& direction) {
    const int ends[2] = {model.chain.nodes[size_t(node)].parent, node};
    TetSpread spread;
    for (size_t k = 0; k < 2; k++) {
        const Tet& corners = model.cage.tets[size_t(model.chain_embedding.tet[size_t(ends[k])])];
        Mat3 edges;
        for (int c = 0; c < 3; c++)
            edges.col(c) = model.cage.nodes[size_t(corners[size_t(c) + 1])] - model.cage.nodes[size_t(corners[0])];
        const Vec3 share = edges.inverse() * direction;
        spread[k] = {-share.sum(), share[0], share[1], share[2]};
    }
    return spread;
}

std::vector<Flat> make_flats(const Model& model) {
    constexpr double FLAT = 2.5, NARROW = 0.004;  // least width over thickness [-]; least half width [m]
    std::vector<Flat> flats(model.capsules.size());
    for (size_t i = 0; i < flats.size(); i++) {
        const auto& [begin, end] = model.capsules[i];
        const ChainNode& node = model.chain.nodes[size_t(end)];
        if (begin == end || node.organ < 0 || !is_sheet(model.organs[size_t(node.organ)])) continue;
        if (std::abs(node.radius - node.fitted_radius) > 1e-9) continue;
        const Section& section = model.sections[size_t(end)];
        const double half_width = std::sqrt(3 * section.inertia_wide / section.area);
        const double half_thickness = std::sqrt(3 * section.inertia_thin / section.area);
        if (half_width < std::max(NARROW, FLAT * half_thickness)) continue;
        flats[i].half_width = half_width;
        flats[i].half_thickness = half_thickness;
        flats[i].wide = (section.wide() - section.axis * section.axis.dot(section.wide())).normalized();
        flats[i].spread = spread_of(model, end, flats[i].wide);
    }
    return flats;
}

}  // namespace frond
