// Rest shape: an artist's mesh shows a plant as it stands, bent by its own weight. In: a model. Out: its shape without
// gravity, by inverse statics; where there is none, or the plant would topple, organs are made stiffer until it stands.
// Then its first modes are fitted to those of its rods.
#include <algorithm>
#include <cmath>

#include "calibration/calibration.hpp"
#include "calibration/fit_springs.hpp"
#include "calibration/fit_sway.hpp"
#include "calibration/inverse_statics.hpp"
#include "calibration/toppling.hpp"
#include "core/elementary.hpp"
#include "mechanics/rod_elements.hpp"

namespace frond {
namespace {

// Fits the first modes of a search that found its rest shape to the rods', in changes that are halved if weight cannot
// be balanced or the modes come no nearer. Returns the logarithms of the factors on its tets' moduli.
VecX fit_sway(RestSearch& search) {
    constexpr int ROUNDS = 8;            // a change may be halved in each
    constexpr double CLOSE = 0.02;       // error of a frequency's square that counts as none [-]
    constexpr double LEAST_SHARE = 0.1;  // least share of a change [-]
    const RodSways rods =
        find_sways(search.model, make_rod_elements(search.model, FROND_MECHANICS_ROD), FROND_MECHANICS_ROD);
    VecX done = VecX::Zero(Eigen::Index(search.elements.tets.size()));
    const auto find = [&] {
        if (!search.stiffness.set(search.elements, search.held, search.row, Tangent::exact, search.x))
            return SwayGap{INFINITY, {}};
        return find_gap(search.model, search.elements, search.which, search.x, search.stiffness.factor, search.held,
                        rods, done);
    };
    SwayGap gap = find();
    double share = 1;
    for (int round = 0; round < ROUNDS && share > LEAST_SHARE && gap.error > CLOSE && gap.change.size() > 0; round++) {
        const VecX change = share * gap.change, rest = search.rest;
        search.stiffen(change);
        done += change;
        SwayGap next = {INFINITY, {}};
        if (balance(search, GRAVITY)) next = find();
        if (next.error < gap.error) {
            gap = next;
            continue;
        }
        search.stiffen(-change);
        search.move_to(rest);
        done -= change;
        share *= 0.5;
    }
    return done;
}

// Returns the largest strain in each organ's tets under the plant's weight, by linear theory [-]; empty if the root
// does not hold it.
std::vector<double> organ_strains(const Model& model, int order) {
    RestSearch search(model, FROND_MECHANICS_TET_LINEAR, order);
    const TetElements& elements = search.elements;
    const VecX force = unbalanced_force(elements, search.held, FROND_MECHANICS_TET_LINEAR, search.x, GRAVITY);
    if (!search.stiffness.set(elements, search.held, search.row, Tangent::positive, search.x)) return {};
    VecX u(force.size());
    solve(search.stiffness.factor, force, u);
    std::vector<double> strains(model.organs.size(), 0.0);
    for (size_t e = 0; e < elements.tets.size(); e++) {
        double& strain = strains[size_t(model.cage.tet_organ[e])];
        take_gradients(elements, e, u, [&](const TetShare&, const Mat3& gradient) {
            strain = std::max(strain, 0.5 * (gradient + gradient.transpose()).norm());
        });
    }
    return strains;
}

// Makes organs stiffer that weight would tear apart in the cage, loose parts that hang on a corner, so that the rest of
// the plant need not be.
void stiffen_torn_organs(Model& model, int order) {
    constexpr double LARGEST_STRAIN = 0.35;  // by linear statics; above it tets are about to tear [-]
    constexpr int ROUNDS = 3;                // strain falls in proportion, so that one is mostly enough
    for (int round = 0; round < ROUNDS; round++) {
        const std::vector<double> strains = organ_strains(model, order);
        bool torn = false;
        for (size_t e = 0; e < model.tet_young.size() && !strains.empty(); e++) {
            const double strain = strains[size_t(model.cage.tet_organ[e])];
            if (!(strain > LARGEST_STRAIN)) continue;
            model.tet_young[e] *= strain / LARGEST_STRAIN;
            torn = true;
        }
        if (!torn) return;
    }
}

}  // namespace

// Makes one organ stiffer and records by how much.
static void stiffen(Model& model, size_t organ, double stiffer, std::vector<double>& factor) {
    factor[organ] *= stiffer;
    for (size_t e = 0; e < model.tet_young.size(); e++)
        if (size_t(model.cage.tet_organ[e]) == organ) model.tet_young[e] *= stiffer;
}

// Makes the organs stiffer that give way most when the plant topples.
static void stiffen_toppling_organs(Model& model, const RestOutcome& outcome, std::vector<double>& factor) {
    const std::vector<double> stiffer = stiffer_by(outcome.shares, outcome.overload);
    for (size_t o = 0; o < stiffer.size(); o++)
        if (stiffer[o] > 1) stiffen(model, o, stiffer[o], factor);
}

WeakOrgan find_rest_shape(Model& model, int order) {
    // The default mechanics decide how stiff the cage has to be.
    constexpr double STIFFER = 2, MARGIN = 1.3;
    constexpr int MOST_TRIES = 40;
    std::vector<double> factor(model.organs.size(), 1.0);
    // Where moduli are Frond's choice, a touch must not topple the plant either; rods have more margin.
    std::vector<double> margins;
    for (const Organ& organ : model.organs) margins.push_back(organ.young_given ? 1 : MARGIN);
    stiffen_torn_organs(model, order);
    auto search = std::make_unique<RestSearch>(model, FROND_MECHANICS_TET_COROTATIONAL, order);
    RestOutcome outcome = search_rest_shape(*search, margins);
    for (int i = 0; i < MOST_TRIES && outcome.rest.size() == 0; i++) {
        if (!outcome.shares.empty())
            stiffen_toppling_organs(model, outcome, factor);
        else if (outcome.torn >= 0)
            stiffen(model, size_t(outcome.torn), STIFFER, factor);
        else
            for (size_t o = 0; o < factor.size(); o++) stiffen(model, o, STIFFER, factor);
        search = std::make_unique<RestSearch>(model, FROND_MECHANICS_TET_COROTATIONAL, order);
        outcome = search_rest_shape(*search, margins);
    }
    if (outcome.rest.size() > 0) {
        const VecX change = fit_sway(*search);
        for (size_t e = 0; e < model.tet_young.size(); e++) model.tet_young[e] *= frond::exp(change[Eigen::Index(e)]);
        model.rest_shapes->positions[size_t(order - 1)][FROND_MECHANICS_TET_COROTATIONAL] = search->rest;
    }
    model.rest_shapes->known[size_t(order - 1)][FROND_MECHANICS_TET_COROTATIONAL] = true;
    const size_t weakest = size_t(std::max_element(factor.begin(), factor.end()) - factor.begin());
    return {model.organs[weakest].name, model.organs[weakest].kind, factor[weakest]};
}

// Fits a cage of Frond's own to an order of its elements.
static void fit_to_order(const Model& model, int order) {
    Model fitted = model;
    fitted.rest_shapes = std::make_shared<RestShapes>();
    calibrate(fitted, order);
    if (model.stands_as_modelled) find_rest_shape(fitted, order);
    RestShapes& shapes = *model.rest_shapes;
    const size_t row = size_t(order - 1);
    shapes.known[row] = fitted.rest_shapes->known[row];
    shapes.positions[row] = fitted.rest_shapes->positions[row];
    shapes.quadratic_young = fitted.tet_young;
    shapes.quadratic_grain = fitted.tet_grain;
}

void ensure_rest_shape(const Model& model, frond_mechanics which, int order) {
    RestShapes& shapes = *model.rest_shapes;
    std::lock_guard<std::mutex> lock(shapes.mutex);
    const bool moves_chain = mechanics(which).moves_chain;
    if (order == 2 && !moves_chain && model.calibrated && shapes.quadratic_young.empty()) fit_to_order(model, order);
    const size_t row = moves_chain ? 0 : size_t(order - 1);
    if (shapes.known[row][size_t(which)]) return;
    shapes.known[row][size_t(which)] = true;
    if (which == FROND_MECHANICS_SPRING_CHAIN) shapes.springs = fit_springs(model);
    if (!model.stands_as_modelled || moves_chain) return;
    RestSearch search(model, which, order);
    if (search_rest_shape(search, std::vector<double>(model.organs.size(), 1.0)).rest.size() == 0) return;
    const VecX change = fit_sway(search);
    std::vector<double>& stiffer = shapes.stiffer[row][size_t(which)];
    for (size_t e = 0; e < model.tet_young.size(); e++) stiffer.push_back(frond::exp(change[Eigen::Index(e)]));
    shapes.positions[row][size_t(which)] = search.rest;
}

}  // namespace frond
