// Rest shape: an artist's mesh shows a plant as it stands, bent by its own weight. Inverse statics finds the shape X
// without gravity from which weight bends it to the shape x that was modelled: elastic forces f(x; X) + weight = 0, by
// Newton's method with the exact derivative by X, which takes some six rounds. The exact tangent at x then shows
// whether the plant stands there stably or would topple (Greenhill 1881).
#include <algorithm>
#include <cmath>

#include "calibration/calibration.hpp"
#include "calibration/firm_tets.hpp"
#include "calibration/fit_springs.hpp"
#include "calibration/fit_sway.hpp"
#include "calibration/rest_system.hpp"
#include "calibration/static_stiffness.hpp"
#include "calibration/toppling.hpp"
#include "core/elementary.hpp"
#include "mechanics/rod_elements.hpp"
#include "mechanics/tet_element.hpp"

namespace frond {
namespace {

// Returns whether a tet whose rest positions are moved keeps, at each of its points, more than a third of its volume as
// modelled, and is not overstretched.
template <class Element>
bool is_sound(const TetElements& elements, size_t e, const VecX& moved) {
    constexpr double LONGEST = 10;  // length of an edge over that in the modelled shape [-]
    const auto now = Element::places(elements, e, moved), before = Element::places(elements, e, elements.modelled);
    for (int q = 0; q < Element::POINTS; q++) {
        const Mat3 a = Element::edges(now, q), b = Element::edges(before, q);
        if (!(a.determinant() / b.determinant() > 1.0 / 3) ||
            !(a.colwise().norm().maxCoeff() < LONGEST * b.colwise().norm().maxCoeff()))
            return false;
    }
    return true;
}

// Returns the largest share of a displacement of the rest shape that leaves every tet sound, since a flat tet or a
// needle has no inverse. Returns 0 if none does; `torn` is then the organ that weight tears.
double longest_move(const Model& model, const TetElements& elements, const VecX& move, int& torn) {
    for (double share = 1; share > 0.01; share /= 2) {
        const VecX moved = elements.rest_positions + share * move;
        bool good = moved.allFinite();
        for (size_t e = 0; e < elements.tets.size() && good; e++) {
            good = elements.nodes.order == 1 ? is_sound<LinearTet>(elements, e, moved)
                                             : is_sound<QuadraticTetElement>(elements, e, moved);
            if (!good) torn = model.cage.tet_organ[e];
        }
        if (good) return share;
    }
    return 0;
}

// A rest shape with its elements, and the systems that move it.
struct Search {
    const Model& model;
    frond_mechanics which;
    const Mechanics& row;
    TetElements elements;
    std::vector<uint8_t> held;
    VecX x, rest;
    StaticStiffness stiffness;
    RestSystem system;
    int torn = -1;  // organ at which a balance failed

