// Calibration: organ materials -> constants of the cage's tets. A cage is fatter than the organ in it, and four-node
// tets are too stiff in bending, by a factor of ten to a thousand; so each organ's Young's modulus in the cage is
// scaled until the organ bends in the cage as the rod with its true section would. Each organ is taken alone, held
// where it grows out of another one, and loaded with its own weight and that of what it bears, along each of the three
// axes. Under equal loads elastic energy is inversely proportional to stiffness, so the ratio of the two energies, cage
// to rod, is the factor.
#include <algorithm>
#include <cmath>
#include <map>

#include "build/build.hpp"
#include "build/firm_tets.hpp"
#include "build/static_stiffness.hpp"
#include "mechanics/tet_element.hpp"
#include "model/tet_geometry.hpp"

namespace frond {
namespace {

constexpr double WEIGHT = 9.81;         // [m/s^2]
constexpr double LARGEST_FACTOR = 1e6;  // of a modulus [-]
// An organ may turn this far under its own weight taken sideways, by linear theory; an upright column topples at 1.306.
constexpr double LARGEST_TURN = 1.2;  // [rad]

Vec3 tet_centre(const Cage& cage, const Tet& tet) {
    Vec3 sum = Vec3::Zero();
    for (int corner : tet) sum += cage.nodes[size_t(corner)];
    return sum / 4;
}

// The chain node that each tet's weight hangs on: that of most vertices in it, else of the nearest node.
std::vector<int> hang_tets(const Model& model) {
    const size_t tet_count = model.cage.tets.size();
    std::vector<std::vector<int>> votes(tet_count);
    for (size_t v = 0; v < model.embedding.tet.size(); v++)
        votes[size_t(model.embedding.tet[v])].push_back(model.chain.vertex_node[v]);
    std::vector<int> hangs(tet_count);
    for (size_t e = 0; e < tet_count; e++) {
        std::vector<int>& nodes = votes[e];
        if (!nodes.empty()) {
            std::nth_element(nodes.begin(), nodes.begin() + long(nodes.size() / 2), nodes.end());
            hangs[e] = nodes[nodes.size() / 2];
            continue;
        }
        const Vec3 centre = tet_centre(model.cage, model.cage.tets[e]);
        double nearest = INFINITY;
        for (size_t i = 0; i < model.chain.nodes.size(); i++) {
            const ChainNode& node = model.chain.nodes[i];
            const double penalty = node.organ == model.cage.tet_organ[e] ? 0 : 1;
            const double distance = (node.position - centre).norm() + penalty;
            if (distance < nearest) {
                nearest = distance;
                hangs[e] = int(i);
            }
        }
    }
    return hangs;
}

// What a plant weighs, as the chain carries it: one a chain node.
struct Weights {
    std::vector<double> mass;  // [kg]
    std::vector<Vec3> moment;  // mass times position [kg m]
};

Weights weigh(const Model& model) {
    Weights weights;
    weights.mass.assign(model.chain.nodes.size(), 0);
    weights.moment.assign(model.chain.nodes.size(), Vec3::Zero());
    const std::vector<int> hangs = hang_tets(model);
    for (size_t e = 0; e < hangs.size(); e++) {
        const double mass = model.tet_density[e] * tet_volume(model.cage.nodes, model.cage.tets[e]);
        weights.mass[size_t(hangs[e])] += mass;
        weights.moment[size_t(hangs[e])] += mass * tet_centre(model.cage, model.cage.tets[e]);
    }
    return weights;
}

// Bending and twisting moment and pull of a capsule.
struct RodForce {
    double thin, wide, twist, pull;  // [N m], [N m], [N m], [N]
};

// Under a weight along one axis, summed from the tips down. With `organs_alone` an organ bears the weight of what grows
// out of it where it grows, without its leverage.
std::vector<RodForce> rod_forces(const Model& model, const std::vector<Section>& sections, const Weights& weights,
                                 int axis, bool organs_alone) {
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    const Vec3 load = WEIGHT * Vec3::Unit(axis);
    std::vector<Vec3> force(nodes.size()), moment(nodes.size());
    for (size_t i = 0; i < nodes.size(); i++) {
        force[i] = weights.mass[i] * load;
        moment[i] = weights.moment[i].cross(load);
    }
    std::vector<RodForce> rods(nodes.size(), RodForce{});
    for (size_t i = nodes.size(); i-- > 0;) {
        if (nodes[i].parent < 0) continue;
        const size_t parent = size_t(nodes[i].parent);
        const Vec3 cut = 0.5 * (nodes[i].position + nodes[parent].position);
        const Vec3 M = moment[i] - cut.cross(force[i]);
        const Section& section = sections[i];
        rods[i] = {M.dot(section.axis.cross(section.thin)), M.dot(section.thin), M.dot(section.axis),
                   force[i].dot(section.axis)};
        const bool new_organ = nodes[i].organ != nodes[parent].organ;
        force[parent] += force[i];
        moment[parent] += organs_alone && new_organ ? nodes[parent].position.cross(force[i]) : moment[i];
    }
    return rods;
}

// Elastic energy of each organ as rods, summed over the three loads [J]. They twist as isotropic ones do: the cage
// cannot be soft in twisting alone, and would become too soft in bending if it had to share out the energy of both.
std::vector<double> rod_energies(const Model& model, const std::vector<Section>& sections, const Weights& weights,
                                 bool organs_alone) {
    std::vector<double> energies(model.organs.size(), 0.0);
    for (int axis = 0; axis < 3; axis++) {
        const std::vector<RodForce> rods = rod_forces(model, sections, weights, axis, organs_alone);
        for (size_t i = 0; i < rods.size(); i++) {
            const Section& section = sections[i];
            const Material& material = model.organs[size_t(model.chain.nodes[i].organ)].material;
            const RodForce& rod = rods[i];
            energies[size_t(model.chain.nodes[i].organ)] +=
                section.length / (2 * material.young) *
                (rod.thin * rod.thin / section.inertia_thin + rod.wide * rod.wide / section.inertia_wide +
                 2 * (1 + material.poisson) * rod.twist * rod.twist / section.torsion +
                 rod.pull * rod.pull / section.area);
        }
    }
    return energies;
}

// How far each organ turns from its base to its tip when all its weight pulls sideways, linearly [rad].
std::vector<double> organ_turns(const Model& model, const std::vector<Section>& sections, const Weights& weights) {
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    std::vector<double> turns(model.organs.size(), 0.0);
    for (int axis = 0; axis < 3; axis++) {
        const std::vector<RodForce> rods = rod_forces(model, sections, weights, axis, false);
        std::vector<double> turn(nodes.size(), 0.0);
        for (size_t i = 0; i < nodes.size(); i++) {
            if (nodes[i].parent < 0) continue;
            const size_t parent = size_t(nodes[i].parent), organ = size_t(nodes[i].organ);
            const Section& section = sections[i];
            const double curvature =
                std::hypot(rods[i].thin / section.inertia_thin, rods[i].wide / section.inertia_wide) /
                model.organs[organ].material.young;
            turn[i] = section.length * curvature + (nodes[parent].organ == nodes[i].organ ? turn[parent] : 0.0);
            turns[organ] = std::max(turns[organ], turn[i]);
        }
    }
    return turns;
}

// The organ that most of an organ's pieces grow out of; -1 for one that stands on the ground.
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

// The tets of one organ as a model of their own, held where it grows out of another organ or the ground.
struct LoneOrgan {
    Model model;
    std::vector<int> nodes;       // of the plant's cage
    std::map<int, double> borne;  // own node -> mass of what grows out of it there [kg]
};

LoneOrgan take_organ(const Model& model, int organ, const std::vector<int>& parents, const std::vector<double>& borne,
                     const std::vector<std::vector<int>>& node_organs) {
    LoneOrgan lone;
    std::map<int, int> own;  // the plant's node -> the organ's
    for (size_t e = 0; e < model.cage.tets.size(); e++) {
        if (model.cage.tet_organ[e] != organ) continue;
        Tet tet = model.cage.tets[e];
        for (int& corner : tet) {
            const auto [entry, is_new] = own.try_emplace(corner, int(lone.nodes.size()));
            if (is_new) lone.nodes.push_back(corner);
            corner = entry->second;
        }
        lone.model.cage.tets.push_back(tet);
        lone.model.tet_density.push_back(model.tet_density[e]);
        lone.model.tet_young.push_back(model.tet_young[e]);
        lone.model.tet_poisson.push_back(model.tet_poisson[e]);
    }
    std::map<int, std::vector<int>> shared;  // organ that grows out of it -> own nodes
    for (size_t i = 0; i < lone.nodes.size(); i++) {
        const size_t node = size_t(lone.nodes[i]);
        lone.model.cage.nodes.push_back(model.cage.nodes[node]);
        bool held = model.root[node];
        for (int other : node_organs[node]) {
            held |= other == parents[size_t(organ)];
            if (parents[size_t(other)] == organ) shared[other].push_back(int(i));
        }
        lone.model.root.push_back(held);
    }
    for (const auto& [child, nodes] : shared)
        for (int node : nodes) lone.borne[node] += borne[size_t(child)] / double(nodes.size());
    return lone;
}

// Takes away what nothing holds or what swings on a hinge; its mass hangs on where it is attached. Returns the share of
// the organ's volume that stays.
double drop_loose_tets(LoneOrgan& lone) {
    Model& model = lone.model;
    const std::vector<char> firm = find_firm_tets(model.cage, model.root);
    std::vector<char> used(model.cage.nodes.size(), 0);
    for (size_t e = 0; e < firm.size(); e++)
        if (firm[e])
            for (int corner : model.cage.tets[e]) used[size_t(corner)] = 1;
    double whole = 0, kept_volume = 0;
    size_t kept = 0;
    for (size_t e = 0; e < firm.size(); e++) {
        const Tet tet = model.cage.tets[e];
        const double volume = tet_volume(model.cage.nodes, tet);
        whole += volume;
        if (!firm[e]) {
            const auto shared = std::count_if(tet.begin(), tet.end(), [&](int corner) { return used[size_t(corner)]; });
            for (int corner : tet)
                if (used[size_t(corner)]) lone.borne[corner] += model.tet_density[e] * volume / double(shared);
            continue;
        }
        kept_volume += volume;
        model.cage.tets[kept] = tet;
        model.tet_density[kept] = model.tet_density[e];
        model.tet_young[kept] = model.tet_young[e];
        model.tet_poisson[kept] = model.tet_poisson[e];
        kept++;
    }
    model.cage.tets.resize(kept);
    model.tet_density.resize(kept);
    model.tet_young.resize(kept);
    model.tet_poisson.resize(kept);
    for (size_t i = 0; i < used.size(); i++)
        if (!used[i]) model.root[i] = 1;
    return whole > 0 ? kept_volume / whole : 0;
}

// Elastic energy of a lone organ, summed over the three loads [J]; 0 if too little of it is held or free to move.
double lone_energy(LoneOrgan& lone) {
    constexpr double MOST = 0.6;  // share of an organ from which it can be taken alone [-]
    Model& model = lone.model;
    if (drop_loose_tets(lone) < MOST) return 0;
    if (std::all_of(model.root.begin(), model.root.end(), [](uint8_t held) { return held; })) return 0;
    const TetElements elements = make_tet_elements(model);
    StaticStiffness stiffness(elements.pattern);
    if (!stiffness.set(elements, model.root, FROND_TET_LINEAR, Tangent::positive, elements.rest_positions)) return 0;
    double energy = 0;
    VecX load(elements.rest_positions.size()), u(load.size());
    for (int axis = 0; axis < 3; axis++) {
        load.setZero();
        for (size_t e = 0; e < elements.tets.size(); e++)
            for (int corner : elements.tets[e])
                load[3 * corner + axis] += WEIGHT * elements.density[e] * elements.volume[e] / 4;
        for (const auto& [node, mass] : lone.borne) load[3 * node + axis] += WEIGHT * mass;
        for (size_t i = 0; i < model.root.size(); i++)
            if (model.root[i]) point(load, int(i)).setZero();
        solve(*stiffness.factor, load, u);
        energy += 0.5 * load.dot(u);
    }
    return energy;
}

std::vector<double> cage_energies(const Model& model) {
    const std::vector<int> parents = organ_parents(model);
    // Mass of each organ with all that it bears; a loop of organs bears itself only.
    std::vector<double> own(model.organs.size(), 0.0), borne;
    std::vector<std::vector<int>> node_organs(model.cage.nodes.size());
    for (size_t e = 0; e < model.cage.tets.size(); e++) {
        const int organ = model.cage.tet_organ[e];
        own[size_t(organ)] += model.tet_density[e] * tet_volume(model.cage.nodes, model.cage.tets[e]);
        for (int corner : model.cage.tets[e]) {
            std::vector<int>& list = node_organs[size_t(corner)];
            if (std::find(list.begin(), list.end(), organ) == list.end()) list.push_back(organ);
        }
    }
    borne = own;
    for (size_t o = 0; o < own.size(); o++) {
        size_t steps = 0;
        for (int above = parents[o]; above >= 0 && above != int(o) && steps < own.size();
             above = parents[size_t(above)], steps++)
            borne[size_t(above)] += own[o];
    }
    std::vector<double> energies;
    for (size_t o = 0; o < model.organs.size(); o++) {
        LoneOrgan lone = take_organ(model, int(o), parents, borne, node_organs);
        energies.push_back(lone.nodes.empty() ? 0 : lone_energy(lone));
    }
    return energies;
}

// Elastic energy of each organ's tets in the whole plant, summed over the three loads [J]; empty if the root does not
// hold it.
std::vector<double> whole_energies(const Model& model) {
    const TetElements elements = make_tet_elements(model);
    StaticStiffness stiffness(elements.pattern);
    const VecX& X = elements.rest_positions;
    if (!stiffness.set(elements, model.root, FROND_TET_LINEAR, Tangent::positive, X)) return {};
    std::vector<double> energies(model.organs.size(), 0.0);
    VecX load(X.size()), u(load.size());
    for (int axis = 0; axis < 3; axis++) {
        load.setZero();
        for (size_t e = 0; e < elements.tets.size(); e++)
            for (int corner : elements.tets[e])
                if (!model.root[size_t(corner)])
                    load[3 * corner + axis] += WEIGHT * elements.density[e] * elements.volume[e] / 4;
        solve(*stiffness.factor, load, u);
        for (size_t e = 0; e < elements.tets.size(); e++) {
            const Tet& tet = elements.ordered[e];
            Mat3 edges;
            for (int k = 0; k < 3; k++) edges.col(k) = point(u, tet[size_t(k) + 1]) - point(u, tet[0]);
            const Mat3 gradient = edges * elements.rest_inverse[e], strain = 0.5 * (gradient + gradient.transpose());
            energies[size_t(model.cage.tet_organ[e])] +=
                elements.volume[e] *
                (elements.mu[e] * strain.squaredNorm() + 0.5 * elements.lambda[e] * strain.trace() * strain.trace());
        }
    }
    return energies;
}

// Organs that cannot be taken alone, because their tets lie scattered among those of others, get one factor together:
// all organs' energies in the plant under its weight are compared with the rods'.
void calibrate_together(Model& model, const std::vector<Section>& sections, const Weights& weights,
                        const std::vector<char>& alone) {
    if (std::all_of(alone.begin(), alone.end(), [](char is) { return is; })) return;
    const std::vector<double> rods = rod_energies(model, sections, weights, false);
    constexpr int ROUNDS = 4;
    for (int round = 0; round < ROUNDS; round++) {
        const std::vector<double> cage = whole_energies(model);
        if (cage.empty()) return;
        double rod_sum = 0, cage_sum = 0;
        for (size_t o = 0; o < rods.size(); o++) {
            if (alone[o]) continue;
            rod_sum += rods[o];
            cage_sum += cage[o];
        }
        if (!(rod_sum > 0 && cage_sum > 0)) return;
        const double factor = std::clamp(cage_sum / rod_sum, 1 / LARGEST_FACTOR, LARGEST_FACTOR);
        for (size_t e = 0; e < model.tet_young.size(); e++)
            if (!alone[size_t(model.cage.tet_organ[e])]) model.tet_young[e] *= factor;
    }
}

// A tet that is partly plant weighs as much as its share. Its Young's modulus begins as the rule of mixtures has it. A
// tube weighs and bends as its wall does.
void start_from_mixture(Model& model) {
    const size_t tet_count = model.cage.tets.size();
    model.tet_density.resize(tet_count);
    model.tet_young.resize(tet_count);
    model.tet_poisson.resize(tet_count);
    for (size_t e = 0; e < tet_count; e++) {
        const Organ& organ = model.organs[size_t(model.cage.tet_organ[e])];
        const Material& material = organ.material;
        const double hole = hole_share(organ);
        model.tet_density[e] = material.density * model.cage.tet_fill[e] * (1 - hole);
        model.tet_young[e] = material.young * model.cage.tet_fill[e] * (1 - hole * hole);
        model.tet_poisson[e] = material.poisson;
    }
}

}  // namespace

void take_materials(Model& model) {
    start_from_mixture(model);
    model.chain_mass = weigh(model).mass;
}

// How much stiffer each organ has to be to carry itself and what it bears. Organs of no weight to speak of, silk and
// hairs, are not worth a word in `weak`.
static std::vector<double> find_weak_organs(const Model& model, const std::vector<double>& turns, WeakOrgan& weak) {
    constexpr double WORTH_A_WORD = 0.02;  // share of the plant's mass [-]
    std::vector<double> factor(turns.size(), 1.0), mass(turns.size(), 0.0);
    for (size_t e = 0; e < model.cage.tets.size(); e++)
        mass[size_t(model.cage.tet_organ[e])] += model.tet_density[e] * tet_volume(model.cage.nodes, model.cage.tets[e]);
    const double whole = model.mass();
    for (size_t o = 0; o < turns.size(); o++) {
        factor[o] = std::max(1.0, turns[o] / LARGEST_TURN);
        if (mass[o] < WORTH_A_WORD * whole || factor[o] <= weak.factor) continue;
        weak = {model.organs[o].name, factor[o]};
    }
    return factor;
}

WeakOrgan calibrate(Model& model, bool must_stand) {
    start_from_mixture(model);
    const std::vector<Section>& sections = model.sections;
    const Weights weights = weigh(model);
    model.chain_mass = weights.mass;
    const std::vector<double> rods = rod_energies(model, sections, weights, true), cage = cage_energies(model);
    std::vector<char> alone(rods.size(), 0);
    for (size_t o = 0; o < rods.size(); o++) alone[o] = rods[o] > 0 && cage[o] > 0;
    for (size_t e = 0; e < model.tet_young.size(); e++) {
        const size_t o = size_t(model.cage.tet_organ[e]);
        if (alone[o]) model.tet_young[e] *= std::clamp(cage[o] / rods[o], 1 / LARGEST_FACTOR, LARGEST_FACTOR);
    }
    calibrate_together(model, sections, weights, alone);

    WeakOrgan weak;
    if (!must_stand) return weak;
    const std::vector<double> stiffer = find_weak_organs(model, organ_turns(model, sections, weights), weak);
    for (size_t e = 0; e < model.tet_young.size(); e++) model.tet_young[e] *= stiffer[size_t(model.cage.tet_organ[e])];
    model.organ_stiffer = stiffer;
    return weak;
}

}  // namespace frond
