// Calibration: organ materials -> constants of the cage's tets. A cage is fatter than the organ in it, and four-node
// tets are too stiff in bending, by a factor of ten to a thousand; so each organ's Young's modulus in the cage is
// scaled until the organ bends in the cage as the rod with its true section would. Each organ is taken alone, held
// where it grows out of another one, and loaded with its own weight and that of what it bears, and at its tip, along
// each of the three axes. Under equal loads elastic energy is inversely proportional to stiffness, so the ratio of the
// two energies, cage to rod, is the factor: first for the organ, then place by place along it.
#include <algorithm>
#include <cmath>
#include <map>

#include "build/build.hpp"
#include "build/firm_tets.hpp"
#include "build/static_stiffness.hpp"
#include "build/weigh.hpp"
#include "mechanics/tet_element.hpp"
#include "model/tet_geometry.hpp"

namespace frond {
namespace {

constexpr double LARGEST_FACTOR = 1e6;  // of a modulus [-]

// An elastic energy for each chain node [J]: of the tets that hang on it, and of the halves of its capsules.
using Energies = std::vector<double>;

// Bending and twisting moment and pull of a capsule.
struct RodForce {
    double thin, wide, twist, pull;  // [N m], [N m], [N m], [N]
};

// Under a weight along one axis, summed from the tips down. With `organs_alone` an organ bears the weight of what grows
// out of it where it grows, without its leverage.
std::vector<RodForce> rod_forces(const Model& model, const Weights& weights,
                                 int axis, bool organs_alone) {
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    const Vec3 load = GRAVITY * Vec3::Unit(axis);
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
        const Section& section = model.sections[i];
        rods[i] = {M.dot(section.axis.cross(section.thin)), M.dot(section.thin), M.dot(section.axis),
                   force[i].dot(section.axis)};
        const bool new_organ = nodes[i].organ != nodes[parent].organ;
        force[parent] += force[i];
        moment[parent] += organs_alone && new_organ ? nodes[parent].position.cross(force[i]) : moment[i];
    }
    return rods;
}

// As rods, summed over the three loads. They twist as isotropic ones do: the cage cannot be soft in twisting alone, and
// would become too soft in bending if it had to share out the energy of both.
Energies rod_energies(const Model& model, const Weights& weights, bool organs_alone) {
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    Energies energies(nodes.size(), 0.0);
    for (int axis = 0; axis < 3; axis++) {
        const std::vector<RodForce> rods = rod_forces(model, weights, axis, organs_alone);
        for (size_t i = 0; i < rods.size(); i++) {
            if (nodes[i].parent < 0) continue;
            const Section& section = model.sections[i];
            const Material& material = model.organs[size_t(nodes[i].organ)].material;
            const RodForce& rod = rods[i];
            const double energy =
                section.length / (2 * material.young * model.organ_stiffer[size_t(nodes[i].organ)]) *
                (rod.thin * rod.thin / section.inertia_thin + rod.wide * rod.wide / section.inertia_wide +
                 2 * (1 + material.poisson) * rod.twist * rod.twist / section.torsion +
                 rod.pull * rod.pull / section.area);
            const size_t parent = size_t(nodes[i].parent);
            const bool shared = nodes[parent].organ == nodes[i].organ || nodes[parent].parent < 0;
            energies[i] += shared ? 0.5 * energy : energy;
            if (shared) energies[parent] += 0.5 * energy;
        }
    }
    return energies;
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
    std::vector<size_t> tets;     // of the plant's cage, those that are left
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
        lone.tets.push_back(e);
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
        lone.tets[kept] = lone.tets[e];
        model.tet_density[kept] = model.tet_density[e];
        model.tet_young[kept] = model.tet_young[e];
        model.tet_poisson[kept] = model.tet_poisson[e];
        kept++;
    }
    model.cage.tets.resize(kept);
    lone.tets.resize(kept);
    model.tet_density.resize(kept);
    model.tet_young.resize(kept);
    model.tet_poisson.resize(kept);
    for (size_t i = 0; i < used.size(); i++)
        if (!used[i]) model.root[i] = 1;
    return whole > 0 ? kept_volume / whole : 0;
}

// Linear elastic energy of a tet whose nodes are displaced by u [J].
double tet_energy(const TetElements& elements, size_t e, const VecX& u) {
    const Mat3 gradient = deformation_gradient(elements, e, u), strain = 0.5 * (gradient + gradient.transpose());
    const double trace = strain.trace();
    return elements.volume[e] * (elements.mu[e] * strain.squaredNorm() + 0.5 * elements.lambda[e] * trace * trace);
}

