// Attaches the chain to the cage and finds the nodes that the ground holds.
#include "modelling/attach.hpp"

#include <algorithm>

#include "cage/tet_geometry.hpp"
#include "core/lists.hpp"
#include "skeleton/organ_correct.hpp"

namespace frond {

// Holds the corners in the lower part of the cells around a foot: held up to the top of a coarse cell, a stem would be
// too short. If these are fewer than three or lie on one line, holds all corners.
static void hold_foot(const Cage& cage, double foot, const std::vector<int>& corners, std::vector<uint8_t>& root) {
    constexpr double SHARE = 0.35;  // share of the height from the foot to the top of its cells [-]
    double top = foot;
    for (int corner : corners) top = std::max(top, cage.nodes[size_t(corner)].y());
    std::vector<int> low;
    for (int corner : corners)
        if (cage.nodes[size_t(corner)].y() <= foot + SHARE * (top - foot)) low.push_back(corner);
    double widest = 0;
    for (int a : low)
        for (int b : low) {
            const Vec3 edge = cage.nodes[size_t(a)] - cage.nodes[size_t(low.front())];
            widest = std::max(widest, edge.cross(cage.nodes[size_t(b)] - cage.nodes[size_t(low.front())]).norm());
        }
    const bool holds = widest > 0.01 * (top - foot) * (top - foot);
    for (int corner : holds ? low : corners) root[size_t(corner)] = 1;
}

std::vector<uint8_t> find_root_nodes(const Model& model) {
    const Chain& chain = model.chain;
    const double reach = 0.02 * model.surface.height();
    std::vector<double> foot(chain.nodes.size(), INFINITY);
    for (size_t v = 0; v < chain.vertex_node.size(); v++) {
        double& lowest = foot[size_t(chain.vertex_node[v])];
        lowest = std::min(lowest, model.surface.positions[v].y());
    }
    // The corners of the tets that hold a foot, by chain root.
    std::vector<std::vector<int>> corners(chain.nodes.size());
    for (size_t v = 0; v < chain.vertex_node.size(); v++) {
        const size_t node = size_t(chain.vertex_node[v]);
        if (chain.nodes[node].parent >= 0 || model.surface.positions[v].y() > foot[node] + reach) continue;
        for (int corner : model.cage.tets[size_t(model.embedding.tet[v])]) corners[node].push_back(corner);
    }
    std::vector<uint8_t> root(model.cage.nodes.size(), 0);
    for (size_t node = 0; node < corners.size(); node++) {
        sort_unique(corners[node]);
        hold_foot(model.cage, foot[node], corners[node], root);
    }
    return root;
}

// Attaches each chain node to the tet in which it lies deepest, of those that carry its own vertices. Copies of cells
// that belong to other organs at the same position therefore do not move it.
static void embed_chain(Model& model) {
    const size_t count = model.chain.nodes.size();
    std::vector<std::vector<int>> tets(count);
    for (size_t v = 0; v < model.chain.vertex_node.size(); v++)
        tets[size_t(model.chain.vertex_node[v])].push_back(model.embedding.tet[v]);
    model.chain_embedding = {};
    for (size_t i = 0; i < count; i++) {
        // A node that is nearest to no vertex takes its parent's tets (parents come first).
        const int parent = model.chain.nodes[i].parent;
        if (tets[i].empty()) tets[i] = parent >= 0 ? tets[size_t(parent)] : model.embedding.tet;
        sort_unique(tets[i]);
        const auto [tet, weights] =
            deepest_in(model.cage.nodes, model.cage.tets, tets[i], model.chain.nodes[i].position);
        model.chain_embedding.tet.push_back(tet);
        model.chain_embedding.weights.push_back(weights);
    }
}

static void list_capsules(Model& model) {
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    std::vector<uint8_t> has_child(nodes.size(), 0);
    for (const ChainNode& node : nodes)
        if (node.parent >= 0) has_child[size_t(node.parent)] = 1;
    for (size_t i = 0; i < nodes.size(); i++) {
        if (nodes[i].parent >= 0)
            model.capsules.push_back({nodes[i].parent, int(i)});
        else if (!has_child[i])
            model.capsules.push_back({int(i), int(i)});
    }
}

void list_chain(Model& model) {
    list_capsules(model);
    model.organ_parents = find_parents(model.chain, model.organs.size());
    for (const ChainNode& node : model.chain.nodes) {
        for (int axis = 0; axis < 3; axis++) model.chain_view.positions.push_back(node.position[axis]);
        model.chain_view.radii.push_back(node.radius);
        model.chain_view.parents.push_back(node.parent);
    }
}

void bind_chain(Model& model) {
    embed_chain(model);
    list_chain(model);
}

}  // namespace frond
