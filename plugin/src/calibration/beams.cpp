#include "calibration/beams.hpp"

namespace frond {
namespace {

// Returns whether two sections could be of one beam.
bool are_alike(const Section& a, const Section& b) {
    constexpr double MOST = 4;  // ratio of their bending stiffnesses [-]
    const auto are_near = [](double x, double y) { return x < MOST * y && y < MOST * x; };
    return are_near(a.bending_thin(), b.bending_thin()) && are_near(a.bending_wide(), b.bending_wide());
}

// Returns whether the segment that ends in a node goes on, as a beam of one kind, with that of one of its children.
bool goes_on(const Model& model, size_t node, size_t child) {
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    if (nodes[node].parent < 0 || nodes[node].organ < 0 || nodes[child].organ < 0) return false;
    return nodes[node].organ == nodes[child].organ ||
           (model.organs[size_t(nodes[node].organ)].kind == model.organs[size_t(nodes[child].organ)].kind &&
            are_alike(model.sections[node], model.sections[child]));
}

// Returns the organ that each organ continues; -1: none.
std::vector<int> continued_organs(const Model& model) {
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    std::vector<int> begins(model.organs.size(), 0), ways_on(nodes.size(), 0), before(model.organs.size(), -1);
    for (size_t i = 0; i < nodes.size(); i++) {
        const int parent = nodes[i].parent, organ = nodes[i].organ;
        if (organ >= 0 && (parent < 0 || nodes[size_t(parent)].organ != organ)) begins[size_t(organ)]++;
        if (parent >= 0) ways_on[size_t(parent)] += goes_on(model, size_t(parent), i);
    }
    for (size_t i = 0; i < nodes.size(); i++) {
        const int parent = nodes[i].parent, organ = nodes[i].organ;
        if (parent < 0 || organ < 0 || begins[size_t(organ)] != 1 || ways_on[size_t(parent)] != 1) continue;
        if (nodes[size_t(parent)].organ != organ && goes_on(model, size_t(parent), i))
            before[size_t(organ)] = nodes[size_t(parent)].organ;
    }
    return before;
}

}  // namespace

Model join_beams(const Model& model) {
    Model joined = model;
    const std::vector<int> before = continued_organs(model);
    const auto first = [&](int organ) {
        while (organ >= 0 && before[size_t(organ)] >= 0) organ = before[size_t(organ)];
        return organ;
    };
    for (size_t i = 0; i < joined.chain.nodes.size(); i++) {
        int& organ = joined.chain.nodes[i].organ;
        if (organ < 0) continue;
        joined.sections[i].young *= model.organ_stiffer[size_t(organ)];
        joined.sections[i].shear *= model.organ_stiffer[size_t(organ)];
        organ = first(organ);
    }
    for (int& organ : joined.cage.tet_organ) organ = first(organ);
    joined.organ_stiffer.assign(model.organ_stiffer.size(), 1.0);
    return joined;
}

}  // namespace frond
