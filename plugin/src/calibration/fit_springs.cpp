// In: a plant's chain and sections. Out: how much stiffer each organ's springs are than its tissue.
//
// The paper's capsules (3.4) are round and of one radius each, and a shape driven by r and h bends as a full cylinder
// of that radius would. First each organ's chain of springs gets the bending energy that its rods have under the
// plant's weight along each of the three axes. If that topples, since a blade's rods are stiffer edgewise and a
// cylinder is not, it is made stiffer until it stands. Then the organs that carry the plant are fitted to its first
// modes. A plant that droops from its mesh keeps the fit of bending energy.
#include "calibration/fit_springs.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/chain_loads.hpp"
#include "calibration/fit_sway.hpp"
#include "calibration/strengthen.hpp"
#include "core/elementary.hpp"
#include "mechanics/rod_elements.hpp"

namespace frond {

static size_t organ_of(const Model& model, size_t node) {
    return size_t(std::max(model.chain.nodes[node].organ, 0));
}

// Finds factors from the bending energy, organ by organ.
static std::vector<double> organ_factors(const Model& model) {
    std::vector<double> rods(model.organs.size(), 0), springs(model.organs.size(), 0);
    for (int axis = 0; axis < 3; axis++) {
        const ChainLoads loads = weigh_chain(model, axis);
        for (size_t i = 0; i < model.chain.nodes.size(); i++) {
            if (model.chain.nodes[i].parent < 0) continue;
            const size_t organ = organ_of(model, i);
            const Section& section = model.sections[i];
            const Vec3& M = loads.moment[i];
            const double about_wide = squared(M.dot(section.wide())), about_thin = squared(M.dot(section.thin));
            const double inertia = 0.25 * PI * frond::pow(model.chain.nodes[i].fitted_radius, 4);
            rods[organ] += section.length * (about_wide / section.bending_thin() + about_thin / section.bending_wide());
            springs[organ] +=
                section.length * (about_wide + about_thin) / (model.organs[organ].material.young * inertia);
        }
    }
    std::vector<double> factors;
    for (size_t o = 0; o < rods.size(); o++) factors.push_back(rods[o] > 0 ? springs[o] / rods[o] : 1);
    return factors;
}

// Error of both first modes together, and the factor on the moduli of an organ that carries it all to remove it.
struct Gap {
    double error = INFINITY;  // mean logarithm of the ratio of the frequencies' squares, rods over springs [-]
    double step = 0;          // change of the factor's logarithm [-]
};
static Gap find_gap(const RodSways& rods, const RodSways& springs) {
    constexpr double LARGEST_STEP = 0.7;  // change of a logarithm: a factor of two [-]
    double error = 0, slope = 0;
    for (size_t i = 0; i < rods.square.size(); i++) {
        if (!(rods.square[i] > 0) || !(springs.square[i] > 0)) return {};
        error += 0.5 * frond::log(rods.square[i] / springs.square[i]);
        slope += 0.5 * springs.energies[i].dot(rods.share) / springs.square[i];
    }
    if (!(slope > 0)) return {};
    return {error, std::clamp(error / slope, -LARGEST_STEP, LARGEST_STEP)};
}

std::vector<double> fit_springs(const Model& model) {
    constexpr int ROUNDS = 8;             // in each the error falls or the step is halved
    constexpr double CLOSE = 0.02;        // error that counts as none [-]
    constexpr double LEAST_SHARE = 0.05;  // least share of a step [-]
    constexpr double MARGIN = 2;  // load over weight beyond which it may topple, so that a touch does not topple it [-]
    std::vector<double> factors = organ_factors(model), radii;
    for (const ChainNode& node : model.chain.nodes) radii.push_back(node.fitted_radius);
    const auto make = [&] { return make_spring_elements(model, radii, factors); };
    if (!model.stands_as_modelled) return factors;  // its modes are those of a shape that is not known yet
    strengthen_rods(model, FROND_MECHANICS_SPRING_CHAIN, make, std::vector<double>(factors.size(), MARGIN), factors);
    const RodSways rods = find_sways(model, make_rod_elements(model, FROND_MECHANICS_ROD), FROND_MECHANICS_ROD);
    const auto find = [&] { return find_gap(rods, find_sways(model, make(), FROND_MECHANICS_SPRING_CHAIN)); };
    Gap gap = find();
    double share = 1;
    for (int round = 0; round < ROUNDS && share > LEAST_SHARE && std::abs(gap.error) > CLOSE; round++) {
        const std::vector<double> before = factors;
        for (size_t o = 0; o < factors.size(); o++)
            factors[o] *= frond::exp(share * gap.step * rods.share[Eigen::Index(o)]);
        const Gap next = find();
        if (std::abs(next.error) < std::abs(gap.error)) {
            gap = next;
            continue;
        }
        factors = before;
        share *= 0.5;
    }
    return factors;
}

}  // namespace frond