// Masses that a cage carries, by its nodes [kg].
using NodeMasses = std::map<int, double>;

NodeMasses own_masses(const Model& model) {
    NodeMasses masses;
    for (size_t e = 0; e < model.cage.tets.size(); e++)
        for (int corner : model.cage.tets[e])
            masses[corner] += model.tet_density[e] * tet_volume(model.cage.nodes, model.cage.tets[e]) / 4;
    return masses;
}

// A cage's energies under each of several loads, weights along the three axes in turn, by the chain nodes that its tets
// hang on. Empty if the root does not hold it.
std::vector<Energies> cage_energies(const Model& model, const std::vector<NodeMasses>& loads,
                                    const std::vector<int>& hangs, size_t chain_count) {
    const TetElements elements = make_tet_elements(model);
    StaticStiffness stiffness(elements.pattern);
    if (!stiffness.set(elements, model.root, FROND_TET_LINEAR, Tangent::positive, elements.rest_positions)) return {};
    std::vector<Energies> all;
    VecX load(elements.rest_positions.size()), u(load.size());
    for (const NodeMasses& masses : loads) {
        Energies energies(chain_count, 0.0);
        for (int axis = 0; axis < 3; axis++) {
            load.setZero();
            for (const auto& [node, mass] : masses)
                if (!model.root[size_t(node)]) load[3 * node + axis] = GRAVITY * mass;
            solve(*stiffness.factor, load, u);
            for (size_t e = 0; e < elements.tets.size(); e++) energies[size_t(hangs[e])] += tet_energy(elements, e, u);
        }
        all.push_back(std::move(energies));
    }
    return all;
}

// Mass of each organ with all that it bears; a loop of organs bears itself only.
std::vector<double> borne_masses(const Model& model, const std::vector<int>& parents) {
    std::vector<double> own(model.organs.size(), 0.0);
    for (size_t e = 0; e < model.cage.tets.size(); e++)
        own[size_t(model.cage.tet_organ[e])] +=
            model.tet_density[e] * tet_volume(model.cage.nodes, model.cage.tets[e]);
    std::vector<double> borne = own;
    for (size_t o = 0; o < own.size(); o++) {
        size_t steps = 0;
        for (int above = parents[o]; above >= 0 && above != int(o) && steps < own.size();
             above = parents[size_t(above)], steps++)
            borne[size_t(above)] += own[o];
    }
    return borne;
}

std::vector<std::vector<int>> node_organs(const Cage& cage) {
    std::vector<std::vector<int>> organs(cage.nodes.size());
    for (size_t e = 0; e < cage.tets.size(); e++)
        for (int corner : cage.tets[e]) {
            std::vector<int>& list = organs[size_t(corner)];
            if (std::find(list.begin(), list.end(), cage.tet_organ[e]) == list.end())
                list.push_back(cage.tet_organ[e]);
        }
    return organs;
}

// The rods' energies of one organ, moved to the nearest chain nodes towards its base on which tets hang.
Energies gather_on_tets(const Model& model, int organ, const std::vector<char>& has_tets, const Energies& rods) {
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    Energies gathered(nodes.size(), 0.0);
    double homeless = 0;
    int home = -1;
    for (size_t i = 0; i < nodes.size(); i++) {
        if (has_tets[i] && home < 0) home = int(i);
        if (nodes[i].organ != organ) continue;
        int node = int(i);
        while (node >= 0 && !has_tets[size_t(node)]) node = nodes[size_t(node)].parent;
        (node >= 0 ? gathered[size_t(node)] : homeless) += rods[i];
    }
    if (home >= 0) gathered[size_t(home)] += homeless;
    return gathered;
}

double mean_edge(const Cage& cage) {
    double sum = 0;
    for (const Tet& tet : cage.tets)
        for (size_t a = 0; a < 4; a++)
            for (size_t b = 0; b < a; b++) sum += (cage.nodes[size_t(tet[a])] - cage.nodes[size_t(tet[b])]).norm();
    return sum / (6 * double(cage.tets.size()));
}

// Places along an organ are not told apart more finely than its tets do: each chain node's first node of such a stretch.
std::vector<int> stretches(const Chain& chain, int organ, double length) {
    std::vector<int> first(chain.nodes.size());
    for (size_t i = 0; i < first.size(); i++) {
        const ChainNode& node = chain.nodes[i];
        first[i] = int(i);
        if (node.organ != organ || node.parent < 0 || chain.nodes[size_t(node.parent)].organ != organ) continue;
        const int begin = first[size_t(node.parent)];
        if (node.distance - chain.nodes[size_t(begin)].distance < length) first[i] = begin;
    }
    return first;
}

