// In: a model whose cage is softer in tension than its organs, and a plant of it. Out: its fibres, whether one is taut,
// and what bears a pull beside them.
#include "plant/fibres.hpp"

#include <algorithm>

#include "cage/tet_geometry.hpp"
#include "mechanics/batch.hpp"
#include "plant/follow.hpp"
#include "plant/guard.hpp"
#include "plant/plant.hpp"
#include "solve/springs.hpp"

namespace frond {

namespace {

constexpr double SLACK = 0.03;  // stretch that is not resisted [-]

// Returns the tensile stiffness of the capsule that ends at a chain node, EA as its rod has it [N].
double tensile_stiffness(const Model& model, size_t node) {
    return model.organ_stiffer[size_t(model.chain.nodes[node].organ)] * model.sections[node].stretching();
}

// Returns the share of each organ's tensile stiffness that its cage lacks [-].
std::vector<double> lack_of_organs(const Model& model, int order) {
    std::vector<double> tissue(model.organs.size(), 0.0), cage(model.organs.size(), 0.0);
    for (size_t i = 0; i < model.chain.nodes.size(); i++) {
        const ChainNode& node = model.chain.nodes[i];
        if (node.parent >= 0 && node.organ >= 0)
            tissue[size_t(node.organ)] += tensile_stiffness(model, i) * model.sections[i].length;
    }
    for (size_t e = 0; e < model.cage.tets.size(); e++)
        cage[size_t(model.cage.tet_organ[e])] +=
            model.young_of(order)[e] * std::abs(tet_volume(model.cage.nodes, model.cage.tets[e]));
    for (size_t i = 0; i < tissue.size(); i++) tissue[i] = tissue[i] > 0 ? 1 - cage[i] / tissue[i] : 0;
    return tissue;
}

// Returns the point of a fibre that is nearest to a place of the modelled shape; of one between quadratic tets, which
// have too many nodes, its nearer end.
Attachment on_axis(const Fibre& fibre, const VecX& modelled, const Vec3& place) {
    const Vec3 begin = attachment_place(fibre.begin, modelled), way = attachment_place(fibre.end, modelled) - begin;
    const double along = std::clamp((place - begin).dot(way) / way.squaredNorm(), 0.0, 1.0);
    if (fibre.begin.count + fibre.end.count > Attachment::MOST) return along < 0.5 ? fibre.begin : fibre.end;
    Attachment axis;
    const auto add = [&](const Attachment& end, double share) {
        for (size_t k = 0; k < size_t(end.count); k++) {
            axis.node[size_t(axis.count)] = end.node[k];
            axis.weight[size_t(axis.count++)] = share * end.weight[k];
        }
    };
    add(fibre.begin, 1 - along);
    add(fibre.end, along);
    return axis;
}

// Returns what bears a pull at a place of the modelled shape on the capsule of a fibre: nodes of the elements in which
// its ends are, with the least weights whose sum is one and whose mean place is that, so that forces keep their
// moments.
Attachment tied_to(const Fibre& fibre, const VecX& modelled, const Vec3& place) {
    Attachment tied;
    for (const Attachment* end : {&fibre.end, &fibre.begin})
        for (size_t k = 0; k < size_t(end->count) && tied.count < Attachment::MOST; k++)
            tied.node[size_t(tied.count++)] = end->node[k];
    Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, Attachment::MOST> from(4, tied.count);
    for (int k = 0; k < tied.count; k++) from.col(k) << point(modelled, tied.node[size_t(k)]) - place, 1.0;
    const Eigen::Matrix4d squares = from * from.transpose();
    const Eigen::Vector4d multipliers = squares.ldlt().solve(Eigen::Vector4d::Unit(3));
    for (int k = 0; k < tied.count; k++) tied.weight[size_t(k)] = from.col(k).dot(multipliers);
    return tied;
}

}  // namespace

Fibres make_fibres(const Model& model, const TetNodes& nodes, const VecX& modelled) {
    constexpr double LEAST = 0.5;  // share of an organ's tensile stiffness that its cage has to lack [-]
    Fibres fibres;
    fibres.of_node.assign(model.chain.nodes.size(), -1);
    if (!model.calibrated) return fibres;
    const std::vector<double> lack = lack_of_organs(model, nodes.order);
    const Embedding& chain = model.chain_embedding;
    const auto chain_place = [&](int i) {
        return tet_attachment(place_in_tet(nodes, model.cage.tets, chain.tet[size_t(i)], chain.weights[size_t(i)]));
    };
    for (size_t i = 0; i < model.chain.nodes.size(); i++) {
        const ChainNode& node = model.chain.nodes[i];
        if (node.parent < 0 || node.organ < 0 || lack[size_t(node.organ)] < LEAST) continue;
        const double length = (node.position - model.chain.nodes[size_t(node.parent)].position).norm();
        if (!(length > 0)) continue;
        fibres.of_node[i] = int(fibres.list.size());
        fibres.node.push_back(int(i));
        fibres.list.push_back({chain_place(node.parent), chain_place(int(i)), (1 + SLACK) * length,
                               lack[size_t(node.organ)] * tensile_stiffness(model, i) / length});
    }
    if (fibres.list.empty()) return fibres;
    for (const int capsule : nearest_capsules(model, nodes, modelled)) {
        const int fibre = capsule < 0 ? -1 : fibres.of_node[size_t(capsule)], node = int(fibres.of_cage_node.size());
        fibres.of_cage_node.push_back(fibre);
        fibres.axis_of_cage_node.push_back(
            fibre < 0 ? Attachment{} : on_axis(fibres.list[size_t(fibre)], modelled, point(modelled, node)));
    }
    return fibres;
}

static const Fibre* fibre_that_holds(const Plant& plant, int fibre) {
    if (fibre < 0 || fragment_of_chain_node(plant, size_t(plant.fibres->node[size_t(fibre)]))) return nullptr;
    return &plant.fibres->list[size_t(fibre)];
}

static const Fibre* fibre_of_node(const Plant& plant, int node) {
    return plant.fibres ? fibre_that_holds(plant, plant.fibres->of_cage_node[size_t(node)]) : nullptr;
}

static const Fibre* fibre_of_vertex(const Plant& plant, int vertex) {
    const int node = plant.fibres ? plant.model->chain.vertex_node[size_t(vertex)] : -1;
    return node < 0 ? nullptr : fibre_that_holds(plant, plant.fibres->of_node[size_t(node)]);
}

bool is_on_fibre(const Plant& plant, int vertex) {
    return fibre_of_vertex(plant, vertex) != nullptr;
}

Attachment pulled_at_node(const Plant& plant, int node) {
    if (plant.follow) return plant.follow->attachments[size_t(node)];
    if (fibre_of_node(plant, node)) return plant.fibres->axis_of_cage_node[size_t(node)];
    Attachment itself;
    itself.count = 1;
    itself.node[0] = node;
    itself.weight[0] = 1;
    return itself;
}

Attachment pulled_at_vertex(const Plant& plant, int vertex) {
    const Fibre* fibre = fibre_of_vertex(plant, vertex);
    return fibre ? tied_to(*fibre, plant.nodes->modelled, plant.model->surface.positions[size_t(vertex)])
                 : vertex_attachment(plant, vertex);
}

// Calls `use` for ties of what grabs and bonds pull to both ends of its capsule, as the cage would let that turn aside.
template <class Use>
static void for_each_tie(const Plant& plant, const Use& use) {
    const VecX& modelled = plant.nodes->modelled;
    const auto tie = [&](const Fibre& fibre, const Attachment& pulled) {
        for (const Attachment* end : {&fibre.begin, &fibre.end}) {
            const double length = (attachment_place(pulled, modelled) - attachment_place(*end, modelled)).norm();
            if (length > 0) use(Fibre{*end, pulled, (1 + SLACK) * length, fibre.stiffness});
        }
    };
    const auto tie_vertex = [&](int vertex) {
        if (const Fibre* fibre = fibre_of_vertex(plant, vertex)) tie(*fibre, pulled_at_vertex(plant, vertex));
    };
    for (const Grab& grab : plant.input.grabs) tie_vertex(grab.vertex);
    for (const int vertex : plant.step.bonded) tie_vertex(vertex);
}

// Calls `use` for each fibre that has not broken off, with its length as it may have given, and for the ties.
template <class Use>
static void for_each_fibre(const Plant& plant, const Use& use) {
    const Fibres& fibres = *plant.fibres;
    for (size_t i = 0; i < fibres.list.size(); i++) {
        if (fragment_of_chain_node(plant, size_t(fibres.node[i]))) continue;
        if (plant.state.fibre_give.empty()) {
            use(fibres.list[i]);
        } else {
            Fibre longer = fibres.list[i];
            longer.length *= plant.state.fibre_give[i];
            use(longer);
        }
    }
    for_each_tie(plant, use);
}

// Returns the energy of all fibres that does not matter [J].
static double no_matter(const Plant& plant) {
    constexpr double SHARE = 1e-5;  // of what lifts the plant by its size [-]
    return SHARE * lifting_energy(plant);
}

std::unique_ptr<FibreLoads> fibres_of(const Plant& plant) {
    if (!plant.fibres || !plant.step.has_fibres) return nullptr;
    auto fibres = std::make_unique<FibreLoads>();
    fibres->tolerance = no_matter(plant);
    for_each_fibre(plant, [&](const Fibre& fibre) { fibres->list.push_back(fibre); });
    return fibres;
}

void look_at_fibres(Plant& plant) {
    plant.state.stretched = float(fibre_energy(plant, plant.state.motion.x));
}

void let_fibres_give(Plant& plant, double h) {
    constexpr double RATE = 0.02;   // [1/s]
    constexpr double SHARE = 1e-6;  // energy of a fibre that matters over that which lifts the plant by its size [-]
    const bool gives = plant.state.is_entangled;
    std::vector<double>& give = plant.state.fibre_give;
    if (!plant.fibres || (!gives && give.empty())) return;
    const std::vector<Fibre>& list = plant.fibres->list;
    give.resize(list.size(), 1);
    const double most = SHARE * lifting_energy(plant);
    for (size_t i = 0; i < give.size(); i++) {
        const double now = drawn(list[i], plant.state.motion.x);
        if (gives || now < give[i]) {
            give[i] = std::max(1.0, now);
            continue;
        }
        Fibre shorter = list[i];
        const double less = std::max(1.0, give[i] - RATE * h);
        shorter.length *= less;
        if (fibre_energy(shorter, plant.state.motion.x) <= most) give[i] = less;
    }
    if (std::all_of(give.begin(), give.end(), [](double own) { return own == 1; })) give.clear();
}

double fibre_energy(const Plant& plant, const VecX& x) {
    double energy = 0;
    if (plant.fibres && plant.step.has_fibres)
        for_each_fibre(plant, [&](const Fibre& fibre) { energy += fibre_energy(fibre, x); });
    return energy;
}

bool fibre_becomes_taut(const Plant& plant) {
    if (!(plant.state.stretched > 0)) return false;
    const double none = no_matter(plant);
    if (double(plant.state.stretched) <= none) return false;
    double energy = 0;
    for_each_fibre(plant, [&](const Fibre& fibre) {
        if (drawn(fibre, plant.step.x_good) <= 1) energy += fibre_energy(fibre, plant.state.motion.x);
    });
    return energy > none;
}

bool holds_for_fibres(Plant& plant, const VecX* from) {
    const std::vector<Fibre>& list = plant.fibres->list;
    if (from && !(miss_of_fibres(list, *from, plant.state.motion.x) <= NEARLY * no_matter(plant))) return false;
    look_at_fibres(plant);
    return !fibre_becomes_taut(plant);
}

void add_fibre_forces(const Plant& plant, const VecX& x, VecX& f) {
    if (plant.fibres && plant.step.has_fibres)
        for_each_fibre(plant, [&](const Fibre& fibre) { add_fibre_force(fibre, x, f); });
}

}  // namespace frond
