// In: a model. Out: a model of the same plant whose chain has other nodes.
#include "calibration/other_chain.hpp"

#include <algorithm>

#include "calibration/calibration.hpp"
#include "calibration/weigh.hpp"

namespace frond {

bool can_be_cut_anew(const Model& model) {
    return !model.stem_source.stems.empty();
}

std::shared_ptr<const Model> with_capsules(const Model& model, double height) {
    auto other = std::make_shared<Model>(model);
    const StemSource& source = other->stem_source;
    const frond_stem_section* own = source.sections.empty() ? nullptr : source.sections.data();
    other->rest_shapes = std::make_shared<RestShapes>();
    other->chain = make_chain_of_stems(source.stems.data(), int(source.stems.size()), other->surface, source.placed,
                                       other->organs, {height, source.radius, {}}, other->sections, {}, own);
    other->chain_embedding = {};
    other->organ_stiffer.assign(other->organs.size(), 1.0);
    give_mass(*other);
    if (other->stands_as_modelled) strengthen(*other);
    return other;
}

// Returns the section of a capsule's part between two shares of its length.
static Section part_of(const Section& whole, double from, double to) {
    const double size = 1 + whole.taper * (from + to - 1), square = size * size;
    Section part = whole;
    part.length *= to - from;
    part.area *= square;
    part.inertia_thin *= square * square;
    part.inertia_wide *= square * square;
    part.torsion *= square * square;
    part.thickness *= size;
    part.width *= size;
    part.taper *= (to - from) / size;
    return part;
}

// Returns which share of each capsule's mass by its section rods share between its ends, as their consistent masses do:
// a node that carries less than its sections say has no more to give.
static std::vector<double> shares_of_mass(const Model& model) {
    const size_t count = model.chain.nodes.size();
    std::vector<double> by_sections(count, 0.0), shares(count, 0.0);
    for (size_t i = 0; i < count; i++) {
        const int parent = model.chain.nodes[i].parent;
        if (parent < 0) continue;
        const Section& section = model.sections[i];
        const double mass = section.mass() * section.length;
        by_sections[size_t(parent)] += (1 - section.mass_at_end()) * mass;
        by_sections[i] += section.mass_at_end() * mass;
    }
    for (size_t i = 0; i < count; i++) {
        const int parent = model.chain.nodes[i].parent;
        if (parent < 0) continue;
        shares[i] = std::min(model.chain_mass[i] / by_sections[i],
                             model.chain_mass[size_t(parent)] / by_sections[size_t(parent)]);
    }
    return shares;
}

// Appends the parts of a capsule; `nodes` are the new numbers of the old nodes.
static void add_parts(const Model& model, size_t node, int parts, double share, std::vector<int>& nodes, Model& out) {
    const ChainNode& end = model.chain.nodes[node];
    const ChainNode begin = model.chain.nodes[size_t(end.parent)];
    const Section& section = model.sections[node];
    const double mass = share * section.mass() * section.length;
    int parent = nodes[size_t(end.parent)];
    out.chain_mass[size_t(parent)] -= (1 - section.mass_at_end()) * mass;
    for (int k = 1; k <= parts; k++) {
        const double to = double(k) / parts;
        ChainNode next = end;
        next.position = k == parts ? end.position : Vec3(begin.position + to * (end.position - begin.position));
        next.distance = begin.distance + to * (end.distance - begin.distance);
        next.parent = parent;
        const Section part = part_of(section, double(k - 1) / parts, to);
        const double own = share * part.mass() * part.length;
        out.chain_mass[size_t(parent)] += (1 - part.mass_at_end()) * own;
        out.chain_mass.push_back(part.mass_at_end() * own);
        out.sections.push_back(part);
        parent = int(out.chain.nodes.size());
        out.chain.nodes.push_back(next);
    }
    nodes[node] = parent;
    out.chain_mass.back() += model.chain_mass[node] - section.mass_at_end() * mass;
}

std::shared_ptr<const Model> with_cut_capsules(const Model& model, int parts) {
    auto out = std::make_shared<Model>();
    out->organs = model.organs;
    out->organ_stiffer = model.organ_stiffer;
    out->stands_as_modelled = model.stands_as_modelled;
    const std::vector<double> shares = shares_of_mass(model);
    std::vector<int> nodes(model.chain.nodes.size());
    for (size_t i = 0; i < nodes.size(); i++) {
        if (model.chain.nodes[i].parent >= 0) {
            add_parts(model, i, parts, shares[i], nodes, *out);
            continue;
        }
        nodes[i] = int(out->chain.nodes.size());
        out->chain.nodes.push_back(model.chain.nodes[i]);
        out->sections.push_back(model.sections[i]);
        out->chain_mass.push_back(model.chain_mass[i]);
    }
    for (const ChainLoop& loop : model.chain.loops)
        out->chain.loops.push_back({nodes[size_t(loop.below)], nodes[size_t(loop.above)]});
    for (double& mass : out->chain_mass) mass = std::max(mass, 0.0);
    return out;
}

}  // namespace frond