Energies gather(const Energies& energies, const std::vector<int>& first) {
    Energies gathered(energies.size(), 0.0);
    for (size_t i = 0; i < energies.size(); i++) gathered[size_t(first[i])] += energies[i];
    return gathered;
}

double sum_of(const Energies& energies) {
    double sum = 0;
    for (double energy : energies) sum += energy;
    return sum;
}

// The node of an organ that is farthest along the chain; -1 if it has none.
int tip_of(const Chain& chain, int organ) {
    int tip = -1;
    for (size_t i = 0; i < chain.nodes.size(); i++)
        if (chain.nodes[i].organ == organ && chain.nodes[i].parent >= 0 &&
            (tip < 0 || chain.nodes[i].distance > chain.nodes[size_t(tip)].distance))
            tip = int(i);
    return tip;
}

// A mass at an organ's tip, for its cage; empty if that is not where the chain's tip is bound to.
NodeMasses mass_at_tip(const LoneOrgan& lone, const Model& plant, int tip) {
    NodeMasses masses;
    const int tet = plant.chain_embedding.tet[size_t(tip)];
    const auto found = std::find(lone.tets.begin(), lone.tets.end(), size_t(tet));
    if (found == lone.tets.end()) return masses;
    const Tet& own = lone.model.cage.tets[size_t(found - lone.tets.begin())];
    for (size_t k = 0; k < 4; k++) masses[own[k]] += plant.chain_embedding.weights[size_t(tip)][k];
    return masses;
}

// And for its rods.
Energies rods_with_mass_at_tip(const Model& plant, int tip) {
    Weights weights;
    weights.mass.assign(plant.chain.nodes.size(), 0.0);
    weights.moment.assign(plant.chain.nodes.size(), Vec3::Zero());
    weights.mass[size_t(tip)] = 1;
    weights.moment[size_t(tip)] = plant.chain.nodes[size_t(tip)].position;
    return rod_energies(plant, weights, true);
}

// Each load counts alike: the sum over them of energies over the whole energy of the rods.
Energies balanced(const std::vector<Energies>& loads, const std::vector<double>& whole) {
    Energies sum(loads.front().size(), 0.0);
    for (size_t l = 0; l < loads.size(); l++)
        for (size_t i = 0; i < sum.size(); i++) sum[i] += loads[l][i] / whole[l];
    return sum;
}

// Scales the lone organ's moduli until its energies are the rods', first as a whole, then place by place: under its own
// weight and what it bears, and with a weight at its tip. False if too little of it is held or free to move.
bool calibrate_alone(LoneOrgan& lone, int organ, const Model& plant, const std::vector<int>& hangs,
                     const Energies& rods) {
    constexpr double MOST = 0.6;  // share of an organ from which it can be taken alone [-]
    constexpr int ROUNDS = 5;
    constexpr double SOFTEST = 0.5, STIFFEST = 8;  // of a place, over the organ as a whole [-]
    constexpr double BLUR = 0.3;        // of the organ's energy that counts at each of its places [-]
    Model& model = lone.model;
    if (drop_loose_tets(lone) < MOST) return false;
    if (std::all_of(model.root.begin(), model.root.end(), [](uint8_t held) { return held; })) return false;
    constexpr double STRETCH = 1.5;  // of the mean edge [-]
    const std::vector<int> first = stretches(plant.chain, organ, STRETCH * mean_edge(model.cage));
    std::vector<int> own_hangs;
    std::vector<char> has_tets(plant.chain.nodes.size(), 0);
    for (size_t e : lone.tets) {
        own_hangs.push_back(first[size_t(hangs[e])]);
        has_tets[size_t(own_hangs.back())] = 1;
    }
    std::vector<NodeMasses> loads = {own_masses(model)};
    for (const auto& [node, mass] : lone.borne) loads[0][node] += mass;
    std::vector<Energies> rods_by_load = {gather_on_tets(plant, organ, has_tets, gather(rods, first))};
    const int tip = tip_of(plant.chain, organ);
    const NodeMasses at_tip = tip >= 0 ? mass_at_tip(lone, plant, tip) : NodeMasses();
    if (!at_tip.empty()) {
        loads.push_back(at_tip);
        const Energies tip_rods = gather(rods_with_mass_at_tip(plant, tip), first);
        rods_by_load.push_back(gather_on_tets(plant, organ, has_tets, tip_rods));
    }
    std::vector<double> whole_rods;
    for (const Energies& energies : rods_by_load) whole_rods.push_back(sum_of(energies));
    if (!(*std::min_element(whole_rods.begin(), whole_rods.end()) > 0)) return false;
    const Energies wanted = balanced(rods_by_load, whole_rods);
    const double wanted_sum = sum_of(wanted);
    std::vector<double> local(own_hangs.size(), 1.0);
    for (int round = 0; round < ROUNDS; round++) {
        const std::vector<Energies> by_load = cage_energies(model, loads, own_hangs, plant.chain.nodes.size());
        if (by_load.empty()) return false;
        const Energies cage = balanced(by_load, whole_rods);
        const double cage_sum = sum_of(cage);
        if (!(cage_sum > 0)) return false;
        const double whole = std::clamp(cage_sum / wanted_sum, 1 / LARGEST_FACTOR, LARGEST_FACTOR);
        for (size_t e = 0; e < own_hangs.size(); e++) {
            const size_t node = size_t(own_hangs[e]);
            const double here = (cage[node] + BLUR * cage_sum) / (wanted[node] + BLUR * wanted_sum) / whole;
            const double before = local[e];
            if (round > 0) local[e] = std::clamp(before * here, SOFTEST, STIFFEST);
            model.tet_young[e] *= whole * local[e] / before;
        }
    }
    return true;
}