    Search(const Model& model, frond_mechanics which, int order)
        : model(model),
          which(which),
          row(mechanics(which, order)),
          elements(make_tet_elements(model, nullptr, order)),
          held(with_middles(elements.nodes, find_held_nodes(model.cage, model.root))),
          x(elements.modelled),
          rest(x),
          stiffness(elements.pattern),
          system(elements, held) {}
    Search(const Search&) = delete;
    Search& operator=(const Search&) = delete;
    void move_to(const VecX& moved) {
        rest = moved;
        set_rest_positions(elements, rest);
    }
    // Scales each tet's moduli by the exponential of `change`.
    void stiffen(const VecX& change) {
        for (size_t e = 0; e < elements.tets.size(); e++) {
            const double factor = frond::exp(change[Eigen::Index(e)]);
            elements.mu[e] *= factor;
            elements.lambda[e] *= factor;
        }
    }
};

// Returns the organ of the node that moves farthest; -1 if none moves.
int organ_of_largest(const Model& model, const TetElements& elements, const VecX& move) {
    int node = 0;
    for (int i = 1; i < move.size() / 3; i++)
        if (point(move, i).squaredNorm() > point(move, node).squaredNorm()) node = i;
    if (point(move, node).isZero(0)) return -1;
    for (size_t e = 0; e < model.cage.tets.size(); e++) {
        const ElementNodes nodes = element_nodes(elements, e);
        if (std::find(nodes.node, nodes.node + nodes.count, node) != nodes.node + nodes.count)
            return model.cage.tet_organ[e];
    }
    return -1;
}

// Balances a share of gravity from the present rest shape; false, with that shape unchanged, if that fails.
bool balance(Search& search, double gravity) {
    constexpr int ROUNDS = 25;           // Newton's method takes 5 or 6 where it converges
    constexpr double TOLERANCE = 3e-9;   // distance of a node from its balance, over the plant's size [-]
    constexpr double LEAST_SHARE = 0.1;  // least share of a displacement that makes progress [-]
    constexpr int PATIENCE = 5;          // rounds in which displacements must become half as large
    const VecX start = search.rest;
    std::vector<double> sizes;
    VecX move = VecX::Zero(search.x.size());
    for (int round = 0; round < ROUNDS; round++) {
        const VecX force = unbalanced_force(search.elements, search.held, search.which, search.x, gravity);
        if (!search.system.find_move(search.elements, search.which, search.x, gravity, force, move)) break;
        const double share = longest_move(search.model, search.elements, move, search.torn);
        if (share < LEAST_SHARE) {
            search.move_to(start);
            return false;
        }
        search.move_to(search.rest + share * move);
        sizes.push_back(move.lpNorm<Eigen::Infinity>());
        if (share == 1 && sizes.back() < TOLERANCE * search.model.surface.size()) return true;
        if (round >= 2 * PATIENCE && !(sizes.back() < 0.5 * sizes[size_t(round - PATIENCE)])) break;
    }
    search.torn = organ_of_largest(search.model, search.elements, move);
    search.move_to(start);
    return false;
}

// The result of a search for a rest shape.
struct Outcome {
    VecX rest;                   // empty unless the plant stands
    std::vector<double> shares;  // organs' shares in the energy of the mode in which it topples; empty unless it does
    double overload = 1;         // how many times too heavy it then is [-]
    int torn = -1;               // else the organ at which no balance was found
};

// Copies one organ's tets, with their slots in the pattern of all elements.
TetElements take_organ(const TetElements& all, const std::vector<int>& tet_organ, int organ) {
    TetElements one;
    one.node_count = all.node_count;
    one.nodes.order = all.nodes.order;
    const size_t points = all.rest_inverse.size() / all.tets.size();
    const auto take = [&](const auto& from, auto& to, size_t e, size_t count = 1) {
        if (!from.empty()) to.insert(to.end(), from.begin() + long(e * count), from.begin() + long((e + 1) * count));
    };
    for (size_t e = 0; e < all.tets.size(); e++) {
        if (tet_organ[e] != organ) continue;
        take(all.tets, one.tets, e);
        take(all.ordered, one.ordered, e);
        take(all.nodes.of_tet, one.nodes.of_tet, e);
        take(all.rest_inverse, one.rest_inverse, e, points);
        take(all.point_volume, one.point_volume, e, points);
        take(all.volume, one.volume, e);
        take(all.lambda, one.lambda, e);
        take(all.mu, one.mu, e);
        take(all.slots, one.slots, e);
        take(all.quadratic_slots, one.quadratic_slots, e);
    }
    return one;
}

// Adds move' K move with each organ's own stiffness K.
void add_work_of_tets(Search& search, const VecX& move, std::vector<double>& work) {
    const std::vector<int>& tet_organ = search.model.cage.tet_organ;
    std::vector<uint8_t> has_tets(work.size(), 0);
    for (const int organ : tet_organ) has_tets[size_t(organ)] = 1;
    BlockMatrix own;
    own.set_pattern(search.elements.pattern);
    VecX product;
    for (size_t organ = 0; organ < work.size(); organ++) {
        if (!has_tets[organ]) continue;
        own.set_zero();
        search.row.add_stiffness(take_organ(search.elements, tet_organ, int(organ)), search.x, Tangent::positive, 1,
                                 own);
        own.multiply(move, product);
        work[organ] += move.dot(product);
    }
}

// Finds how an unstable plant topples, and which organs give way.
Outcome find_outcome(Search& search) {
    BlockMatrix taken;
    taken.set_pattern(search.elements.pattern);
    take_by_weight(search.elements, search.row, search.x, taken);
    if (!search.stiffness.set(search.elements, search.held, search.row, Tangent::positive, search.x)) return {};
    const Toppling toppling = find_toppling(search.stiffness, taken, search.held);
    if (toppling.mode.size() == 0) return {};
    Outcome outcome;
    outcome.overload = toppling.overload;

    outcome.shares =
        find_shares(toppling, search.stiffness, taken, search.held, search.model.organs.size(),
                    [&](const VecX& move, std::vector<double>& work) { add_work_of_tets(search, move, work); });
    return outcome;
}

// Finds the rest shape of one mechanics, of a plant that could bear `margin` times its weight. Gravity is increased
// gradually, in steps as large as the search bears.
Outcome search_rest_shape(Search& search, double margin = 1) {
    constexpr double SMALLEST_STEP = 1.0 / 8;  // share of gravity below which the search gives up [-]
    double step = 1;
    for (double done = 0; done < 1;) {
        const double next = std::min(1.0, done + step);
        if (balance(search, GRAVITY * next)) {
            done = next;
            step *= 2;
        } else {
            step = 0.25 * (next - done);
            if (step < SMALLEST_STEP) return {VecX(), {}, 1, search.torn};
        }
    }
    const bool stands = search.stiffness.set(search.elements, search.held, search.row, Tangent::exact, search.x);
    if (stands && margin == 1) return {search.rest, {}, 1, -1};
    Outcome outcome = find_outcome(search);
    outcome.overload *= margin;
    if (stands && !(outcome.overload > 1)) outcome = {search.rest, {}, 1, -1};
    return outcome;
}

// Fits the first modes of a search that found its rest shape to the rods', in changes that are halved if weight cannot
// be balanced or the modes come no nearer. Returns the logarithms of the factors on its tets' moduli.
VecX fit_sway(Search& search, const RodSways& rods) {
    constexpr int ROUNDS = 8;            // a change may be halved in each
    constexpr double CLOSE = 0.02;       // error of a frequency's square that counts as none [-]
    constexpr double LEAST_SHARE = 0.1;  // least share of a change [-]
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
    Search search(model, FROND_MECHANICS_TET_LINEAR, order);
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
static void stiffen_toppling_organs(Model& model, const Outcome& outcome, std::vector<double>& factor) {
    const std::vector<double> stiffer = stiffer_by(outcome.shares, outcome.overload);
    for (size_t o = 0; o < stiffer.size(); o++)
        if (stiffer[o] > 1) stiffen(model, o, stiffer[o], factor);
}

WeakOrgan find_rest_shape(Model& model, int order) {
    // The default mechanics decide how stiff the cage has to be.
    constexpr double STIFFER = 2, MARGIN = 1.3;
    constexpr int MOST_TRIES = 40;
    std::vector<double> factor(model.organs.size(), 1.0);
    // If all materials are Frond's choice, a touch must not topple the plant either; rods have more margin.
    const bool given =
        std::any_of(model.organs.begin(), model.organs.end(), [](const Organ& organ) { return organ.material_given; });
    const double margin = given ? 1 : MARGIN;
    stiffen_torn_organs(model, order);
    auto search = std::make_unique<Search>(model, FROND_MECHANICS_TET_COROTATIONAL, order);
    Outcome outcome = search_rest_shape(*search, margin);
    for (int i = 0; i < MOST_TRIES && outcome.rest.size() == 0; i++) {
        if (!outcome.shares.empty())
            stiffen_toppling_organs(model, outcome, factor);
        else if (outcome.torn >= 0)
            stiffen(model, size_t(outcome.torn), STIFFER, factor);
        else
            for (size_t o = 0; o < factor.size(); o++) stiffen(model, o, STIFFER, factor);
        search = std::make_unique<Search>(model, FROND_MECHANICS_TET_COROTATIONAL, order);
        outcome = search_rest_shape(*search, margin);
    }
    if (outcome.rest.size() > 0) {
        const VecX change =
            fit_sway(*search, find_sways(model, make_rod_elements(model, FROND_MECHANICS_ROD), FROND_MECHANICS_ROD));
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
    Search search(model, which, order);
    if (search_rest_shape(search).rest.size() == 0) return;
    const VecX change =
        fit_sway(search, find_sways(model, make_rod_elements(model, FROND_MECHANICS_ROD), FROND_MECHANICS_ROD));
    std::vector<double>& stiffer = shapes.stiffer[row][size_t(which)];
    for (size_t e = 0; e < model.tet_young.size(); e++) stiffer.push_back(frond::exp(change[Eigen::Index(e)]));
    shapes.positions[row][size_t(which)] = search.rest;
}

}  // namespace frond
