// In: elements and their nodes' positions. Out: the capsule of the chain that breaks. A section breaks when its
// outermost fibre is strained by more than the strength of the organ's material over its modulus.
#include "mechanics/sections.hpp"

#include <algorithm>
#include <cmath>

namespace frond {

static double distance_to_capsule(const Model& model, size_t node, const Vec3& p) {
    const Vec3& b = model.chain.nodes[node].position;
    const Vec3 along = model.chain.nodes[size_t(model.chain.nodes[node].parent)].position - b;
    const double share = std::clamp((p - b).dot(along) / std::max(along.squaredNorm(), 1e-30), 0.0, 1.0);
    return (p - b - share * along).squaredNorm();
}

std::vector<int> capsules_of_tets(const Model& model) {
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    std::vector<int> capsule;
    for (size_t e = 0; e < model.cage.tets.size(); ++e) {
        Vec3 middle = Vec3::Zero();
        for (int corner : model.cage.tets[e]) middle += 0.25 * model.cage.nodes[size_t(corner)];
        double least = INFINITY;
        size_t nearest = 0;
        bool own = false;
        for (size_t i = 0; i < nodes.size(); ++i) {
            if (nodes[i].parent < 0) continue;
            const bool is_own = nodes[i].organ == model.cage.tet_organ[e];
            const double distance = distance_to_capsule(model, i, middle);
            if (is_own < own || (is_own == own && distance >= least)) continue;
            own = is_own;
            least = distance;
            nearest = i;
        }
        capsule.push_back(int(nearest));
    }
    return capsule;
}

void let_break(const Model& model, const Mechanics& row, Elements& elements) {
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    std::vector<double> breaking(nodes.size(), 0), standing;
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].parent < 0 || model.organs.empty()) continue;
        const Material& material = model.organs[size_t(std::max(nodes[i].organ, 0))].material;
        breaking[i] = material.strength / material.young;
    }
    if (std::all_of(breaking.begin(), breaking.end(), [](double strain) { return strain == 0; })) return;
    row.section_strains(elements, elements.modelled, standing);
    for (size_t i = 0; i < nodes.size(); ++i)
        if (breaking[i] > 0) breaking[i] = firm_strain(breaking[i], standing[i]);
    elements.breaking = std::move(breaking);
}

int find_overload(const Mechanics& row, const Elements& elements, const VecX& x) {
    if (elements.breaking.empty()) return -1;
    std::vector<double> strains;
    row.section_strains(elements, x, strains);
    int worst = -1;
    double most = 1;
    for (size_t i = 0; i < strains.size(); ++i) {
        const double load = elements.breaking[i] > 0 ? strains[i] / elements.breaking[i] : 0;
        if (!(load > most)) continue;
        most = load;
        worst = int(i);
    }
    return worst;
}

}  // namespace frond