// Organs that cannot be taken alone, because their tets lie scattered among those of others, get one factor together:
// all organs' energies in the plant under its weight are compared with the rods'.
void calibrate_together(Model& model, const Weights& weights, const std::vector<int>& hangs,
                        const std::vector<char>& alone) {
    if (std::all_of(alone.begin(), alone.end(), [](char is) { return is; })) return;
    const Energies rods = rod_energies(model, weights, false);
    constexpr int ROUNDS = 4;
    for (int round = 0; round < ROUNDS; round++) {
        const std::vector<Energies> by_load = cage_energies(model, {own_masses(model)}, hangs, rods.size());
        if (by_load.empty()) return;
        const Energies& cage = by_load.front();
        double rod_sum = 0, cage_sum = 0;
        for (size_t i = 0; i < rods.size(); i++) {
            if (alone[size_t(std::max(model.chain.nodes[i].organ, 0))]) continue;
            rod_sum += rods[i];
            cage_sum += cage[i];
        }
        if (!(rod_sum > 0 && cage_sum > 0)) return;
        const double factor = std::clamp(cage_sum / rod_sum, 1 / LARGEST_FACTOR, LARGEST_FACTOR);
        for (size_t e = 0; e < model.tet_young.size(); e++)
            if (!alone[size_t(model.cage.tet_organ[e])]) model.tet_young[e] *= factor;
    }
}

}  // namespace

void take_materials(Model& model) {
    const size_t tet_count = model.cage.tets.size();
    model.tet_young.resize(tet_count);
    model.tet_poisson.resize(tet_count);
    for (size_t e = 0; e < tet_count; e++) {
        const size_t organ = size_t(model.cage.tet_organ[e]);
        const Material& material = model.organs[organ].material;
        const double hole = hole_share(model.organs[organ]);
        model.tet_young[e] = material.young * model.organ_stiffer[organ] * model.cage.tet_fill[e] * (1 - hole * hole);
        model.tet_poisson[e] = material.poisson;
    }
}

void calibrate(Model& model) {
    take_materials(model);  // the rule of mixtures, to begin with
    const std::vector<int> hangs = hang_tets(model);
    const Weights weights = weigh(model, hangs);
    const Energies rods = rod_energies(model, weights, true);
    const std::vector<int> parents = organ_parents(model);
    const std::vector<double> borne = borne_masses(model, parents);
    const std::vector<std::vector<int>> organs = node_organs(model.cage);
    std::vector<char> alone(model.organs.size(), 0);
    for (size_t o = 0; o < model.organs.size(); o++) {
        LoneOrgan lone = take_organ(model, int(o), parents, borne, organs);
        alone[o] = !lone.nodes.empty() && calibrate_alone(lone, int(o), model, hangs, rods);
        if (!alone[o]) continue;
        // Tets that hang loose are as stiff as the organ is in the mean.
        double before = 0, after = 0;
        for (size_t e = 0; e < lone.tets.size(); e++) {
            before += std::log(model.tet_young[lone.tets[e]]);
            after += std::log(lone.model.tet_young[e]);
        }
        const double mean = std::exp((after - before) / double(lone.tets.size()));
        for (size_t e = 0; e < model.tet_young.size(); e++)
            if (model.cage.tet_organ[e] == int(o)) model.tet_young[e] *= mean;
        for (size_t e = 0; e < lone.tets.size(); e++) model.tet_young[lone.tets[e]] = lone.model.tet_young[e];
    }
    calibrate_together(model, weights, hangs, alone);
    model.calibrated = true;
}

}  // namespace frond
