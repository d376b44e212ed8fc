// In: a model whose cage is softer in tension than its organs, and a plant of it. Out: its fibres, and which of them
// are taut.
#include "plant/fibre_rows.hpp"

#include <algorithm>
#include <map>

#include "cage/tet_geometry.hpp"
#include "plant/follow.hpp"
#include "plant/plant.hpp"

namespace frond {

namespace {

constexpr double SLACK = 0.03;  // stretch that is not resisted [-]

// Returns the share of each organ's tensile stiffness that its cage lacks [-].
std::vector<double> lack_of_organs(const Model& model, int order) {
    std::vector<double> tissue(model.organs.size(), 0.0), cage(model.organs.size(), 0.0);
    for (size_t i = 0; i < model.chain.nodes.size(); i++) {
        const ChainNode& node = model.chain.nodes[i];
        if (node.parent >= 0 && node.organ >= 0)
            tissue[size_t(node.organ)] += model.sections[i].stretching() * model.sections[i].length;
    }
    for (size_t e = 0; e < model.cage.tets.size(); e++)
        cage[size_t(model.cage.tet_organ[e])] +=
            model.young_of(order)[e] * std::abs(tet_volume(model.cage.nodes, model.cage.tets[e]));
    for (size_t i = 0; i < tissue.size(); i++) tissue[i] = tissue[i] > 0 ? 1 - cage[i] / tissue[i] : 0;
    return tissue;
}

// Adds rows from each grabbed vertex to both ends of its capsule.
void add_rows_of_grabs(const Plant& plant, std::vector<FibreRow>& rows) {
    const Model& model = *plant.model;
    const Fibres& fibres = *plant.fibres;
    for (const Grab& grab : plant.input.grabs) {
        const int node = model.chain.vertex_node[size_t(grab.vertex)], fibre = fibres.of_node[size_t(node)];
        if (fibre < 0 || fragment_of_vertex(plant, size_t(grab.vertex))) continue;
        for (const int end : {node, model.chain.nodes[size_t(node)].parent}) {
            const Vec3& place = model.chain.nodes[size_t(end)].position;
            const double length = (model.surface.positions[size_t(grab.vertex)] - place).norm();
            rows.push_back({chain_attachment(plant, end), vertex_attachment(plant, grab.vertex), (1 + SLACK) * length,
                            fibres.list[size_t(fibre)].stiffness});
        }
    }
}

// Returns the length of a row over that from which it pulls [-].
double drawn_out(const Plant& plant, const FibreRow& row) {
    const VecX& x = plant.state.motion.x;
    return (attachment_place(row.end, x) - attachment_place(row.begin, x)).norm() / row.length;
}

// Adds rows from nodes that a force of the host pulls to both ends of their fibre, of several nodes of one from that
// which is drawn out most: tissue holds what pulls at a point of an organ to the organ. Returns whether one is taut.
bool add_rows_of_forces(const Plant& plant, std::vector<FibreRow>& rows) {
    if (!plant.input.has_user_force) return false;
    const Fibres& fibres = *plant.fibres;
    std::map<std::array<int, 2>, FibreRow> most;  // by fibre and end
    const VecX& given = plant.input.forces->on_nodes;
    for (int n = 0; n < given.size() / 3; n++) {
        const int fibre = fibres.of_cage_node[size_t(n)];
        if (fibre < 0 || point(given, n).isZero(0)) continue;
        const Fibre& tied = fibres.list[size_t(fibre)];
        if (fragment_of_chain_node(plant, size_t(tied.node))) continue;
        Attachment node;
        node.count = 1;
        node.node[0] = n;
        node.weight[0] = 1;
        for (const int end : {tied.node, plant.model->chain.nodes[size_t(tied.node)].parent}) {
            const Vec3& place = plant.model->chain.nodes[size_t(end)].position;
            const double length = (point(plant.nodes->modelled, n) - place).norm();
            if (!(length > 0)) continue;
            const FibreRow row = {chain_attachment(plant, end), node, (1 + SLACK) * length, tied.stiffness};
            const auto [known, is_new] = most.insert({{fibre, end}, row});
            if (!is_new && drawn_out(plant, row) > drawn_out(plant, known->second)) known->second = row;
        }
    }
    bool any = false;
    for (const auto& [place, row] : most) {
        any = any || drawn_out(plant, row) > 1;
        rows.push_back(row);
    }
    return any;
}

// Returns the present length of a fibre over its slack length [-].
double drawn_out(const Plant& plant, const Fibre& fibre) {
    const std::vector<Vec3>& places = plant.view.chain_positions;
    const size_t node = size_t(fibre.node), parent = size_t(plant.model->chain.nodes[node].parent);
    return (places[node] - places[parent]).norm() / fibre.length;
}

}  // namespace

std::vector<FibreRow> find_fibre_rows(const Plant& plant) {
    constexpr double NEARLY = 0.985;  // length over that of a taut fibre [-]
    std::vector<FibreRow> rows;
    const std::vector<Fibre>& list = plant.fibres->list;
    bool any = false;
    for (size_t i = 0; i < list.size(); i++) {
        const Fibre& fibre = list[i];
        const double give = plant.state.fibre_give.empty() ? 1 : plant.state.fibre_give[i],
                     drawn = drawn_out(plant, fibre) / give;
        if (!(drawn > NEARLY) || fragment_of_chain_node(plant, size_t(fibre.node))) continue;
        any = any || drawn > 1;
        const int parent = plant.model->chain.nodes[size_t(fibre.node)].parent;
        rows.push_back({chain_attachment(plant, parent), chain_attachment(plant, fibre.node), give * fibre.length,
                        fibre.stiffness});
    }
    any |= add_rows_of_forces(plant, rows);
    if (!any) return {};
    add_rows_of_grabs(plant, rows);
    return rows;
}

void let_fibres_give(Plant& plant, double h) {
    constexpr double RATE = 0.02;  // [1/s]
    const std::vector<Fibre>& list = plant.fibres->list;
    if (plant.state.is_entangled) plant.state.fibre_give.resize(list.size(), 1);
    bool gives = false;
    for (size_t i = 0; i < plant.state.fibre_give.size(); i++) {
        double& give = plant.state.fibre_give[i];
        give = plant.state.is_entangled ? std::max(give, drawn_out(plant, list[i])) : std::max(1.0, give - RATE * h);
        gives = gives || give > 1;
    }
    if (!gives) plant.state.fibre_give.clear();
}

Fibres make_fibres(const Model& model, const TetNodes& nodes, const VecX& modelled) {
    constexpr double LEAST = 0.5;  // share of an organ's tensile stiffness that its cage has to lack [-]
    Fibres fibres;
    fibres.of_node.assign(model.chain.nodes.size(), -1);
    if (!model.calibrated) return fibres;
    const std::vector<double> lack = lack_of_organs(model, nodes.order);
    for (size_t i = 0; i < model.chain.nodes.size(); i++) {
        const ChainNode& node = model.chain.nodes[i];
        if (node.parent < 0 || node.organ < 0 || lack[size_t(node.organ)] < LEAST) continue;
        const double length = (node.position - model.chain.nodes[size_t(node.parent)].position).norm();
        if (!(length > 0)) continue;
        fibres.of_node[i] = int(fibres.list.size());
        fibres.list.push_back(
            {int(i), (1 + SLACK) * length, lack[size_t(node.organ)] * model.sections[i].stretching() / length});
    }
    if (fibres.list.empty()) return fibres;
    for (const int capsule : nearest_capsules(model, nodes, modelled))
        fibres.of_cage_node.push_back(capsule < 0 ? -1 : fibres.of_node[size_t(capsule)]);
    return fibres;
}

bool are_slack(Plant& plant) {
    if (!plant.fibres) return true;
    update_chain(plant);
    return find_fibre_rows(plant).empty();
}

}  // namespace frond
