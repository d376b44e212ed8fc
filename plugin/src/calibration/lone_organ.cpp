// In: a plant's cage, the organs of its tets, and the chain, which shows which organ grows out of which. Out: each
// organ alone.
#include "calibration/lone_organ.hpp"

#include <algorithm>

#include "cage/tet_geometry.hpp"
#include "calibration/firm_tets.hpp"
#include "calibration/weigh.hpp"

namespace frond {
namespace {

// Returns the organ that most of an organ's segments grow out of; -1 for one that stands on the ground.
std::vector<int> organ_parents(const Model& model) {
    std::vector<std::map<int, int>> votes(model.organs.size());
    for (const ChainNode& node : model.chain.nodes) {
        const int below = node.parent >= 0 ? model.chain.nodes[size_t(node.parent)].organ : -1;
        if (below != node.organ) votes[size_t(node.organ)][below]++;
    }
    std::vector<int> parents(model.organs.size(), -1);
    for (size_t o = 0; o < votes.size(); o++) {
        int most = 0;
        for (const auto& [below, count] : votes[o])
            if (count > most) {
                most = count;
                parents[o] = below;
            }
    }
    return parents;
}

// Returns the mass of each organ's tets [kg].
std::vector<double> tet_masses(const Model& model) {
    std::vector<double> masses(model.organs.size(), 0.0);
    for (size_t e = 0; e < model.cage.tets.size(); e++)
        masses[size_t(model.cage.tet_organ[e])] +=
            model.tet_density[e] * tet_volume(model.cage.nodes, model.cage.tets[e]);
    return masses;
}

std::vector<std::vector<int>> node_organs(const Cage& cage) {
    std::vector<std::vector<int>> organs(cage.nodes.size());
    for (size_t e = 0; e < cage.tets.size(); e++)
        for (int corner : cage.tets[e]) {
            std::vector<int>& list = organs[size_t(corner)];
            if (std::find(list.begin(), list.end(), cage.tet_organ[e]) == list.end()) list.push_back(cage.tet_organ[e]);
        }
    return organs;
}

// Keeps the tets of a body for which `keep` holds.
void keep_tets(LoneOrgan& lone, const std::vector<char>& keep) {
    Model& model = lone.model;
    size_t kept = 0;
    for (size_t e = 0; e < keep.size(); e++) {
        if (!keep[e]) continue;
        model.cage.tets[kept] = model.cage.tets[e];
        model.cage.tet_organ[kept] = model.cage.tet_organ[e];
        lone.tets[kept] = lone.tets[e];
        for (std::vector<double>* constants : {&model.tet_density, &model.tet_young, &model.tet_poisson})
            (*constants)[kept] = (*constants)[e];
        kept++;
    }
    model.cage.tets.resize(kept);
    model.cage.tet_organ.resize(kept);
    lone.tets.resize(kept);
    for (std::vector<double>* constants : {&model.tet_density, &model.tet_young, &model.tet_poisson})
        constants->resize(kept);
}

// Takes away tets that nothing holds or that swing on a hinge; their mass goes to the nodes to which they are attached.
void drop_loose_tets(LoneOrgan& lone) {
    Model& model = lone.model;
    const std::vector<char> firm = find_firm_tets(model.cage, model.root);
    std::vector<char> used(model.cage.nodes.size(), 0);
    for (size_t e = 0; e < firm.size(); e++)
        if (firm[e])
            for (int corner : model.cage.tets[e]) used[size_t(corner)] = 1;
    double whole = 0, kept = 0;
    for (size_t e = 0; e < firm.size(); e++) {
        const Tet& tet = model.cage.tets[e];
        const double volume = tet_volume(model.cage.nodes, tet);
        whole += volume;
        if (firm[e]) {
            kept += volume;
            continue;
        }
        const auto shared = std::count_if(tet.begin(), tet.end(), [&](int corner) { return used[size_t(corner)]; });
        for (int corner : tet)
            if (used[size_t(corner)]) lone.borne[corner] += model.tet_density[e] * volume / double(shared);
    }
    keep_tets(lone, firm);
    for (size_t i = 0; i < used.size(); i++)
        if (!used[i]) model.root[i] = 1;
    lone.firm_share = whole > 0 ? kept / whole : 0;
}

// Data that all organs share.
struct Tree {
    std::vector<int> parents;
    std::vector<double> borne;
    std::vector<std::vector<int>> node_organs;
};

LoneOrgan take_organ(const Model& plant, int organ, const Tree& tree) {
    LoneOrgan lone = {};
    lone.organ = organ;
    std::vector<int> nodes;  // of the plant
    std::map<int, int> own;  // the plant's node -> the organ's
    for (size_t e = 0; e < plant.cage.tets.size(); e++) {
        if (plant.cage.tet_organ[e] != organ) continue;
        Tet tet = plant.cage.tets[e];
        for (int& corner : tet) {
            const auto [entry, is_new] = own.try_emplace(corner, int(nodes.size()));
            if (is_new) nodes.push_back(corner);
            corner = entry->second;
        }
        lone.tets.push_back(e);
        lone.model.cage.tets.push_back(tet);
        lone.model.cage.tet_organ.push_back(organ);
        lone.model.tet_density.push_back(plant.tet_density[e]);
        lone.model.tet_young.push_back(plant.tet_young[e]);
        lone.model.tet_poisson.push_back(plant.tet_poisson[e]);
    }
    std::map<int, std::vector<int>> shared;  // organ that grows out of it -> own nodes
    for (size_t i = 0; i < nodes.size(); i++) {
        const size_t node = size_t(nodes[i]);
        lone.model.cage.nodes.push_back(plant.cage.nodes[node]);
        bool held = plant.root[node];
        for (int other : tree.node_organs[node]) {
            held |= other == tree.parents[size_t(organ)];
            if (tree.parents[size_t(other)] == organ) shared[other].push_back(int(i));
        }
        lone.model.root.push_back(held);
    }
    for (const auto& [child, joint] : shared)
        for (int node : joint) lone.borne[node] += tree.borne[size_t(child)] / double(joint.size());
    drop_loose_tets(lone);
    return lone;
}

}  // namespace

bool LoneOrgan::is_sound() const {
    constexpr double MOST = 0.6;  // least share of an organ with which it can be calibrated alone [-]
    return !tets.empty() && firm_share >= MOST &&
           std::any_of(model.root.begin(), model.root.end(), [](uint8_t held) { return !held; });
}

std::vector<LoneOrgan> take_organs(const Model& plant) {
    Tree tree;
    tree.parents = organ_parents(plant);
    tree.borne = borne_masses(tet_masses(plant), tree.parents);
    tree.node_organs = node_organs(plant.cage);
    std::vector<LoneOrgan> organs;
    for (size_t o = 0; o < plant.organs.size(); o++) organs.push_back(take_organ(plant, int(o), tree));
    return organs;
}

}  // namespace frond
